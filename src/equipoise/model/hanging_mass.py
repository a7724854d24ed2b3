"""A mass that hangs within a platform: a pendulum in one plane, with a spring at its pivot.

A loose cable or a liquid that moves to one side follows the vertical; what bends does so little.
With lever c = m l / M (m the mass, l from its pivot, M the platform) and spring share k = K / (K +
m g l) of how stiffly it is held, it sags by c (1 - k) for small swings:

    k = 0   a pendulum: gravity acts at its pivot, at any tilt
    k = 1   a part that bends

A mass that hangs in all directions alike acts as one at its pivot, and is not seen.
"""

from dataclasses import dataclass

NAMES = ("hanging_sag", "hanging_heading", "hanging_spring")  # m, rad, -; as an estimate has them


@dataclass(frozen=True, slots=True)
class HangingMass:
    """A mass that hangs, as the platform shows it; at rest when it is level."""

    sag: float  # m, of com to the side for a small tilt, per rad
    heading: float  # rad, of the side to which it swings, from x to y about the vertical
    spring: float  # -, share of the spring in what holds it

    @property
    def lever(self) -> float:
        """Return c = m l / M, m: how far gravity would lift com if it acted at the pivot."""
        return self.sag / (1.0 - self.spring)
