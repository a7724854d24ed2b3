"""Sliding masses: displacements to centre of mass, inertia and momentum, and back.

With e_i = d_i u_i on a rail through rho_i, relative to the masses at home (Ivanov 2021 Eq. 2.3 as
corrected: all about P, identity matrices restored, sign of the sum plus):

    mu(d) = mu0 + sum m_i d_i u_i
    J(d)  = J0  + sum m_i [ (2 rho_i.e_i + |e_i|^2) E - rho_i e_i^T - e_i rho_i^T - e_i e_i^T ]
          = J0  + sum (d_i A_i + d_i^2 B_i)
    h(d') = sum m_i d_i' rho_i x u_i          momentum of masses travelling along their rails

with d_i = gain_i times the command, which is what counts as displacement everywhere else. (Where
a gain is really a wrong weight, B_i has it once too often, by gain (gain - 1) m d^2: nothing
beside J.)

The way back, from a wanted shift of the centre of mass to whole steps of the motors, is a mixed
integer linear programme: least error, then least travel, inside the rails.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import scipy

from equipoise.maths.linalg import PAIRS
from equipoise.model.arrays import Floats, Matrix3, Series3, Vector3, Vector6
from equipoise.model.testbed import SlidingMass, Testbed

ERRORS, WAYS = 1e6, 1e3  # 1/m, chosen: the programme counts errors in um and ways in mm
FINE = 1e-9  # m, chosen: a step of masses that have none
ROUNDING = 1e-9  # of a step
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


def displacements_for(
    masses: Sequence[SlidingMass],
    total_mass: float,
    now: Floats,
    shift: Vector3,
    haste: float = 0.0,
) -> Floats:
    """Return displacements (m) that shift the centre of mass from where it is by ``shift`` (m).

    Rails and motor steps are kept. What cannot be reached is approached as nearly as possible:
    compare ``com_shift`` of the answer. ``haste`` weighs the longest single travel time against
    the sum of travels (mm per s).
    """
    k = len(masses)
    step = np.array([m.resolution if m.resolution > 0 else 1e-3 for m in masses])
    steps_now = now / step
    gain = mass_maps(masses).first_moment.T * step / total_mass * ERRORS  # of a step
    # unknowns: steps to go forward (k), backward (k), error over and under (3 + 3) um, time s
    order = 1.0 + 1e-3 * np.arange(k)  # of equal ways, the one that moves fewer masses
    travel = step * WAYS * order
    cost = np.concatenate([travel, travel, np.full(6, 1e4), [haste + 1e-6]])
    balance = np.hstack([gain, -gain, np.eye(3), -np.eye(3), np.zeros((3, 1))])
    seconds = np.diag(step / np.array([m.speed for m in masses]))
    clock = np.hstack([seconds, seconds, np.zeros((k, 6)), -np.ones((k, 1))])
    low = np.array([m.travel[0] for m in masses]) / step - steps_now
    high = np.array([m.travel[1] for m in masses]) / step - steps_now
    upper = np.concatenate(
        [np.floor(high + ROUNDING).clip(0), np.floor(-low + ROUNDING).clip(0), np.full(7, np.inf)]
    )
    whole = np.array([int(m.resolution > 0) for m in masses], dtype=np.int64)
    integer = np.concatenate([whole, whole, np.zeros(7, dtype=np.int64)])
    answer = scipy.optimize.milp(
        cost,
        integrality=integer,
        bounds=scipy.optimize.Bounds(np.zeros(2 * k + 7), upper),
        constraints=[
            scipy.optimize.LinearConstraint(balance, shift * ERRORS, shift * ERRORS),
            scipy.optimize.LinearConstraint(clock, -np.inf, 0.0),
        ],
    )
    assert answer.x is not None  # standing still is always allowed
    forward, backward = answer.x[:k], answer.x[k : 2 * k]
    go = np.where(whole > 0, np.round(forward - backward), forward - backward)
    return now + step * go


def gain_by_one(
    masses: Sequence[SlidingMass], total_mass: float, now: Floats, shift: Vector3
) -> float:
    """Return by how much (m) one mass alone comes nearer to a shift (m), summed over the axes.

    With whole steps on its rail, along the shift: a mass that would go too far stops before. It is
    no more than what ``displacements_for`` gains with all masses, which takes longer to find.
    """
    per_m = mass_maps(masses).first_moment / total_mass
    low, high = (np.array([m.travel[end] for m in masses]) - now for end in (0, 1))
    step = np.array([max(m.resolution, FINE) for m in masses])
    way = per_m @ shift / np.sum(per_m**2, axis=1)
    way = np.clip(way, np.minimum(low, 0.0), np.maximum(high, 0.0))
    whole = np.trunc(way / step + ROUNDING * np.sign(way)) * step
    left = shift - whole[:, None] * per_m
    gained = np.abs(shift).sum() - np.abs(left).sum(axis=1)
    return float(np.max(gained, initial=0.0))
