"""The compiled pass against plain NumPy, and its gradient against the cost itself."""

from dataclasses import replace

import numpy as np
import pytest
from builders import (
    ATTITUDE,
    COM,
    GRAVITY,
    INERTIA,
    MASS,
    RATE,
    move_at,
    noisy,
    platform,
    recording,
)

from equipoise.dynamics.propagation import body_of, propagate
from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.dynamics.timeline import timeline
from equipoise.estimation.point_steps import retract
from equipoise.estimation.trajectory import HUBER, Params, problem_of
from equipoise.estimation.trajectory_problem import evaluate
from equipoise.estimation.unknowns import FIXED, R, Unknowns, unknowns_of
from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.maths.pseudo_inertia import from_inertia
from equipoise.model.mass_properties import parallel_axis
from equipoise.model.recording import Recording, Samples
from equipoise.model.torque_terms import expand

EVERY_TERM = expand(("viscous", "quadratic", "constant", "swirl", "sag", "drift"))
BIAS = np.array([2e-3, -1e-3, 3e-3])


def with_outliers(record: Recording) -> Recording:
    """Every twelfth camera row and every thirtieth gyro row is far off."""
    rng = np.random.default_rng(4)
    q, w = record.attitude.values.copy(), record.rate.values.copy()
    q[::12] = multiply(q[::12], exponential(rng.normal(scale=0.1, size=(len(q[::12]), 3))))
    w[::30] += rng.normal(scale=5e-3, size=(len(w[::30]), 3))
    return replace(record, attitude=Samples(record.attitude.t, q), rate=Samples(record.rate.t, w))


def somewhere(errors: int) -> Unknowns:
    """A point off the truth by some sd in everything."""
    com = COM + np.array([2e-6, -1e-6, 5e-6])
    inertia = unpack_symmetric(INERTIA * [1.02, 1.01, 0.98, 1.1, 0.9, 1.2])
    six = from_inertia(inertia - parallel_axis(MASS, com))
    q0 = multiply(ATTITUDE, exponential(np.array([3e-3, -2e-3, 1e-3])))
    torque = np.array([2, 3, 1, 20, 0.1, -0.2, 0.03, 0.2, 0, 0, 0, 0, 0, 0, 0, 0]) * 1e-4
    torque[8:] = np.array([3, -2, 4, 1, -5, 0.1, -0.2, 0.05]) * 1e-7
    error = np.array([2e-4, -3e-4, 1e-4])[:errors]
    return Unknowns(q0, RATE * 1.01, six, com, torque, np.zeros(24), error, BIAS)


@pytest.fixture(scope="module")
def record():
    clean = recording(20.0, move_at(5.0, 20.0), gyro=20.0)
    return with_outliers(noisy(clean, 3, BIAS))


@pytest.fixture(scope="module", params=[False, True], ids=["squares", "robust"])
def posed(request, record):
    """A problem with every optional unknown, and a point."""
    params = Params(EVERY_TERM, robust=request.param)
    problem = noded(problem_of(record, platform(3e-4, gyro=True), params), record)
    return problem, somewhere(len(problem.layout.errors))


def noded(problem, record):
    """The same problem with a node at every row, where the plain propagator can be compared."""
    line = timeline(
        record.attitude.t, record.rate.t, record.masses, len(problem.maps.momentum), 1.0,
        record.momentum, record.torque, problem.stops.felt, problem.stops.owner,
    )  # fmt: skip
    seen = problem.seen._replace(
        attitude_node=line.attitude_node,
        attitude_share=line.attitude_share,
        rate_node=line.rate_node,
        rate_share=line.rate_share,
    )
    return replace(problem, line=line, seen=seen)


def test_reading_between_steps_agrees_with_steps_to_every_row(posed, record):
    """The state between steps is good to a tenth of what all rows together can tell: an error of
    0.1 / sqrt(rows) sd in every row at once."""
    problem, point = posed
    between = problem_of(record, platform(3e-4, gyro=True), Params(EVERY_TERM))
    exact = evaluate(replace(problem, limit=0.0), point)
    found = evaluate(between, point)
    assert len(between.line.t) < len(problem.line.t)
    assert np.abs(found.left_q - exact.left_q).max() < 0.1 / np.sqrt(len(exact.left_q))
    assert np.abs(found.left_w - exact.left_w).max() < 0.1 / np.sqrt(len(exact.left_w))


def with_errors(problem, error):
    """Return the known inputs with the masses where they really stop."""
    known, k = problem.line.known.copy(), len(problem.maps.momentum)
    for j, owner in enumerate(problem.stops.owner):
        known[:, KNOWN_D + owner] += error[j] * known[:, KNOWN_D + k + j]
    return known


def predicted(problem, point):
    """Return the motion with sensitivities by com (not first moment), one column an unknown."""
    rigid = body_of(MASS, GRAVITY, pack_symmetric(point.body(MASS).inertia_P), MASS * point.com,
                    point.torque)  # fmt: skip
    line = problem.line._replace(known=with_errors(problem, point.error))
    motion = propagate(rigid, problem.maps, line, point.q0, point.w0, problem.columns)
    scale = np.ones(len(problem.columns.kinds))
    scale[R] = MASS
    return motion, motion.turn_by * scale, motion.rate_by * scale


def rows(problem, point):
    """Return residual vectors (n, 3) and sensitivities (n, 3, unknowns), all in sd."""
    motion, turn_by, rate_by = predicted(problem, point)
    seen = problem.seen
    e_q = difference(seen.attitude, motion.q[seen.attitude_node]) / seen.attitude_sd
    e_w = (seen.rate - motion.rate[seen.rate_node] - point.bias) / seen.rate_sd
    none, one = np.zeros((len(e_q), 3, 3)), np.tile(np.eye(3), (len(e_w), 1, 1))
    S_q = np.concatenate([turn_by[seen.attitude_node], none], axis=2) / seen.attitude_sd
    S_w = np.concatenate([rate_by[seen.rate_node], one], axis=2) / seen.rate_sd
    return e_q, e_w, np.concatenate([S_q, S_w])


def test_agrees_with_plain_numpy(posed):
    """Residuals, A, b and cost, Huber and the bias columns included; priors are added by hand."""
    problem, point = posed
    found = evaluate(problem, point)
    e_q, e_w, S = rows(problem, point)
    e = np.concatenate([e_q, e_w])
    size = np.linalg.norm(e, axis=1)
    far = (size > HUBER) & (problem.limit > 0)
    weight = np.where(far, HUBER / size, 1.0)
    cost = np.where(far, HUBER * (size - HUBER / 2), size**2 / 2)
    np.testing.assert_allclose(found.left_q, e_q, rtol=0, atol=1e-8)
    np.testing.assert_allclose(found.left_w, e_w, rtol=0, atol=1e-8)
    off = problem.prior.mean - coordinates(problem, point)
    prior = problem.prior.weight
    A = np.einsum("n,nia,nib->ab", weight, S, S) + np.diag(prior)
    b = np.einsum("n,nia,ni->a", weight, S, e) + prior * off
    unit = 1 / np.sqrt(np.diag(A))
    np.testing.assert_allclose(
        found.normal * np.outer(unit, unit), A * np.outer(unit, unit), atol=1e-9
    )
    np.testing.assert_allclose(found.descent * unit, b * unit, atol=1e-7)
    assert found.cost == pytest.approx(cost.sum() + 0.5 * np.sum(prior * off**2), rel=1e-10)


def coordinates(problem, point):
    """Return the physical coordinates, written out."""
    inertia = pack_symmetric(point.body(MASS).inertia_P)
    return np.concatenate(
        [np.zeros(3), point.w0, inertia, point.com, point.torque, point.error, point.bias]
    )


def test_outliers_are_there_and_are_counted_linearly(posed):
    """The robust test above would prove nothing if no residual were beyond the limit."""
    problem, point = posed
    at = evaluate(problem, point)
    beyond = [np.linalg.norm(left, axis=1) > 2 * HUBER for left in (at.left_q, at.left_w)]
    assert all(0.01 < b.mean() < 0.99 for b in beyond)


def stepped(problem, point, step):
    out = np.empty_like(point.flat)
    retract(point.flat, step, MASS, problem.layout.slots, out)
    return unknowns_of(out)


def test_gradient_is_that_of_the_cost(posed):
    """Central differences of 1e-3 sd in each unknown, far from the optimum.

    Compared in units of one sd; the propagator's own steps leave 1e-6 of the largest.
    """
    problem, point = posed
    at = evaluate(problem, point)
    unit = 1 / np.sqrt(np.diag(at.normal))
    numeric = np.zeros(problem.layout.size)
    for k, sd in enumerate(unit):
        step = np.zeros(problem.layout.size)
        step[k] = 1e-3 * sd
        more, less = (evaluate(problem, stepped(problem, point, s)).cost for s in (step, -step))
        numeric[k] = -(more - less) / 2e-3
    largest = np.abs(numeric).max()
    np.testing.assert_allclose(at.descent * unit, numeric, rtol=0, atol=1e-5 * largest)


def test_every_unknown_is_felt(posed):
    """No column of zeros: the comparison above has something to compare."""
    problem, point = posed
    information = np.diag(evaluate(problem, point).normal) - problem.prior.weight
    assert (information > 0).all()
    assert problem.layout.size == FIXED + 16 + 3 + 3
