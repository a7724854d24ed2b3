"""What sizes are plausible of a bench: beyond them a number is a slip, or a broken file.

One table for keys, options, requests and the rows of recordings. The sizes are chosen: a hundred
times what the largest bench has, or more, and small enough that no square of one overflows.
"""

from collections.abc import Iterator
from typing import cast

from equipoise.io.toml.units import KINDS, SPOKEN, TO_SI, split_unit
from equipoise.model.errors import InputError

# In SI, by what is measured: the largest that is believed.
SIZES = {
    "time": 1e7,  # s: four months
    "angle": 1e5,
    "rate": 1e4,
    "length": 1e3,
    "speed": 1e3,
    "mass": 1e5,
    "inertia": 1e6,
    "momentum": 1e6,
    "torque": 1e6,
    "drag": 1e6,
    "dipole": 1e6,
    "magnetic": 1e2,
    "acceleration": 1e4,
    "frequency": 1e7,
    "temperature": 1e4,
    "share": 1e6,
    "number": 1e9,  # of what has no unit
}
OF_UNIT = {unit: kind for kind, units in KINDS.items() for unit in units} | {
    "kg": "mass", "g": "mass", "mg": "mass", "kg m2": "inertia", "N m s2": "drag", "N s/m": "drag",
    "m/s": "speed",
    "cm/s": "speed", "mm/s": "speed", "um/min": "speed", "deg/s per root Hz": "rate",
    "Hz": "frequency", "kHz": "frequency", "percent": "share", "K": "temperature",
    "um/K": "length",
}  # fmt: skip


def largest(key: str) -> float:
    """Return the largest number that a key or an option of this name may have, in its unit."""
    unit = SPOKEN.get(split_unit(key)[1], "")
    return SIZES[OF_UNIT[unit]] / TO_SI[unit] if unit else SIZES["number"]


def implausible(key: str, value: object) -> str | None:
    """Return what is wanted instead of a number, or of a list with one, that is not believed."""
    most = largest(key)
    if any(abs(number) > most for number in _numbers(value)):
        return f"a number no larger than {most:.3g}"
    return None


def check_plausible(option: str, value: float | int) -> None:
    """Raise InputError for an option's number that is not believed; its name ends with its unit."""
    wanted = implausible(option.strip("-").replace("-", "_"), value)
    if wanted is not None:
        raise InputError(option, f"{value:g}", wanted)


def _numbers(value: object) -> Iterator[float]:
    """Yield the numbers in a value, or in lists of lists."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        yield value
    elif isinstance(value, list):
        for each in cast("list[object]", value):
            yield from _numbers(each)
