"""The legs of a way to a Grbl board: where and when those sent end, and which is next.

No leg is sent before those ahead of it would leave less than a leg to go at the commanded speed: a
board has a least feed, of 1 mm/min, and masses may have to be slower than that.

A leg that was refused because the board runs (error:8) has moved nothing. The way goes on from
where masses stand, once they do.
"""

from collections.abc import Mapping, Sequence

from equipoise.hardware.boards.grbl.lines import jog
from equipoise.hardware.boards.grbl.place import rounding_of
from equipoise.hardware.boards.grbl.talk import Step
from equipoise.hardware.boards.legs import Pacemaker, next_leg, time_left
from equipoise.hardware.transport.command_queue import Command
from equipoise.hardware.transport.driver_protocol import LEG
from equipoise.model.hardware import Axis

SETTLED = 1.0  # s, chosen: twice there and back by radio; standing for so long, it goes nowhere

Displacements = Mapping[str, float]  # m, by mass


class Route:
    """One way; ``speed`` is m/s, by mass."""

    def __init__(self, speed: Mapping[str, float]) -> None:
        self._speed = self._own = speed
        self.sent: Displacements = {}  # where the legs sent so far end
        self.refused = False  # the last leg was, and waits for masses to stand
        self._pacemaker = Pacemaker()

    def begin(self, at: Displacements, t: float) -> None:
        """Begin where masses stand, at t s."""
        self.sent, self.refused = dict(at), False
        self._pacemaker.begin(at, t)

    def slow_down(self, most: float) -> None:
        """Let no mass go faster than so many m/s from the next leg on."""
        self._speed = {name: min(speed, most) for name, speed in self._own.items()}

    def is_over(
        self, axes: Sequence[Axis], position: Displacements, goal: Displacements, stood: float
    ) -> bool:
        """Say whether masses that have stood for so long (s) go no further.

        All legs are sent. Masses are where these end, or they would have moved.
        """
        there = all(
            abs(position[name] - goal[name]) <= rounding
            for name, rounding in rounding_of(axes).items()
        )
        return self.sent == goal and (there or stood > SETTLED)

    def following(
        self, axes: Sequence[Axis], position: Displacements, goal: Displacements, t: float
    ) -> Command[Step] | None:
        """Return the next leg when little is left of those before at t s; None: not now."""
        led = self._pacemaker.led(self.sent, self._speed, t)
        left = time_left(position, self.sent, self._speed, rounding_of(axes))
        if self.refused or max(left, time_left(led, self.sent, self._speed)) > LEG:
            return None
        way = next_leg(self.sent, goal, self._speed)
        if way is None:
            self.sent = dict(goal)
            return None
        leg = jog(axes, self.sent, way)
        self.sent = {**self.sent, **way.to}
        return leg
