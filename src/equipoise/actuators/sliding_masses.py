"""Sliding masses: displacements to centre of mass, inertia and momentum.

With e_i = d_i u_i on a rail through rho_i, relative to the masses at home (Ivanov 2021 Eq. 2.3 as
corrected: all about P, identity matrices restored, sign of the sum plus):

    mu(d) = mu0 + sum m_i d_i u_i
    J(d)  = J0  + sum m_i [ (2 rho_i.e_i + |e_i|^2) E - rho_i e_i^T - e_i rho_i^T - e_i e_i^T ]
          = J0  + sum (d_i A_i + d_i^2 B_i)
    h(d') = sum m_i d_i' rho_i x u_i          momentum of masses travelling along their rails

with d_i = gain_i times the command, which is what counts as displacement everywhere else. (Where
a gain is really a wrong weight, B_i has it once too often, by gain (gain - 1) m d^2: nothing
beside J.)
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from equipoise.maths.linalg import PAIRS
from equipoise.model.arrays import Floats, Matrix3, Series3, Vector3, Vector6
from equipoise.model.testbed import SlidingMass, Testbed

PARALLEL = 0.99  # cosine, chosen: rails of one direction


def one_a_direction(masses: Sequence[SlidingMass]) -> list[SlidingMass]:
    """Return the first mass on rails of each direction."""
    found: list[SlidingMass] = []
    for mass in masses:
        if all(abs(float(mass.axis @ other.axis)) < PARALLEL for other in found):
            found.append(mass)
    return found


class MassMaps(NamedTuple):
    """The coefficients of the three sums above, one row a mass."""

    first_moment: Floats  # (k, 3) kg       m_i u_i, times the gain
    inertia_1: Floats  # (k, 6) kg m        A_i, xx yy zz xy xz yz, times the gain
    inertia_2: Floats  # (k, 6) kg          B_i, times its square
    momentum: Floats  # (k, 3) kg m         m_i rho_i x u_i, times the gain


def mass_maps(masses: Sequence[SlidingMass]) -> MassMaps:
    """Return the coefficients of these masses, in their order."""
    gain = np.array([mass.gain for mass in masses]).reshape(-1, 1)
    m = gain * np.array([mass.mass for mass in masses]).reshape(-1, 1)
    u = np.array([mass.axis for mass in masses]).reshape(-1, 3)
    rho = np.array([mass.home for mass in masses]).reshape(-1, 3)
    (i, j), a, b = np.array(PAIRS).T, (1, 2, 0), (2, 0, 1)
    unit, dot = (i == j).astype(float), np.sum(rho * u, axis=1, keepdims=True)
    return MassMaps(
        m * u,
        m * (2 * dot * unit - rho[:, i] * u[:, j] - u[:, i] * rho[:, j]),
        gain * m * (unit - u[:, i] * u[:, j]),
        m * (rho[:, a] * u[:, b] - rho[:, b] * u[:, a]),
    )


def com_shift(maps: MassMaps, total_mass: float, displacement: Floats) -> Vector3:
    """Return the shift of the centre of mass by displacements (m), m."""
    return displacement @ maps.first_moment / total_mass


def shift_by(testbed: Testbed, displacement: Floats) -> Vector3:
    """Return the shift of a testbed's centre of mass by displacements (m), m."""
    return com_shift(mass_maps(testbed.masses), testbed.body.mass, displacement)


def shift_by_travel(testbed: Testbed) -> Series3:
    """Return how far each mass of a testbed shifts the centre of mass by its travel, (k, 3)."""
    return mass_maps(testbed.masses).first_moment / testbed.body.mass


def inertia_shift(maps: MassMaps, displacement: Floats) -> Vector6:
    """Return the change of the inertia about P by displacements (m), xx yy zz xy xz yz, kg m^2."""
    return displacement @ maps.inertia_1 + displacement**2 @ maps.inertia_2


def com_shift_covariance(
    maps: MassMaps, total_mass: float, accuracy: Floats, moved: Floats
) -> Matrix3:
    """Return the covariance (m^2) of where moved masses leave the centre of mass."""
    spread: Series3 = maps.first_moment * (accuracy * moved)[:, None] / total_mass
    return spread.T @ spread
