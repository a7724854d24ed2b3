"""A first guess of a platform on a table: two momentum integrals, linear in the unknowns.

In the plane, integrated twice, as R (w x mu) is the derivative of R mu:

    M p + (R mu)_xy - a - b t - 1/2 M g s t^2 + sum_k c_k int ( int phi_k dp ) = 0

a, b are free. Positions alone stand on the left, whose noise is white; none is differentiated. The
velocity of P follows from what is found. About P, in laboratory axes:

    R (J w + k) + (R mu) x v - int R mu x g - int R tau + int v x d(R mu)/dt - H_0 = 0

with known k, tau of masses, wheels and jets. The testbed's body is a weak prior of both. The first
sees mu itself, by the mass that it moves with; the second only the ratio of mu to J.
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.planar.friction_map import FrictionMap, hat_functions
from equipoise.estimation.motion.sampled_motion import SampledMotion, sampled_motion
from equipoise.estimation.planar.planar_layout import POSITION, SLOPE, VELOCITY, stated_values
from equipoise.estimation.planar.planar_problem import PlanarProblem, Point, grid_of
from equipoise.estimation.regression.formulations.columns import columns, known_momentum
from equipoise.estimation.regression.formulations.momentum import integral, laboratory_balance
from equipoise.maths.attitude import to_matrix, turned_on
from equipoise.maths.linalg import (
    element_sizes,
    pack_symmetric,
    schur_complement,
    unpack_symmetric,
)
from equipoise.maths.scaled_solve import scaled_solve
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Series, Series1, Series3, Square, Vector3
from equipoise.model.estimate import COM, INERTIA, RATE
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.recording import Recording

TRUST = 0.3  # relative sd given to the testbed's inertia, chosen: a first CAD model
FIRM = 1e-3  # the same where the record makes it impossible, chosen
BY_COM = 10.0  # sd given to its centre of mass, in stated sd, chosen: a guess may be far off
CORRELATED = 5.0  # chosen: smoothed rates err together over some 25 rows, so rows count as fewer
PLACE, SPEED, DOWNHILL, MOMENT, RUBBED = (
    slice(0, 2), slice(2, 4), slice(4, 6), slice(6, 9), slice(9, None)
)  # fmt: skip


class InPlane(NamedTuple):
    """What positions say: a, b, s, mu and c, and the information of mu with its prior."""

    found: Floats
    information: Square  # of mu, (kg m)^-2
    velocity: Series  # (n, 2) m/s, of P at the rows of the attitude


def first_point(problem: PlanarProblem, recording: Recording) -> Point:
    """Return a point near the optimum."""
    testbed, layout, table = problem.testbed, problem.layout, problem.table
    motion = sampled_motion(recording, testbed)
    plane = in_plane(problem, recording, motion)
    J, com = about_p(problem, recording, motion, plane)
    values = stated_values(layout, testbed)
    values[layout.of(*INERTIA)], values[layout.of(*COM)] = J, com
    values[layout.of(*RATE)] = motion.w[0]
    values[layout.of(*VELOCITY)] = plane.velocity[0]
    mass = testbed.body.mass + table.sled_mass
    moment = to_matrix(motion.q[0])[:2] @ plane.found[MOMENT]
    before = problem.line.t[0] - motion.t[0]
    values[layout.of(*POSITION)] = (plane.found[PLACE] - moment) / mass
    values[layout.of(*POSITION)] += before * plane.velocity[0]
    values[layout.of(*SLOPE)] = plane.found[DOWNHILL]
    values[layout.friction] = plane.found[RUBBED]
    held = problem.prior.held
    values[held] = problem.prior.mean[held]
    return Point(turned_on(motion.q[0], motion.w[0], before), values)


def rubbing(t: Series1, p: Series, grid: FrictionMap) -> tuple[Floats, Floats]:
    """Return int phi_k dp and its integral over time, both (n, 2, nodes), along a path p (m).

    The line integral is exact for a path that is straight between its rows but for where it crosses
    the edge of a cell.
    """
    along = hat_functions(grid, 0.5 * (p[1:] + p[:-1]))
    parts = np.diff(p, axis=0)[:, :, None] * along[:, None, :]
    once = np.concatenate([np.zeros_like(parts[:1]), np.cumsum(parts, axis=0)])
    return once, integral(t, once)


def in_plane(problem: PlanarProblem, recording: Recording, motion: SampledMotion) -> InPlane:
    """Return what positions say, read along straight lines at the attitude's times."""
    testbed, table, layout = problem.testbed, problem.table, problem.layout
    rows, sensor = recording.position, testbed.position
    assert rows is not None
    assert sensor is not None
    t, mass = motion.t - motion.t[0], testbed.body.mass + table.sled_mass
    p, R = read_at(motion.t, rows.t - sensor.delay, rows.values), to_matrix(motion.q)
    once, twice = rubbing(t, p, grid_of(table, np.zeros((layout.nodes, layout.nodes))))
    A = np.zeros((len(t), 2, RUBBED.start + layout.nodes**2))
    for axis in range(2):
        A[:, axis, PLACE.start + axis], A[:, axis, SPEED.start + axis] = -1.0, -t
        A[:, axis, DOWNHILL.start + axis] = -0.5 * mass * testbed.gravity * t**2
    A[:, :, MOMENT], A[:, :, RUBBED] = R[:, :2], twice
    _, dmu = known_momentum(recording, testbed, motion.t, motion.w)
    known = -mass * p - np.einsum("nij,nj->ni", R[:, :2], dmu)
    rows_A, sd = A.reshape(-1, A.shape[2]) / (mass * sensor.noise), mass * sensor.noise
    weight, toward = plane_prior(problem, float(t[-1]))
    data, right = rows_A.T @ rows_A, rows_A.T @ known.ravel() / sd
    found = scaled_solve(data + np.diag(weight), right + weight * toward, 0.0)
    left: Floats = rows_A @ found - known.ravel() / sd  # noise, and a map too coarse
    normal = data / max(float(np.mean(left**2)), 1.0) + np.diag(weight)
    pulled: Series = mass * testbed.gravity * found[DOWNHILL] * t[:, None]
    momentum: Series = found[SPEED] + pulled - once @ found[RUBBED]
    turning: Series = np.einsum("nij,nj->ni", R[:, :2], np.cross(motion.w, found[MOMENT] + dmu))
    own, everything = range(*MOMENT.indices(len(normal))), range(len(normal))
    others = [k for k in everything if k not in own]
    velocity: Series = (momentum - turning) / mass
    return InPlane(found, schur_complement(normal, own, others), velocity)


def plane_prior(problem: PlanarProblem, duration: float) -> tuple[Floats, Floats]:
    """Return weights and means: of slope and first moment as stated, of friction very wide."""
    testbed, table, layout = problem.testbed, problem.table, problem.layout
    mass = testbed.body.mass
    weight = np.zeros(RUBBED.start + layout.nodes**2)
    weight[DOWNHILL] = table.slope_sd**-2
    weight[MOMENT] = (BY_COM * mass * testbed.com_sd) ** -2.0
    weight[RUBBED] = (duration / (mass + table.sled_mass)) ** 2
    mean = np.zeros_like(weight)
    mean[MOMENT] = testbed.body.first_moment
    return weight, mean


def about_p(
    problem: PlanarProblem, recording: Recording, motion: SampledMotion, plane: InPlane
) -> tuple[Floats, Vector3]:
    """Return J xx yy zz xy xz yz and com of a body that can exist, with J firm where need be."""
    mass, rows = problem.testbed.body.mass, rotation_rows(problem, recording, motion, plane)
    for trust in (TRUST, FIRM):
        J, com = solved(problem, rows, plane, trust)
        if is_possible(MassProperties(mass, com, unpack_symmetric(J))):
            return J, com
    return pack_symmetric(problem.testbed.body.inertia_P), problem.testbed.body.com


def solved(
    problem: PlanarProblem, rows: tuple[Floats, Floats], plane: InPlane, trust: float
) -> tuple[Floats, Vector3]:
    """Return J and com; ``trust`` is the relative sd given to the testbed's inertia."""
    testbed, (regressor, known) = problem.testbed, rows
    mass, stated = testbed.body.mass, pack_symmetric(testbed.body.inertia_P)
    weight = np.zeros((12, 12))
    weight[:6, :6] = np.diag((trust * element_sizes(testbed.body.inertia_P)) ** -2.0)
    weight[6:9, 6:9] = plane.information * mass**2
    mean = np.concatenate([stated, plane.found[MOMENT] / mass, np.zeros(3)])
    free, toward = regressor[:, 9:], known - regressor[:, :9] @ mean[:9]
    first = np.linalg.lstsq(free, toward)[0].astype(np.float64, copy=False)
    best = np.append(mean[:9], first)
    for _ in range(3):  # the first noise is that of a wrong body
        left = known - regressor @ best
        noise = max(CORRELATED * float(np.sqrt(np.mean(left**2))), 1e-9)
        normal = regressor.T @ regressor / noise**2 + weight
        best = scaled_solve(normal, regressor.T @ known / noise**2 + weight @ mean, 0.0)
    return best[:6], best[6:9]


def rotation_rows(
    problem: PlanarProblem, recording: Recording, motion: SampledMotion, plane: InPlane
) -> tuple[Floats, Floats]:
    """Return regressor (3 n, 12) and known side (3 n,) by J, com and H_0."""
    testbed, n = problem.testbed, len(motion.t)
    at = columns(recording, testbed, motion)
    A, b = laboratory_balance(motion.t, np.zeros(n, np.int64), at)
    v: Series3 = np.column_stack([plane.velocity, np.zeros(n)])
    _, dmu = known_momentum(recording, testbed, motion.t, motion.w)
    unit = np.broadcast_to(np.eye(3), (n, 3, 3))
    pull = testbed.gravity * np.append(plane.found[DOWNHILL], 0.0)
    by_com = testbed.body.mass * carried(motion, v, pull, unit)
    whole = np.concatenate([A[:, :, :6], A[:, :, 6:9] + by_com, -unit], axis=2)
    known = b - carried(motion, v, pull, dmu[:, :, None])[:, :, 0]
    return whole.reshape(-1, 12), known.reshape(-1)


def carried(motion: SampledMotion, v: Series3, pull: Vector3, moments: Floats) -> Floats:
    """Return (R mu) x v + int v x R (w x mu) - int (R mu) x g s, g s being the pull downhill.

    Of first moments (n, 3, k), one a column. A sled that slides freely loses the last two alike.
    """
    R = to_matrix(motion.q)
    turned, turning = R @ moments, R @ np.cross(motion.w[:, :, None], moments, axis=1)
    flow = np.cross(v[:, :, None], turning, axis=1) - np.cross(turned, pull[None, :, None], axis=1)
    return np.cross(turned, v[:, :, None], axis=1) + integral(motion.t, flow)
