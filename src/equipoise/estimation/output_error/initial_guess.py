"""A start for the trajectory fit, from the linear methods, so that nobody has to guess one.

The laboratory-axes momentum integral gives first moment and first momentum; the latter, not the
first noisy rate, gives the first rate. The testbed's inertia is a prior: weak with a gyro; firm
without, because rates that are differences of attitudes bias a linear estimate of J towards zero.
"""

from dataclasses import replace

import numpy as np

from equipoise.dynamics.regressor import N_TORQUES
from equipoise.estimation.motion.sampled_motion import SampledMotion, sampled_motion
from equipoise.estimation.parameters.fit_parameters import Layout, Unknowns, core_of
from equipoise.estimation.regression.formulations.columns import columns, known_momentum
from equipoise.estimation.regression.formulations.momentum import laboratory_balance
from equipoise.maths import pseudo_inertia
from equipoise.maths.attitude import to_matrix, turned_on
from equipoise.maths.linalg import element_sizes, pack_symmetric, unpack_symmetric
from equipoise.maths.scaled_solve import scaled_solve
from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.estimate import BODY
from equipoise.model.mass_properties import MassProperties, is_possible, parallel_axis
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.sensors.camera import N_SENSOR

WITH_GYRO = 0.3  # relative sd given to the testbed's inertia, chosen: a first CAD model
WITHOUT = 1e-3  # chosen: firm
COM_TRUST = 3e-4  # m, least sd of the testbed's centre of mass
MOMENTUM_SIZE = 0.1  # rad/s, by the largest moment: natural to the first momentum, for scaling
CORRELATED = 5.0  # chosen: smoothed rates err together over some 25 rows, so rows count as fewer


def start(
    recording: Recording,
    testbed: Testbed,
    layout: Layout,
    first: float,
    hold: tuple[str, ...] = (),
) -> Unknowns:
    """Return a point near the optimum; ``first`` is the time (s) of the first node."""
    motion = sampled_motion(recording, testbed)
    inertia, com, momentum = possible_solution(recording, testbed, motion)
    w0 = first_rate(recording, testbed, motion, inertia, momentum)
    inertia, com = kept(inertia, com, testbed, hold)
    inertia_C = inertia - parallel_axis(testbed.body.mass, com)
    q0 = turned_on(motion.q[0], w0, first - motion.t[0])
    return Unknowns(
        q0, w0, pseudo_inertia.from_inertia(inertia_C), com,
        np.zeros(N_TORQUES), np.zeros(N_SENSOR), np.zeros(len(layout.errors)), np.zeros(3),
    )  # fmt: skip


def as_measured(recording: Recording, testbed: Testbed, first: float, point: Unknowns) -> Unknowns:
    """Return a point with the attitude and rate that are measured; ``first``: when it begins, s.

    Of a slender body the first momentum says little of the rate: its error over the least moment is
    larger than that of a gyro's row by far.
    """
    motion = sampled_motion(recording, testbed)
    w0 = motion.w[0]
    return replace(point, q0=turned_on(motion.q[0], w0, first - motion.t[0]), w0=w0)


def stated_body(testbed: Testbed, beside: Unknowns) -> Unknowns:
    """Return the testbed's body, with the motion and the size of other unknowns, all zero."""
    body = testbed.body
    inertia_C = body.inertia_P - parallel_axis(body.mass, body.com)
    return replace(
        beside,
        six=pseudo_inertia.from_inertia(inertia_C),
        com=body.com,
        torque=np.zeros_like(beside.torque),
        sensor=np.zeros_like(beside.sensor),
        error=np.zeros_like(beside.error),
    )


def possible_solution(
    recording: Recording, testbed: Testbed, motion: SampledMotion
) -> tuple[Matrix3, Vector3, Vector3]:
    """Return inertia, centre of mass and first momentum of a body that can exist.

    Gross errors and gaps can make the rows' own inertia impossible, nearly singular even, and the
    first rate with it; the testbed's is held then, and momentum and com are found beside it.
    """
    body = testbed.body
    found = solve(recording, testbed, motion, WITHOUT if recording.rate is None else WITH_GYRO)
    if not is_possible(MassProperties(body.mass, found[1], found[0])):
        found = solve(recording, testbed, motion, WITHOUT)
    if not is_possible(MassProperties(body.mass, found[1], found[0])):
        found = body.inertia_P, body.com, found[2]
    return found


def kept(
    inertia: Matrix3, com: Vector3, testbed: Testbed, hold: tuple[str, ...]
) -> tuple[Matrix3, Vector3]:
    """Return J and com with held entries at the testbed's value, the rest stretched to match."""
    found, wanted = (
        np.concatenate([pack_symmetric(J), r])
        for J, r in ((inertia, com), (testbed.body.inertia_P, testbed.body.com))
    )
    for name in hold:
        k = BODY.index(name)
        stretch = wanted[k] / found[k] if wanted[k] * found[k] > 0 else 1.0
        found *= stretch if name == hold[0] else 1.0
        found[k] = wanted[k]
    return unpack_symmetric(found[:6]), found[6:]


def first_rate(
    recording: Recording,
    testbed: Testbed,
    motion: SampledMotion,
    inertia: Matrix3,
    momentum_N: Vector3,
) -> Vector3:
    """Return w(t0) = J^-1 (R^T H0_N - k), rad/s."""
    k, _ = known_momentum(recording, testbed, motion.t[:3], motion.w[:3])
    momentum: Vector3 = to_matrix(motion.q[0]).T @ momentum_N - k[0]
    return np.linalg.solve(inertia, momentum).astype(np.float64, copy=False)


def free_rows(
    recording: Recording, testbed: Testbed, motion: SampledMotion
) -> tuple[Floats, Floats]:
    """Return regressor (3 n, 12) and known side (3 n,) by J, com and the first momentum."""
    whole = np.zeros(len(motion.t), np.int64)
    A, b = laboratory_balance(motion.t, whole, columns(recording, testbed, motion))
    constants = -np.broadcast_to(np.eye(3), (len(b), 3, 3))
    return np.concatenate([A, constants], axis=2).reshape(-1, 12), b.reshape(-1)


def solve(
    recording: Recording, testbed: Testbed, motion: SampledMotion, trust: float
) -> tuple[Matrix3, Vector3, Vector3]:
    """Return inertia, centre of mass, and the first momentum in laboratory axes.

    ``trust`` is the relative sd given to the testbed's inertia.
    """
    regressor, known = free_rows(recording, testbed, motion)
    body = testbed.body
    sizes = element_sizes(body.inertia_P)
    spread = np.concatenate([trust * sizes, np.maximum(3 * testbed.com_sd, COM_TRUST)])
    guess = core_of(body)
    scale = np.append(spread, np.full(3, MOMENTUM_SIZE * float(sizes.max())))
    A = regressor * scale
    normal, right = A.T @ A, A.T @ known
    # with the inertia as guessed, what misfit is left decides how much the priors weigh
    free = right[6:] - normal[6:, :6] @ (guess / spread)[:6]
    rest = scaled_solve(np.ascontiguousarray(normal[6:, 6:]), free, 1e-10)
    left = known - A @ np.concatenate([(guess / spread)[:6], rest])
    noise = max(CORRELATED * float(np.sqrt(np.mean(left**2))), 1e-9)
    prior = np.append(np.ones(9), np.zeros(3))
    pull = np.append(guess / spread, np.zeros(3))
    best = scale * scaled_solve(normal / noise**2 + np.diag(prior), right / noise**2 + pull, 0.0)
    return unpack_symmetric(best[:6]), best[6:9], best[9:12]
