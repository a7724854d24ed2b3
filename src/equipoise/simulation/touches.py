"""When a simulated platform touched its stop, and how hard."""

from dataclasses import dataclass, field

import numpy as np

from equipoise.model.arrays import Floats, Series1, Vector3

TOGETHER = 0.5  # s, chosen: the stop pushes again so soon: the same touch


@dataclass(frozen=True, slots=True, eq=False)
class Touch:
    """The platform touches its stop, or lies on it for a while."""

    start: float  # s
    end: float  # s
    impulse: Vector3  # N m s, about P, laboratory axes


@dataclass(frozen=True, slots=True, eq=False)
class Noted:
    """Rows of ``Path.touch`` so far: up to a node, and since then, which comes again."""

    until: float = 0.0  # s, the node
    before: Floats = field(default_factory=lambda: np.zeros((0, 4)))
    since: Floats = field(default_factory=lambda: np.zeros((0, 4)))

    @property
    def touches(self) -> tuple[Touch, ...]:
        """Return the touches in order of time."""
        rows = np.vstack([self.before, self.since])
        fresh = np.flatnonzero(rows[1:, 0] - rows[:-1, 1] > TOGETHER) + 1
        return tuple(_touch(part) for part in np.split(rows, fresh) if len(part))


def _touch(rows: Floats) -> Touch:
    impulse = np.append(rows[:, 2:].sum(axis=0), 0.0)  # the stop is level: none about the vertical
    return Touch(float(rows[0, 0]), float(rows[-1, 1]), impulse)


def noted(earlier: Noted, t: Series1, touch: Floats, now: float) -> Noted:
    """Return what is known after a run along nodes ``t`` (s), and to ``now`` by a row more."""
    new, last = touch[:-1][t > earlier.until], touch[-1:]
    before = np.vstack([earlier.before, new[new[:, 2:].any(axis=1)]])
    return Noted(float(t[-1]), before, last[last[:, 2:].any(axis=1) & (now > t[-1])])
