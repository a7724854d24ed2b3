"""Options checked before work begins, in an error that names the option."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError, nearest

if TYPE_CHECKING:
    from equipoise.model.testbed import Testbed

MOST_ROWS = 50_000_000  # of a record in memory (chosen: 2 GB; 14 hours at 1 kHz)
Triple = tuple[float, float, float]
MaybeNumber = TypeVar("MaybeNumber", float, float | None)


def plausible(option: str, value: MaybeNumber) -> MaybeNumber:
    """Return a number that is plausible of a bench; None stays None."""
    from equipoise.io.toml.plausible import check_plausible

    if value is not None:
        check_plausible(option, value)
    return value


def positive(option: str, value: MaybeNumber) -> MaybeNumber:
    """Return a number above zero; None, for an option that was not given, stays None."""
    if value is not None and not (0 < value < math.inf):
        raise InputError(option, f"{value:g}", "a number above 0")
    return plausible(option, value)


def duration_of(option: str, seconds: float, testbed: "Testbed") -> float:
    """Return a duration (s) of which a testbed's sensors give no more rows than memory holds."""
    rates = [each.rate for each in (testbed.attitude, testbed.gyro) if each is not None]
    longest = MOST_ROWS / max(sum(rates), 1.0)
    if positive(option, seconds) > longest:
        wanted = f"at most {longest:.0f} s: with {sum(rates):g} rows per second {MOST_ROWS} in all"
        raise InputError(option, f"{seconds:g}", wanted)
    return seconds


def not_negative(option: str, value: MaybeNumber) -> MaybeNumber:
    """Return a number of at least zero; None stays None."""
    if value is not None and not (0 <= value < math.inf):
        raise InputError(option, f"{value:g}", "a number of at least 0")
    return plausible(option, value)


def between(option: str, value: float, low: float, high: float) -> float:
    """Return a number above ``low`` and at most ``high``."""
    if not (low < value <= high):
        raise InputError(option, f"{value:g}", f"a number above {low:g}, at most {high:g}")
    return value


def share(option: str, value: float) -> float:
    """Return a share of the rows."""
    if not 0 <= value < 1:
        raise InputError(option, f"{value:g}", "a fraction of the rows: at least 0, below 1")
    return value


def seed_of(value: int) -> int:
    """Return a seed that every generator takes."""
    if not 0 <= value < 2**63:
        raise InputError("--seed", str(value), "a whole number of at least 0")
    return value


def one_of(option: str, name: str, known: list[str]) -> str:
    """Return a name that is known."""
    if name not in known:
        raise InputError(option, f"'{name}'", nearest(name, known))
    return name


def vector(option: str, values: Triple, unit: float) -> Vector3:
    """Return three finite numbers as a vector in SI."""
    import numpy as np

    if not all(map(math.isfinite, values)):
        raise InputError(option, f"{values}", "three finite numbers")
    for value in values:
        plausible(option, value)
    return np.array(values, dtype=float) * unit


def tolerance(option: str, values: Triple, unit: float) -> Vector3:
    """Return three numbers above zero as a vector in SI."""
    for value in values:
        positive(option, value)
    return vector(option, values, unit)


def check_outputs(folder: Path | None, *files: Path | None) -> None:
    """Raise InputError now for what cannot be written, before work is lost on it."""
    from equipoise.io.files.atomic_file import check_folder, check_writable

    for file in files:
        if file is not None:
            check_writable(file)
    if folder is not None:
        check_folder(folder)
