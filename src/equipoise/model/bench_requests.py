"""Checks of requests to a bench, the same for simulated, replayed and real ones.

A target is refused, never clipped; nothing moves unless all of them can be.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from equipoise.model.arrays import Series1
from equipoise.model.devices import TRAITS, Device, greatest_input, least_input
from equipoise.model.errors import DriveRefused, InputError, MoveRefused, nearest
from equipoise.model.testbed import SlidingMass

HAIR = 1e-9  # m, chosen: a target on the end of the rail may be rounded beyond it by so much
ROUNDING = 1e-9  # relative, chosen: an input on the limit may be rounded beyond it by so much


def check_duration(duration: float) -> None:
    """Raise InputError for a time (s) that nobody can wait."""
    if not 0 <= duration < np.inf:
        raise InputError("read", f"a duration of {duration} s", "zero or more seconds")


def check_speed(speed: float) -> None:
    """Raise InputError for a speed (m/s) at which no mass arrives."""
    if not speed > 0:
        raise InputError("move", f"a speed of {speed} m/s", "more than zero m/s")


def checked_inputs(devices: Sequence[Device], inputs: Mapping[str, float]) -> dict[int, float]:
    """Return what devices are given, by index.

    Raises InputError for the first bad name or number, DriveRefused beyond a device's limit.
    """
    names = [device.name for device in devices]
    found = _by_index("drive", "device", names, inputs, "a finite number")
    for i, requested in found.items():
        _check_input(devices[i], requested)
    return found


def _check_input(device: Device, requested: float) -> None:
    """Raise DriveRefused for an input that is too great, or for a pulse that is too short."""
    unit = TRAITS[type(device)].input_unit
    most, least = greatest_input(device), least_input(device)
    if abs(requested) > most * (1 + ROUNDING):
        raise DriveRefused(device.name, requested, most, unit)
    if requested and abs(requested) < least * (1 - ROUNDING):
        raise DriveRefused(device.name, requested, least, f"{unit} at least")


def checked_targets(
    masses: Sequence[SlidingMass], here: Series1, targets: Mapping[str, float]
) -> dict[int, float]:
    """Return targets by index, in whole steps (m); InputError or MoveRefused for the first bad.

    ``here`` says where the masses are (m), for the text of a refusal.
    """
    names = [mass.name for mass in masses]
    goals = _by_index("move", "mass", names, targets, "a displacement in m")
    for i, requested in goals.items():
        goals[i] = in_steps(masses[i], requested)
        low, high = masses[i].travel
        if min(requested, goals[i]) < low - HAIR or max(requested, goals[i]) > high + HAIR:
            raise MoveRefused(names[i], float(here[i]), requested, low, high)
    return goals


def _by_index(
    verb: str, kind: str, names: Sequence[str], requested: Mapping[str, float], number: str
) -> dict[int, float]:
    """Return what is asked of each by its index; InputError for an unknown name or no number."""
    for name, value in requested.items():
        if name not in names:
            known = nearest(name, names) if names else f"no {kind}: this testbed has none"
            raise InputError(verb, f"a {kind} '{name}'", known)
        if not np.isfinite(value):
            raise InputError(f"{verb}: {kind} {name}", f"{value}", number)
    return {names.index(name): float(value) for name, value in requested.items()}


def in_steps(mass: SlidingMass, requested: float) -> float:
    """Return the displacement (m) to command a motor of this resolution."""
    return (
        requested if mass.resolution == 0 else round(requested / mass.resolution) * mass.resolution
    )
