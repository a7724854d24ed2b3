"""Modes of a platform that is not rigid: an appendage that bends, a liquid that sloshes.

A mode is one oscillator within the platform, with modal coordinate e (sqrt(kg) m):

    coupling d  (sqrt(kg) m)   d e' is its angular momentum about P beside that of the rigid motion
    moment s    (sqrt(kg))     s e is what it adds to the first moment; 0 of an appendage that bends
                               to both sides alike

A part of inertia I about an axis a that turns by theta against the platform has d = sqrt(I) a and
e = sqrt(I) theta; a mass m that slides by x along n, at r from P, d = sqrt(m) r x n, s = sqrt(m) n
and e = sqrt(m) x.
"""

from dataclasses import dataclass, field

import numpy as np

from equipoise.model.arrays import Vector3
from equipoise.model.defects import nothing


@dataclass(frozen=True, slots=True, eq=False)
class Mode:
    """One mode, and how it moves at the beginning."""

    frequency: float  # Hz, of the mode while the platform is held
    damping: float  # -, share of the critical damping
    coupling: Vector3  # sqrt(kg) m
    moment: Vector3 = field(default_factory=nothing)  # sqrt(kg)
    deflection: float = 0.0  # sqrt(kg) m, e at the beginning, from where it rests level
    velocity: float = 0.0  # sqrt(kg) m/s, e' at the beginning

    @property
    def angular_frequency(self) -> float:
        """Frequency while the platform is held, rad/s."""
        return 2.0 * float(np.pi) * self.frequency

    @property
    def inertia(self) -> float:
        """Inertia that takes part, d.d, kg m^2."""
        return float(self.coupling @ self.coupling)
