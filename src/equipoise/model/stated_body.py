"""Mass properties as one tool hands them to another: with their covariance, and what they rest on.

    J_C = J_P - m (|r|^2 E - r r^T),      dJ_C = dJ_P - m (2 (r . dr) E - dr r^T - r dr^T)
                                                 - dm (|r|^2 E - r r^T)

The second line gives the covariance about the centre of mass C from that about P.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Floats, Matrix3, Square, Vector3
from equipoise.model.estimate import BODY
from equipoise.model.mass_properties import EYE, MassProperties

SIX = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))  # xx, yy, zz, xy, xz, yz


@dataclass(frozen=True, slots=True, eq=False)
class StatedBody:
    """A rigid body for exchange; ``covariance`` is in the order mass, ``BODY``, SI.

    What the data do not show has an infinite variance.
    """

    name: str
    body: MassProperties
    covariance: Square  # (10, 10)
    remarks: tuple[str, ...] = ()  # where it comes from, and what it does not say

    @property
    def about_P(self) -> Floats:
        """Inertia about P, kg m^2: xx, yy, zz, xy, xz, yz."""
        return elements(self.body.inertia_P)

    @property
    def about_C(self) -> Floats:
        """Inertia about the centre of mass, kg m^2: xx, yy, zz, xy, xz, yz."""
        return elements(self.body.inertia_C)

    @property
    def covariance_about_C(self) -> Square:
        """Covariance in the same order, with the inertia about the centre of mass."""
        jacobian = np.eye(10)
        jacobian[1:7] -= shift_jacobian(self.body.mass, self.body.com)
        return propagated(jacobian, self.covariance)


def elements(tensor: Matrix3) -> Floats:
    """Return the elements xx, yy, zz, xy, xz, yz."""
    return np.array([tensor[i, j] for i, j in SIX])


def tensor_of(six: Floats) -> Matrix3:
    """Return the symmetric tensor of the elements xx, yy, zz, xy, xz, yz."""
    xx, yy, zz, xy, xz, yz = six
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def shift_jacobian(mass: float, com: Vector3) -> Floats:
    """Return the derivatives (6, 10) of the parallel-axis term by mass, inertia_P and com."""
    found = np.zeros((6, 10))
    found[:, 0] = elements(com @ com * EYE - np.outer(com, com))
    for axis in range(3):
        cross = np.outer(EYE[axis], com)
        found[:, 7 + axis] = elements(mass * (2 * com[axis] * EYE - cross - cross.T))
    return found


def propagated(jacobian: Floats, covariance: Square) -> Square:
    """Return J S J^T, where an infinite variance spoils only what depends on it."""
    infinite = np.isinf(np.diag(covariance))
    finite = np.where(infinite[:, None] | infinite, 0.0, covariance)
    found = jacobian @ finite @ jacobian.T
    lost = (np.abs(jacobian[:, infinite]) > 0).any(axis=1)
    found[lost, lost] = np.inf
    return found


def order() -> tuple[str, ...]:
    """Return the names of the covariance's rows."""
    return ("mass", *BODY)
