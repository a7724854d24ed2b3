"""The legs of a way to a Grbl board: where those sent end, and which is next.

A leg that was refused because the board runs (error:8) has moved nothing. The way goes on from
where masses stand, once they do.
"""

from collections.abc import Mapping, Sequence

from equipoise.hardware.boards.grbl.lines import jog
from equipoise.hardware.boards.grbl.talk import Step
from equipoise.hardware.boards.legs import next_leg, time_left
from equipoise.hardware.transport.command_queue import Command
from equipoise.hardware.transport.driver_protocol import LEG
from equipoise.model.hardware import Axis

Displacements = Mapping[str, float]  # m, by mass


class Route:
    """One way; ``speed`` is m/s, by mass."""

    def __init__(self, speed: Mapping[str, float]) -> None:
        self._speed = self._own = speed
        self.sent: Displacements = {}  # where the legs sent so far end
        self.refused = False  # the last leg was, and waits for masses to stand

    def begin(self, at: Displacements) -> None:
        """Begin where masses stand."""
        self.sent, self.refused = dict(at), False

    def slow_down(self, most: float) -> None:
        """Let no mass go faster than so many m/s from the next leg on."""
        self._speed = {name: min(speed, most) for name, speed in self._own.items()}

    def following(
        self, axes: Sequence[Axis], position: Displacements, goal: Displacements
    ) -> Command[Step] | None:
        """Return the next leg when little is left of those before; None: not now."""
        if self.refused or time_left(position, self.sent, self._speed) > LEG:
            return None
        way = next_leg(self.sent, goal, self._speed)
        if way is None:
            self.sent = dict(goal)
            return None
        leg = jog(axes, self.sent, way)
        self.sent = {**self.sent, **way.to}
        return leg
