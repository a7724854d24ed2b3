"""Long moves cut into legs, so that a board never holds more than two legs of one.

Each mass goes at its own speed until it is there, as on a simulated bench: a leg ends when the
first mass arrives, or after ``LEG``. If a mass crept along for as long as the slowest needs, the
detection of moves in a recording would miss it.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from equipoise.hardware.transport.driver_protocol import LEG

SLOWING = 0.1  # s, chosen: a mass that takes longer to stop is beyond its leg when it must halt
HAIR = 1e-7  # m, chosen: a way shorter than any step is none


@dataclass(frozen=True, slots=True)
class Way:
    """A leg: where masses go (m), and the time that it takes (s)."""

    to: Mapping[str, float]
    duration: float


def next_leg(
    here: Mapping[str, float], goal: Mapping[str, float], speed: Mapping[str, float]
) -> Way | None:
    """Return the next leg from where masses will be, at ``speed`` m/s; None if they are there."""
    ways = {name: goal[name] - here[name] for name in goal}
    ways = {name: way for name, way in ways.items() if abs(way) > HAIR}
    if not ways:
        return None
    left = {name: abs(way) / speed[name] for name, way in ways.items()}
    taken = min([LEG, *left.values()])
    to = {
        name: goal[name] if left[name] <= taken else here[name] + way * taken / left[name]
        for name, way in ways.items()
    }
    return Way(to, taken)


def time_left(
    here: Mapping[str, float],
    goal: Mapping[str, float],
    speed: Mapping[str, float],
    rounding: Mapping[str, float] | None = None,
) -> float:
    """Return how long masses still need to a goal, s; within ``rounding`` (m) they are there.

    A slow mass needs longer for the rounding of its position than for a leg.
    """
    ways = {name: abs(goal[name] - here[name]) for name in goal}
    ways = {name: way for name, way in ways.items() if rounding is None or way > rounding[name]}
    return max((way / speed[name] for name, way in ways.items()), default=0.0)


class Pacemaker:
    """Where masses would be that go at the commanded speed from where they set off.

    A board has a least speed; masses that must be slower are led, as far ahead as a leg is long.
    """

    def __init__(self) -> None:
        self._at: dict[str, float] = {}
        self._t = 0.0

    def begin(self, at: Mapping[str, float], t: float) -> None:
        """Set off from a place at t s."""
        self._at, self._t = dict(at), t

    def led(
        self, goal: Mapping[str, float], speed: Mapping[str, float], t: float
    ) -> Mapping[str, float]:
        """Return where masses would be at t s, on their way to a goal at ``speed``."""
        passed, self._t = t - self._t, t
        for name, end in goal.items():
            way, most = end - self._at[name], passed * speed[name]
            self._at[name] += max(-most, min(most, way))
        return self._at
