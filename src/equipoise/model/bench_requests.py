"""What a bench may be asked: the same on simulated, replayed and real benches.

A target is refused, never clipped; nothing moves unless all of them can be.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from equipoise.model.arrays import Series1
from equipoise.model.devices import Device
from equipoise.model.errors import InputError, MoveRefused, nearest
from equipoise.model.testbed import SlidingMass

HAIR = 1e-9  # m, chosen: a target on the end of the rail may be rounded beyond it by so much


def check_duration(duration: float) -> None:
    """Raise InputError for a time (s) that nobody can wait."""
    if not 0 <= duration < np.inf:
        raise InputError("read", f"a duration of {duration} s", "zero or more seconds")


def checked_inputs(devices: Sequence[Device], inputs: Mapping[str, float]) -> dict[int, float]:
    """Return what devices are given, by index; InputError for the first bad name or number."""
    names = [device.name for device in devices]
    for name, asked in inputs.items():
        if name not in names:
            wanted = nearest(name, names) if names else "no devices: this testbed has none"
            raise InputError("drive", f"a device '{name}'", wanted)
        if not np.isfinite(asked):
            raise InputError(f"drive: {name}", f"{asked}", "a finite number")
    return {names.index(name): float(asked) for name, asked in inputs.items()}


def checked_targets(
    masses: Sequence[SlidingMass], here: Series1, targets: Mapping[str, float]
) -> dict[int, float]:
    """Return targets by index, in whole steps (m); InputError or MoveRefused for the first bad.

    ``here`` says where the masses are (m), for the text of a refusal.
    """
    names = [mass.name for mass in masses]
    goals: dict[int, float] = {}
    for name, asked in targets.items():
        if name not in names:
            wanted = nearest(name, names) if names else "no masses: this testbed has none"
            raise InputError("move", f"a mass '{name}'", wanted)
        if not np.isfinite(asked):
            raise InputError(f"move: mass {name}", f"{asked}", "a displacement in m")
        i = names.index(name)
        goals[i] = in_steps(masses[i], float(asked))
        low, high = masses[i].travel
        if min(asked, goals[i]) < low - HAIR or max(asked, goals[i]) > high + HAIR:
            raise MoveRefused(name, float(here[i]), float(asked), low, high)
    return goals


def in_steps(mass: SlidingMass, asked: float) -> float:
    """Return the displacement (m) that a motor of this resolution is told to go to."""
    return asked if mass.resolution == 0 else round(asked / mass.resolution) * mass.resolution
