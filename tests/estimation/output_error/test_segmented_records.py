"""Records cut into stretches that jump, against plain NumPy: motion, least squares, smoother."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.sliding_masses import inertia_shift
from equipoise.dynamics.propagation import body_of, propagate
from equipoise.dynamics.regressor import N_TORQUES
from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.estimation.output_error.problem import posed
from equipoise.estimation.output_error.segment_jumps import Jump
from equipoise.estimation.output_error.solution import evaluate, freedom, settle, smooth_at
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.estimation.parameters.fit_parameters import Unknowns, physical, unknowns_of
from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.maths.pseudo_inertia import from_inertia
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import RATE as RATES
from equipoise.model.mass_properties import parallel_axis
from equipoise.sensors.camera import N_SENSOR
from tests.support.builders import (
    ATTITUDE,
    COM,
    GRAVITY,
    INERTIA,
    MASS,
    RATE,
    maps,
    move_at,
    noisy,
    platform,
    recording,
)
from tests.support.plain_problem import noded, separation, stepped, with_errors

END = 20.0
BIASES = ("gyro_bias_x", "gyro_bias_y", "gyro_bias_z")
# masses set off at 5 s, x and y stop at 6 s, z at 10 s
JUMPS = (
    Jump(4.0, RATES, (1e-3, 2e-3, 3e-3)),
    Jump(6.0, (), ()),  # where x and y stop and the rate jumps, momentum not
    Jump(8.03, ("com_x", "com_z", "swirl"), (1e-5, 2e-5, 1e-5)),  # on the way
    Jump(13.0, (*RATES, *COM_NAMES), (1e-3,) * 3 + (1e-5,) * 3),
    Jump(16.02, BIASES, (1e-4,) * 3),
)
SIZES = np.array([  # about an sd each
    [1e-3, -2e-3, 1.5e-3, 0, 0, 0],
    [0, 0, 0, 0, 0, 0],
    [1e-5, -1e-5, 5e-6, 0, 0, 0],
    [-1e-3, 5e-4, 1e-3, 5e-6, -1e-5, 2e-5],
    [1e-4, -2e-4, 1e-4, 0, 0, 0],
])  # fmt: skip


# so firmly that the optimum is away from bodies that cannot exist
KNOWN = replace(platform(3e-4, gyro=True), inertia_sd=2e-3)


def somewhere(errors):
    """A point off the truth by some sd."""
    com = COM + np.array([2e-6, -1e-6, 5e-6])
    six = from_inertia(
        unpack_symmetric(INERTIA * [1.02, 1.01, 0.98, 1.1, 0.9, 1.2]) - parallel_axis(MASS, com)
    )
    q0 = multiply(ATTITUDE, exponential(np.array([3e-3, -2e-3, 1e-3])))
    torque = 2e-5 * (np.arange(N_TORQUES) == 7)
    error = np.array([2e-4, -3e-4, 1e-4])[:errors]
    return Unknowns(q0, RATE * 1.01, six, com, torque, np.zeros(N_SENSOR), error, np.full(3, 1e-3))


@pytest.fixture(scope="module")
def cut():
    """A noisy record, its problem with jumps, a point and the jumps there."""
    record = noisy(recording(END, move_at(5.0, END), gyro=20.0), 3, np.full(3, 1e-3))
    problem = problem_of(record, KNOWN, Params(("swirl",), jumps=JUMPS, use_prior=True))
    return record, problem, somewhere(len(problem.layout.errors))


# --- The motion -----------------------------------------------------------------------------------


def platform_after(inertia, line, node):
    """Return J and h at a node, as the travel that follows has them."""
    here, there = line.known[node], line.known[node + 1]
    speed = (there - here)[KNOWN_D : KNOWN_D + 3] / (line.t[node + 1] - line.t[node])
    d = here[KNOWN_D : KNOWN_D + 3]
    return unpack_symmetric(inertia + inertia_shift(maps(), d)), speed @ maps().momentum


def pieced(problem, point, jumps):
    """Return attitudes, rates and bias at every node, stretch by stretch; at a cut, after it.

    H goes on but for J times the jump of the rate; J goes on when the centre of mass jumps.
    """
    line = problem.line._replace(known=with_errors(problem, point.error))
    edges = [*np.searchsorted(line.t, [jump.t for jump in problem.jumps]), len(line.t) - 1]
    inertia, com = pack_symmetric(point.body(MASS).inertia_P), point.com.copy()
    q, w, torque, bias = point.q0, point.w0, point.torque.copy(), point.bias.copy()
    whole = [np.zeros((len(line.t), n)) for n in (4, 3, 3)]
    first = 0
    for k, last in enumerate(edges):
        nodes = slice(first, last + 1)
        part = line._replace(t=line.t[nodes], known=line.known[nodes])
        rigid = body_of(MASS, GRAVITY, inertia, MASS * com, torque)
        motion = propagate(rigid, problem.maps, part, q, w)
        whole[0][nodes], whole[1][nodes], whole[2][nodes] = motion.q, motion.rate, bias
        if k < len(problem.jumps):
            by_name = dict(zip(problem.jumps[k].names, jumps[k], strict=False))
            J, h = platform_after(inertia, line, last)
            q = motion.q[-1]
            w = np.linalg.solve(J, motion.momentum[-1] - h) + [by_name.get(n, 0) for n in RATES]
            com = com + [by_name.get(n, 0) for n in COM_NAMES]
            bias = bias + [by_name.get(n, 0) for n in BIASES]
            torque[7] += by_name.get("swirl", 0)
            first = last
    return whole


def test_residuals_are_those_of_a_motion_in_pieces(cut):
    """Every kind of jump, before, on the way of and after a move; rows at a cut see it jumped."""
    record, problem, point = cut
    problem = noded(problem, record)
    q, w, bias = pieced(problem, point, SIZES)
    at, observed = evaluate(problem, point, SIZES), problem.observed
    e_q = difference(observed.attitude, q[observed.attitude_node]) / observed.attitude_sd
    k = observed.rate_node
    e_w = (observed.rate - w[k] - bias[k]) / observed.rate_sd
    np.testing.assert_allclose(at.left_q, e_q, rtol=0, atol=1e-8)
    np.testing.assert_allclose(at.left_w, e_w, rtol=0, atol=1e-8)
    unmoved = evaluate(problem, point, np.zeros_like(SIZES))
    assert np.abs(at.left_w - unmoved.left_w).max() > 10


def test_no_jump_allowed_is_the_uncut_fit(cut):
    """Cuts at nodes that are there anyway, among them where travel begins and where it ends.

    The same numbers but for the order of sums: momentum goes on where the rate jumps.
    """
    record, _, point = cut
    whole = problem_of(record, platform(3e-4, gyro=True), Params(("swirl",)))
    t = whole.line.t
    assert {5.0, 6.0, 10.0} <= set(t)
    times = sorted({5.0, 6.0, 10.0, *t[5:-1:7]})
    parts = replace(whole, jumps=tuple(Jump(float(s), (), ()) for s in times))
    one, many = evaluate(whole, point), evaluate(parts, point)
    np.testing.assert_allclose(many.left_q, one.left_q, rtol=0, atol=1e-9)
    np.testing.assert_allclose(many.left_w, one.left_w, rtol=0, atol=1e-9)
    assert many.cost == pytest.approx(one.cost, rel=1e-12)
    unit = 1 / np.sqrt(np.diag(one.normal))
    scaled = [A * np.outer(unit, unit) for A in (many.normal, one.normal)]
    np.testing.assert_allclose(*scaled, rtol=0, atol=1e-10)
    fits = [settle(problem, point) for problem in (whole, parts)]
    assert fits[1].at.cost == pytest.approx(fits[0].at.cost, rel=1e-10)
    assert (
        np.abs(separation(whole, *(fit.point for fit in fits)) / deviations(fits[0])).max() < 1e-3
    )


def test_two_jumps_within_rounding_of_each_other_both_act(cut):
    """As one jump of all their coordinates."""
    record, _, point = cut
    one = (Jump(8.0, (*RATES, "com_x"), (1e-3,) * 3 + (1e-5,)),)
    two = (Jump(8.0, RATES, (1e-3,) * 3), Jump(8.0 + 1e-12, ("com_x",), (1e-5,)))
    problems = [problem_of(record, KNOWN, Params(("swirl",), jumps=jumps)) for jumps in (one, two)]
    sizes = np.array([[1e-3, -2e-3, 1e-3, 1e-5]])
    costs = [evaluate(problem, point, sizes).cost for problem in problems]
    assert costs[1] == costs[0]


def test_a_mean_beside_a_cut_and_a_corner_is_a_mean(cut):
    """The exposure of a row is centred where travel ends, and a cut is a rounding later."""
    record, _, point = cut
    long = replace(KNOWN, attitude=replace(KNOWN.attitude, delay=-0.1, averaging=0.2))
    jumps = [(Jump(10.0 + dt, (), ()),) for dt in (0.0, 2e-12)]
    problems = [problem_of(record, long, Params(("swirl",), jumps=jump)) for jump in jumps]
    left = [evaluate(problem, point).left_q for problem in problems]
    np.testing.assert_allclose(*left, rtol=0, atol=1e-6)


def deviations(fit):
    return np.sqrt(np.diag(np.linalg.inv(fit.at.normal)))


# --- Least squares --------------------------------------------------------------------------------


class Dense:
    """Residuals of first stretch and all jumps at once, from a point: z = [ step | jumps ]."""

    def __init__(self, problem, point, jumps):
        self.problem, self.point, self.cuts = problem, point, posed(problem).cuts
        self.free = self.cuts.free >= 0
        self.n = problem.layout.size
        self.size = self.n + int(self.free.sum())
        self.here = np.concatenate([np.zeros(self.n), jumps[self.free]])

    def at(self, z):
        """Return point and jumps."""
        jumps = np.zeros(self.free.shape)
        jumps[self.free] = z[self.n :]
        return stepped(self.problem, self.point, z[: self.n]), jumps

    def residuals(self, z):
        """Return residuals of rows, priors and jumps in sd; half their square is the cost."""
        point, jumps = self.at(z)
        at, prior = evaluate(self.problem, point, jumps), self.problem.prior
        x = physical(point, MASS, self.problem.layout)
        x[:3] = z[:3]
        of_prior = np.sqrt(prior.weight) * (prior.mean - x)
        of_jumps = np.sqrt(self.cuts.weight) * jumps
        parts = (at.left_q.ravel(), at.left_w.ravel(), of_prior, of_jumps[self.free])
        return np.concatenate(parts)

    def by_z(self, f, sizes):
        """Return the derivatives of f by central differences."""
        steps = np.diag(sizes)
        return np.stack(
            [(f(self.here + s) - f(self.here - s)) / (2 * s.sum()) for s in steps], axis=-1
        )

    def sizes(self, share=1e-3):
        """Return steps of a share of an sd."""
        point, jumps = self.at(self.here)
        at = evaluate(self.problem, point, jumps)
        of_jumps = self.cuts.weight[self.free] ** -0.5
        return share * np.concatenate([np.diag(at.normal) ** -0.5, of_jumps])


def faultless(problem, point, jumps):
    """The same problem with a camera that says what is predicted there.

    The sensitivities of the fit leave out terms in the attitude residuals themselves.
    """
    observed = problem.observed
    left = evaluate(problem, point, jumps).left_q * observed.attitude_sd
    said = multiply(observed.attitude, exponential(-left))
    return replace(problem, observed=observed._replace(attitude=said))


def least_squares_at(problem, point, jumps):
    """Return the dense problem, its Jacobian without these terms, and its residuals."""
    full, near = (Dense(p, point, jumps) for p in (problem, faultless(problem, point, jumps)))
    return full, -near.by_z(near.residuals, full.sizes()), full.residuals(full.here)


@pytest.fixture(scope="module")
def dense(cut):
    """At a point that is no optimum."""
    _, problem, point = cut
    return least_squares_at(problem, point, SIZES)


def test_condensed_equations_are_those_of_dense_least_squares(dense):
    """The Schur complement of J^T J, and the cost."""
    full, J, e = dense
    A, b = J.T @ J, J.T @ e
    x, u = slice(0, full.n), slice(full.n, None)
    out = A[x, u] @ np.linalg.inv(A[u, u])
    normal, descent = A[x, x] - out @ A[u, x], b[x] - out @ b[u]
    found = evaluate(full.problem, *full.at(full.here))
    unit = 1 / np.sqrt(np.diag(normal))
    assert found.cost == pytest.approx(0.5 * e @ e, rel=1e-12)
    square = np.outer(unit, unit)
    np.testing.assert_allclose(found.normal * square, normal * square, rtol=0, atol=1e-5)
    largest = np.abs(descent * unit).max()
    np.testing.assert_allclose(found.descent * unit, descent * unit, rtol=0, atol=1e-5 * largest)


def test_gradient_in_the_jumps_is_that_of_the_cost(dense):
    """Chained backwards from the local models, g_k = b_k + F^T g_(k+1), against differences."""
    full, _, _ = dense
    point, jumps = full.at(full.here)
    pieces = evaluate(full.problem, point, jumps).pieces
    g, slopes = pieces.descent[-1], []
    for k in range(len(JUMPS) - 1, -1, -1):
        free = full.cuts.free[k][full.free[k]]
        slopes.append(g[free] - full.cuts.weight[k][full.free[k]] * jumps[k][full.free[k]])
        F = np.vstack([pieces.onward[k], np.eye(full.n)[6:]])
        g = pieces.descent[k] + F.T @ g

    def cost(z):
        return evaluate(full.problem, *full.at(z)).cost

    sizes = full.sizes()
    numeric = -full.by_z(cost, sizes)[full.n :] * sizes[full.n :]
    found = np.concatenate(slopes[::-1]) * sizes[full.n :]
    np.testing.assert_allclose(found, numeric, rtol=0, atol=1e-5 * np.abs(numeric).max())


def gauss_newton(problem, point, jumps, steps):
    """Return where plain Gauss-Newton steps of the dense problem lead."""
    for _ in range(steps):
        full, J, e = least_squares_at(problem, point, jumps)
        point, jumps = full.at(full.here + np.linalg.lstsq(J, e, rcond=None)[0])
    return point, jumps


@pytest.fixture(scope="module")
def optimum(cut):
    """Where the fit ends, to rounding; the dense least squares there; what its stretches say."""
    _, problem, point = cut
    fit = settle(problem, point)
    assert fit.converged
    there, jumps = gauss_newton(problem, fit.point, fit.jumps, 2)
    fit = replace(fit, point=there, jumps=jumps, at=evaluate(problem, there, jumps))
    return fit, least_squares_at(problem, there, jumps), smooth_at(fit)


def test_the_optimum_is_that_of_dense_least_squares(cut, optimum):
    """Undamped steps of the dense problem from the same first point; 0.01 sd is what is asked."""
    _, problem, point = cut
    fit, (full, J, _) = settle(problem, point), optimum[1]
    there, jumps = gauss_newton(problem, point, np.zeros_like(SIZES), 4)
    assert evaluate(problem, there, jumps).cost == pytest.approx(fit.at.cost, abs=1e-4)
    sd = np.sqrt(np.diag(np.linalg.inv(J.T @ J)))
    off = np.concatenate([separation(problem, fit.point, there), (jumps - fit.jumps)[full.free]])
    assert np.abs(off / sd).max() < 0.01


def test_covariance_of_every_stretch_is_of_the_dense_inverse(optimum):
    """Where each stretch begins, by differences of the whole motion in all unknowns."""
    fit, (full, J, _), after = optimum
    spread = np.linalg.inv(J.T @ J)
    points = [unknowns_of(p) for p in after.points]

    def beginnings(z):
        there = [unknowns_of(p) for p in evaluate(fit.problem, *full.at(z)).pieces.points]
        return np.array([separation(fit.problem, a, b) for a, b in zip(points, there, strict=True)])

    by_z = full.by_z(beginnings, full.sizes())
    for M, C in zip(by_z, after.covariance, strict=True):
        expected = M @ spread @ M.T
        unit = 1 / np.sqrt(np.diag(expected))
        found, wanted = (A * np.outer(unit, unit) for A in (C, expected))
        np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-6)
    across = by_z[-1] @ spread @ by_z[0].T
    sizes = np.sqrt(np.outer(np.diag(after.covariance[-1]), np.diag(after.covariance[0])))
    found = after.onward @ after.covariance[0]
    np.testing.assert_allclose(found / sizes, across / sizes, rtol=0, atol=1e-6)


def test_covariance_of_every_jump_is_of_the_dense_inverse(optimum):
    """And with it, by how many unknowns the jumps loosen the fit."""
    fit, (full, J, _), after = optimum
    spread = np.linalg.inv(J.T @ J)[full.n :, full.n :]
    ends = np.cumsum(full.free.sum(axis=1))
    for k, end in enumerate(ends):
        a = int(full.free[k].sum())
        wanted = spread[end - a : end, end - a : end]
        unit = np.diag(wanted) ** -0.5
        found = after.jump_covariance[k, :a, :a] * np.outer(unit, unit)
        np.testing.assert_allclose(found, wanted * np.outer(unit, unit), rtol=0, atol=1e-6)
    weight = full.cuts.weight[full.free]
    reported = np.sum(1 - np.diag(spread) * weight)
    assert freedom(fit, after) == pytest.approx(reported, rel=1e-6)
    assert 3 < reported < weight.size


def test_score_of_a_stretch_pulls_as_the_jumps_before_it_do(optimum):
    """At the optimum the rows behind a cut pull each jump as its prior holds it: p = u / sd^2."""
    fit, (full, _, _), after = optimum
    for k, free in enumerate(full.cuts.free):
        a = free >= 0
        held = full.cuts.weight[k, a] * fit.jumps[k, a]
        np.testing.assert_allclose(after.score[k + 1, free[a]], held, rtol=1e-3)
