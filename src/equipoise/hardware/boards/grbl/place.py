"""Where a Grbl board says that masses are.

Masses that stand are taken to be somewhere else only when two reports in a row say so: a single one
may be a line of before that has come once more.
"""

from collections.abc import Mapping, Sequence

from equipoise.hardware.boards.grbl.lines import displacements, machine_position
from equipoise.hardware.boards.grbl.report import Status
from equipoise.model.hardware import Axis

Displacements = Mapping[str, float]  # m, by mass


class Place:
    """Positions as they are reported."""

    def __init__(self) -> None:
        self.at: Displacements = {}
        self.still = float("-inf")  # s, since when they are the same
        self._offset: tuple[float, ...] | None = None
        self._odd: Displacements = {}  # where they are once said to be

    def take(self, axes: Sequence[Axis], status: Status, arrived: float, standing: bool) -> bool:
        """Take a report over that arrived at a time (s); say whether it is whole.

        One that lacks an axis has lost a part: Grbl says every axis.
        """
        self._offset = status.offset or self._offset
        machine = machine_position(status, self._offset)
        if machine is None:
            return True
        found = displacements(axes, machine)
        if found is None:
            return False
        if standing and found not in (self.at, self._odd):
            self._odd = found
            return True
        if found != self.at:
            self.at, self.still = found, arrived
        return True
