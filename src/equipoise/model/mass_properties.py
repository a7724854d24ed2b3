"""Mass, centre of mass and inertia of a rigid body; what is physically possible.

    J_P = J_C + m (|r|^2 E - r r^T)                                             (parallel axes)
    Sigma = 1/2 tr(J) E - J  >  0     (second moments of mass: J > 0 and the triangle inequality)

(Ivanov 2021 Eq. 2.2 is the first line; the second is Wensing 2018 reduced to a known mass.)
"""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.presentation import Plotted

EYE = np.eye(3)
LEAST = 1e-12  # N m, of a stiffness: a balanced body swings, though for very long


def parallel_axis(mass: float, offset: Vector3) -> Matrix3:
    """Return m (|r|^2 E - r r^T), in kg m^2: the inertia of a point mass at ``offset``."""
    return mass * (offset @ offset * EYE - np.outer(offset, offset))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class MassProperties(Plotted):
    """A rigid body, referred to the point P, in body axes."""

    mass: float  # kg
    com: Vector3  # m, from P to the centre of mass
    inertia_P: Matrix3  # kg m^2, about P, tensor elements

    @property
    def first_moment(self) -> Vector3:
        """Mass times centre of mass, kg m."""
        return self.mass * self.com

    @property
    def mean_moment(self) -> float:
        """Mean moment of inertia about P, kg m^2."""
        return float(np.trace(self.inertia_P)) / 3

    def swing_time(self, gravity: float) -> float:
        """Return ``sqrt(J / m g |r|)``, s, with the mean moment: a swing's period over 2 pi."""
        stiffness = self.mass * gravity * float(np.linalg.norm(self.com))
        return float(np.sqrt(abs(self.mean_moment) / max(stiffness, LEAST)))

    @property
    def inertia_C(self) -> Matrix3:
        """Inertia about the centre of mass, kg m^2."""
        return self.inertia_P - parallel_axis(self.mass, self.com)


def from_centre(mass: float, com: Vector3, inertia_C: Matrix3) -> MassProperties:
    """Return the properties of a body whose inertia is given about its centre of mass."""
    return MassProperties(mass, com, inertia_C + parallel_axis(mass, com))


def second_moments(inertia: Matrix3) -> Matrix3:
    """Return Sigma = 1/2 tr(J) E - J, kg m^2."""
    return 0.5 * np.trace(inertia) * EYE - inertia


def inertia_from_second_moments(sigma: Matrix3) -> Matrix3:
    """Return J = tr(Sigma) E - Sigma, kg m^2: the inverse of ``second_moments``."""
    return np.trace(sigma) * EYE - sigma


def smallest_second_moment(inertia_C: Matrix3) -> float:
    """Return the least eigenvalue of Sigma; not positive means no body can have this inertia."""
    return float(np.linalg.eigvalsh(second_moments(inertia_C))[0])


def is_possible(body: MassProperties) -> bool:
    """Say whether some distribution of positive mass has these properties."""
    return body.mass > 0 and smallest_second_moment(body.inertia_C) > 0
