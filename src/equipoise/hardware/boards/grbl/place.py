"""Where a Grbl board says that masses are.

Masses that stand are taken to be somewhere else only when two reports in a row say so: a single one
may be a line of before that has come once more.
"""

from collections.abc import Mapping, Sequence

from equipoise.hardware.boards.grbl.report import Status
from equipoise.hardware.boards.grbl.settings import LETTERS
from equipoise.model.hardware import Axis
from equipoise.model.units import MM, in_si

DIGIT = 1e-6  # m: positions are reported to 1 um

Displacements = Mapping[str, float]  # m, by mass


class Place:
    """Positions as they are reported."""

    def __init__(self) -> None:
        self.at: Displacements = {}
        self.still = float("-inf")  # s, since when they are the same
        self._offset: tuple[float, ...] | None = None
        self._odd: Displacements = {}  # where they are once said to be
        self._held: Displacements = {}  # where masses stood before a reset

    def take(self, axes: Sequence[Axis], status: Status, arrived: float, standing: bool) -> bool:
        """Take a report over that arrived at a time (s); say whether it is whole.

        One that lacks an axis has lost a part: Grbl says every axis.
        """
        self._offset = status.offset or self._offset
        machine = _machine_position(status, self._offset)
        if machine is None:
            return True
        found = _displacements(axes, machine)
        if found is None:
            return False
        if standing and found not in (self.at, self._odd):
            self._odd = found
            return True
        if found != self.at:
            self.at, self.still = found, arrived
        return True

    def hold(self) -> None:
        """Note that a reset must leave masses where they are."""
        self._held = self.at

    def moved_by_reset(self) -> tuple[str, float, float] | None:
        """Return, once, the first mass that a reset has moved, and from where to where (m)."""
        held, self._held = self._held, {}
        moved = ((name, at, self.at[name]) for name, at in held.items())
        return next((each for each in moved if abs(each[1] - each[2]) > 2 * DIGIT), None)


def rounding_of(axes: Sequence[Axis]) -> Displacements:
    """Return how far from where it was sent a mass may be reported to stand, m."""
    return {axis.mass: DIGIT + 0.5 / axis.steps_per_m for axis in axes}


def _machine_position(status: Status, offset: Sequence[float] | None) -> tuple[float, ...] | None:
    """Return where the machine is, mm; None while that is not known: work = machine - offset."""
    if status.machine is not None or status.work is None or offset is None:
        return status.machine
    return tuple(a + b for a, b in zip(status.work, offset, strict=False))


def _displacements(axes: Sequence[Axis], machine: Sequence[float]) -> dict[str, float] | None:
    """Return displacements (m) at a position of the machine (mm); None if it lacks an axis."""
    columns = {axis: LETTERS.index(axis.letter) for axis in axes}
    if max(columns.values()) >= len(machine):
        return None
    return {axis.mass: axis.displacement(in_si(machine[k], MM)) for axis, k in columns.items()}
