"""Sag and drift that a law found, for masses to follow after it has ended."""

from dataclasses import dataclass

from equipoise.model.arrays import Matrix3, Vector3


@dataclass(frozen=True, slots=True, eq=False)
class Following:
    """Where masses stand when the platform is level, and what asks them elsewhere."""

    shift: Vector3  # m, of the centre of mass by the masses, counted from home, level, at time t
    t: float  # s
    drift: Vector3  # m/s, of the centre of mass
    sag: Matrix3  # m, C: the centre of mass moves by C n, n along gravity
    trim: Vector3  # m, the part of the shift that makes up for sag as well as standing masses can
