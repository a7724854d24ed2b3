"""Where the axes of an emulated Grbl board are, and the ways that they go.

Ways are straight. Between them a planner's block has one speed; a hold slows down at the axes'
accelerations, v^2 / 2 a on over the time v / a. The counter is what the board believes; the true
place is greater by a shift, which homing makes zero: a board that is switched on counts from
wherever it stands, and one that is stopped dead in motion loses steps.
"""

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from equipoise.hardware.emulated.device import Leg
from equipoise.model.arrays import Floats
from equipoise.model.hardware import Axis
from equipoise.model.units import MINUTE, MM

LETTERS = "XYZABC"
DELAY = 0.02  # s, chosen: from a command to the first step, as a planner needs
LEAST_FEED = 1.0 / MINUTE  # mm/s, MINIMUM_FEED_RATE of the firmware's config.h
SKIPPED = 0.2  # mm, chosen: by which an axis is off that was stopped dead


@dataclass(frozen=True, slots=True, eq=False)
class Block:
    """A way in the planner, counted in mm."""

    start: float  # s
    end: float  # s
    begin: Floats
    to: Floats
    slowing: bool = False  # it is said to, and goes at its mean speed

    def at(self, t: float) -> Floats:
        """Return the place at t s."""
        share = np.clip((t - self.start) / max(self.end - self.start, 1e-9), 0.0, 1.0)
        return self.begin + share * (self.to - self.begin)

    @property
    def velocity(self) -> Floats:
        """Return mm/s."""
        return (self.to - self.begin) / max(self.end - self.start, 1e-9)


class Motion:
    """The axes of one board; settings are the board's own, and may change."""

    def __init__(self, axes: Sequence[Axis], count: int, settings: Mapping[int, float]) -> None:
        self._axes, self._count, self._settings = axes, count, settings
        self._blocks: deque[Block] = deque()
        self.rest: list[Floats] = []  # where blocks that a hold left over go, mm
        self._feed = 0.0  # mm/s, of what is left over
        self._at = np.zeros(count)
        self._shift = np.zeros(count)
        self._legs: list[Leg] = []
        for axis in axes:  # masses stand at home when the power comes on, and it counts 0 there
            self._shift[LETTERS.index(axis.letter)] = axis.zero / MM

    @property
    def end(self) -> float:
        """When the last block ends, s; infinite if none is under way."""
        return self._blocks[-1].end if self._blocks else float("inf")

    def where(self, t: float) -> Floats:
        """Return what the counter says, mm."""
        block = next((block for block in self._blocks if t < block.end), None)
        return self._at if block is None else block.at(t)

    def speed(self, t: float) -> float:
        """Return how quick it goes, mm/s."""
        block = self._going(t)
        if block is None:
            return 0.0
        left = 2 * (block.end - t) / (block.end - block.start) if block.slowing else 1.0
        return left * float(np.linalg.norm(block.velocity))

    def ahead(self, t: float) -> float:
        """Return how far it still goes, mm."""
        ways = (b.to - (b.at(t) if b.start <= t else b.begin) for b in self._blocks if t < b.end)
        return float(sum(np.linalg.norm(way) for way in ways))

    @property
    def last(self) -> Floats:
        """Where the last block goes, mm."""
        return self._blocks[-1].to if self._blocks else self._at

    @property
    def farthest(self) -> float:
        """How far the farthest axis is from its switch, mm."""
        return float(np.max(np.abs(self._at + self._shift)))

    def queue(self, to: Floats, feed: float, t: float) -> bool:
        """Go on to a place (mm) with a feed (mm/s); say whether that is a step at all.

        No axis goes faster than it may, and no way slower than the firmware's least feed.
        """
        begin, steps = self.last, self._of(100)
        to = np.round(to * steps) / steps
        way, feed = np.abs(to - begin), max(feed, LEAST_FEED)
        if not way.any():
            return False
        taken = max(float(np.linalg.norm(way)) / feed, float(np.max(MINUTE * way / self._of(110))))
        start = self._blocks[-1].end if self._blocks else t + DELAY
        self._add(Block(start, start + taken, begin, to))
        return True

    def slow_down(self, t: float) -> None:
        """Come to stand as the accelerations let it; what is left of its way is kept as rest."""
        if not self._blocks:
            return
        block = self._going(t)
        self.rest = [each.to for each in self._blocks if t < each.end]
        if block is None:
            self._at = self.where(t)
            self._blocks.clear()
            self._add(Block(t, t, self._at, self._at))
            return
        velocity, at = block.velocity, block.at(t)
        self._feed = float(np.linalg.norm(velocity))
        taken = float(np.max(np.abs(velocity) / self._of(120)))
        taken = min(taken, 2 * (block.end - t))
        self._blocks.clear()
        self._add(Block(t, t + taken, at, at + 0.5 * taken * velocity, slowing=True))

    def resume(self, t: float) -> None:
        """Go on with what a hold left over."""
        rest, self.rest = self.rest, []
        for to in rest:
            self.queue(to, max(self._feed, 1e-3), t)

    def ended(self) -> None:
        """Take over that the last block has ended."""
        self._at = self.last
        self._blocks.clear()

    def stopped_dead(self, t: float) -> None:
        """Stop without slowing down: the counter has gone on, the masses have not."""
        moving = self._going(t) is not None
        self._at = self.where(t)
        self._blocks.clear()
        self.rest = []
        self._add(Block(t, t, self._at, self._at))
        self._blocks.clear()
        if moving:
            self._at = self._at + SKIPPED
            self._shift = self._shift - SKIPPED

    def switched_on(self) -> None:
        """Count from here."""
        self._shift, self._at = self._shift + self._at, np.zeros(self._count)

    def home(self, t: float, taken: float, pull_off: float) -> None:
        """Find the switches within so many seconds: the counter is right from then on."""
        self._at, self._shift = self._at + self._shift, np.zeros(self._count)
        self._add(Block(t, t + taken, self._at, np.full(self._count, -pull_off)))

    def legs(self) -> Sequence[Leg]:
        """Return the legs that have begun since the last call."""
        legs, self._legs = self._legs, []
        return legs

    def _going(self, t: float) -> Block | None:
        return next((each for each in self._blocks if each.start <= t < each.end), None)

    def _add(self, block: Block) -> None:
        self._blocks.append(block)
        whole = len(self._blocks) == 1  # what was queued for other masses is void
        for axis in self._axes:
            k = LETTERS.index(axis.letter)
            if whole or block.to[k] != block.begin[k]:
                goal = self._true(axis, block.to + self._shift)
                self._legs.append(Leg(axis.mass, block.start, block.end, goal))

    def _true(self, axis: Axis, place: Floats) -> float:
        """Return the displacement (m) at a true place of the machine (mm)."""
        return axis.displacement(float(place[LETTERS.index(axis.letter)]) * MM)

    def _of(self, base: int) -> Floats:
        """Return a setting of every axis."""
        return np.array([self._settings[base + k] for k in range(self._count)])
