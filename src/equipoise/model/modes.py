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

from equipoise.model.arrays import Matrix3, Vector3
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


@dataclass(frozen=True, slots=True, eq=False)
class FreeMode:
    """A mode as a platform that is free to turn shows it.

    Of the inertia J, the share k = d.J^-1 d that takes part raises frequency and damping: those of
    the part while the platform is held are (1 - k)^(1/2) times these.
    """

    frequency: float  # Hz
    damping: float  # -, share of the critical damping
    coupling: Vector3  # sqrt(kg) m, d
    deflection: float = 0.0  # sqrt(kg) m, e at the beginning
    velocity: float = 0.0  # sqrt(kg) m/s, e' at the beginning


MOST_SHARE = 0.9  # chosen: more than nine tenths of a platform are no part of it


def share_of(coupling: Vector3, inertia_P: Matrix3) -> float:
    """Return k = d.J^-1 d of a platform of this inertia (kg m^2)."""
    return float(coupling @ np.linalg.solve(inertia_P, coupling))


def held(mode: FreeMode, inertia_P: Matrix3) -> Mode:
    """Return a mode as it is while the platform, of this inertia (kg m^2, about P), is held.

    A coupling of more than ``MOST_SHARE`` is taken for one of that share.
    """
    share = share_of(mode.coupling, inertia_P)
    smaller = min(MOST_SHARE / max(share, MOST_SHARE), 1.0) ** 0.5
    slower = (1.0 - min(share, MOST_SHARE)) ** 0.5
    return Mode(
        slower * mode.frequency,
        slower * mode.damping,
        smaller * mode.coupling,
        deflection=mode.deflection,
        velocity=mode.velocity,
    )


def freed(mode: Mode, inertia_P: Matrix3) -> FreeMode:
    """Return a mode without a moment as a free platform of this inertia (kg m^2) shows it."""
    faster = (1.0 - share_of(mode.coupling, inertia_P)) ** -0.5
    return FreeMode(
        faster * mode.frequency,
        faster * mode.damping,
        mode.coupling,
        mode.deflection,
        mode.velocity,
    )
