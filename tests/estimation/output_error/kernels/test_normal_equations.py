"""The compiled pass against plain NumPy, and its gradient against the cost itself."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.dynamics.propagation import body_of, propagate
from equipoise.dynamics.regressor import N_TORQUES
from equipoise.estimation.output_error.solution import evaluate
from equipoise.estimation.output_error.trajectory import HUBER, Params, problem_of
from equipoise.estimation.parameters.fit_parameters import FIXED, R, Unknowns
from equipoise.maths.attitude import difference, exponential, multiply, normalise
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.maths.pseudo_inertia import from_inertia
from equipoise.model.mass_properties import parallel_axis
from equipoise.model.recording import Recording, Samples
from equipoise.model.sensor_terms import TERMS as SENSOR_TERMS
from equipoise.model.torque_terms import TERMS
from equipoise.sensors.camera import CLOCK, DELAY, GYRO, N_SENSOR
from tests.support.builders import (
    ATTITUDE,
    COM,
    GRAVITY,
    INERTIA,
    MASS,
    RATE,
    WARMING,
    camera_says,
    line_of,
    move_at,
    noisy,
    platform,
    recording,
    travel,
)
from tests.support.plain_problem import noded, stepped, with_errors

BIAS = np.array([2e-3, -1e-3, 3e-3])
SENSOR = np.concatenate([
    [3e-3, -2e-3],  # plumb
    np.array([5, -3, 8, -6, 4, 2]) * 1e-4,  # twice the heading: cos x y z, sin x y z
    np.array([-4, 6, 1, 3, 7, -5]) * 1e-4,  # three times
    [0.02],  # s of delay
    [0.010, -0.020, 0.015, 0.004, -0.006, 0.008, -0.003, 0.005, 0.007],
    [0.0],  # of the gyro's clock: see below
    np.zeros(N_SENSOR - CLOCK - 1),  # of sensors of vectors: see ``test_vector_rows``
])  # fmt: skip


def with_outliers(record: Recording) -> Recording:
    """Every twelfth camera row and every thirtieth gyro row is far off."""
    rng = np.random.default_rng(4)
    q, w = record.attitude.values.copy(), record.rate.values.copy()
    q[::12] = multiply(q[::12], exponential(rng.normal(scale=0.1, size=(len(q[::12]), 3))))
    w[::30] += rng.normal(scale=5e-3, size=(len(w[::30]), 3))
    return replace(record, attitude=Samples(record.attitude.t, q), rate=Samples(record.rate.t, w))


def somewhere(errors: int, sensor: np.ndarray | None = None) -> Unknowns:
    """A point off the truth by some sd in everything; sensors without fault unless given."""
    com = COM + np.array([2e-6, -1e-6, 5e-6])
    inertia = unpack_symmetric(INERTIA * [1.02, 1.01, 0.98, 1.1, 0.9, 1.2])
    six = from_inertia(inertia - parallel_axis(MASS, com))
    q0 = multiply(ATTITUDE, exponential(np.array([3e-3, -2e-3, 1e-3])))
    torque = np.append(np.array([2, 3, 1, 20, 0.1, -0.2, 0.03, 0.2]) * 1e-4, np.zeros(11))
    torque[8:] = np.array([3, -2, 4, 1, -5, 0.1, -0.2, 0.05, 0.3, -0.5, 0.4]) * 1e-7
    error = np.array([2e-4, -3e-4, 1e-4])[:errors]
    observed = np.zeros(N_SENSOR) if sensor is None else sensor
    return Unknowns(q0, RATE * 1.01, six, com, torque, observed, error, BIAS)


CASES = {  # robust, sensor terms, when the masses set off: no camera row reaches back across that
    "squares": (False, (), 5.0),
    "robust": (True, (), 5.0),
    "sensors": (False, SENSOR_TERMS[:CLOCK], 5.1),
}


@pytest.fixture(scope="module", params=CASES.values(), ids=CASES)
def case(request):
    """A record and what to seek in it; with a delay the camera begins with the second row."""
    robust, sensor, departure = request.param
    record = with_outliers(noisy(recording(20.0, move_at(departure, 20.0), gyro=20.0), 3, BIAS))
    if sensor:
        camera = record.attitude
        record = replace(record, attitude=Samples(camera.t[1:], camera.values[1:]))
    return replace(record, temperature=WARMING), Params(TERMS, sensor, robust=robust)


@pytest.fixture(scope="module")
def posed(case):
    """A problem with every optional unknown, and a point."""
    record, params = case
    problem = noded(problem_of(record, platform(3e-4, gyro=True), params), record)
    return problem, somewhere(len(problem.layout.errors), SENSOR if params.sensor else None)


def test_reading_between_steps_agrees_with_steps_to_every_row(posed, case):
    """The state between steps is good to a tenth of what all rows together can show: an error of
    0.1 / sqrt(rows) sd in every row at once."""
    problem, point = posed
    record, params = case
    between = problem_of(record, platform(3e-4, gyro=True), replace(params, robust=False))
    exact = evaluate(replace(problem, limit=0.0), point)
    found = evaluate(between, point)
    assert len(between.line.t) < len(problem.line.t)
    assert np.abs(found.left_q - exact.left_q).max() < 0.1 / np.sqrt(len(exact.left_q))
    assert np.abs(found.left_w - exact.left_w).max() < 0.1 / np.sqrt(len(exact.left_w))


def with_nodes(line, t):
    """Return a timeline with nodes at these times too; known inputs are straight in between."""
    nodes = np.unique(np.concatenate([line.t, t]))
    known = np.column_stack([np.interp(nodes, line.t, column) for column in line.known.T])
    return line._replace(t=nodes, known=known)


def predicted(problem, point, line):
    """Return the motion with sensitivities by com (not first moment), one column an unknown."""
    rigid = body_of(MASS, GRAVITY, pack_symmetric(point.body(MASS).inertia_P), MASS * point.com,
                    point.torque)  # fmt: skip
    motion = propagate(rigid, problem.maps, line, point.q0, point.w0, problem.columns)
    scale = np.ones(len(problem.columns.kinds))
    scale[R] = MASS
    return motion, motion.turn_by * scale, motion.rate_by * scale


def by_differences(see, size):
    """Return the derivatives (n, 3, size) of attitudes by central differences of 1e-6."""
    steps = 1e-6 * np.eye(size)
    return np.stack([difference(see(step), see(-step)) / 2e-6 for step in steps], axis=2)


def camera_rows(problem, point, q, w, turn_by):
    """Return what the camera says (n, 4), and its sensitivities to all but the gyro's bias."""
    forward, sensor = np.array(problem.observed.forward), point.sensor
    said = camera_says(q, sensor, forward)
    if not problem.layout.sensor:
        return said, turn_by
    by_turn = by_differences(lambda s: camera_says(multiply(q, exponential(s)), sensor, forward), 3)
    by_term = by_differences(lambda s: camera_says(q, sensor + s, forward), N_SENSOR)
    by_term[:, :, DELAY] = -np.einsum("nij,nj->ni", by_turn, w)
    return said, np.concatenate([by_turn @ turn_by, by_term[:, :, problem.layout.sensor_index]], 2)


GYRO_ENTRIES = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)]


def gyro_rows(problem, point, w, rate_by):
    """Return what the gyro says (n, 3), and its sensitivities to all but its bias."""
    M, by_term = np.eye(3), np.zeros((len(w), 3, N_SENSOR))
    for k, (row, other) in enumerate(GYRO_ENTRIES):
        M[row, other] += point.sensor[GYRO + k]
        by_term[:, row, GYRO + k] = w[:, other]
    index = problem.layout.sensor_index
    return w @ M.T + point.bias, np.concatenate([M @ rate_by, by_term[:, :, index]], axis=2)


def rows(problem, point):
    """Return residual vectors (n, 3) and sensitivities (n, 3, unknowns), all in sd."""
    observed, line = (
        problem.observed,
        problem.line._replace(known=with_errors(problem, point.error)),
    )
    t_q, t_w = line.t[observed.attitude_node] - point.sensor[DELAY], line.t[observed.rate_node]
    line = with_nodes(line, t_q)
    motion, turn_by, rate_by = predicted(problem, point, line)
    k, m = np.searchsorted(line.t, t_q), np.searchsorted(line.t, t_w)
    q, S_q = camera_rows(problem, point, motion.q[k], motion.rate[k], turn_by[k])
    w, S_w = gyro_rows(problem, point, motion.rate[m], rate_by[m])
    none, one = np.zeros((len(q), 3, 3)), np.tile(np.eye(3), (len(w), 1, 1))
    S_q = np.concatenate([S_q, none], axis=2) / observed.attitude_sd
    S_w = np.concatenate([S_w, one], axis=2) / observed.rate_sd
    e_q, e_w = (
        difference(observed.attitude, q) / observed.attitude_sd,
        (observed.rate - w) / observed.rate_sd,
    )
    return e_q, e_w, np.concatenate([S_q, S_w])


# Sensitivities of the sensors leave out squares of their errors, of some 1e-5.
SQUARES_LEFT_OUT = 3e-5


def test_agrees_with_plain_numpy(posed):
    """Residuals, A, b and cost, Huber and the bias columns included; priors are added by hand."""
    problem, point = posed
    found = evaluate(problem, point)
    e_q, e_w, S = rows(problem, point)
    e = np.concatenate([e_q, e_w])
    size = np.linalg.norm(e, axis=1)
    outlying = (size > HUBER) & (problem.limit > 0)
    weight = np.where(outlying, HUBER / size, 1.0)
    cost = np.where(outlying, HUBER * (size - HUBER / 2), size**2 / 2)
    rounding = 1e-7 if problem.layout.sensor else 1e-8  # with a delay, other steps as well
    np.testing.assert_allclose(found.left_q, e_q, rtol=0, atol=rounding)
    np.testing.assert_allclose(found.left_w, e_w, rtol=0, atol=rounding)
    off = problem.prior.mean - coordinates(problem, point)
    prior = problem.prior.weight
    A = np.einsum("n,nia,nib->ab", weight, S, S) + np.diag(prior)
    b = np.einsum("n,nia,ni->a", weight, S, e) + prior * off
    unit, near = 1 / np.sqrt(np.diag(A)), SQUARES_LEFT_OUT if problem.layout.sensor else 1e-9
    np.testing.assert_allclose(
        found.normal * np.outer(unit, unit), A * np.outer(unit, unit), rtol=0, atol=near
    )
    largest = np.abs(b * unit).max()
    np.testing.assert_allclose(found.descent * unit, b * unit, rtol=0, atol=near * largest)
    assert found.cost == pytest.approx(cost.sum() + 0.5 * np.sum(prior * off**2), rel=1e-10)


def coordinates(problem, point):
    """Return the physical coordinates, written out."""
    inertia = pack_symmetric(point.body(MASS).inertia_P)
    sensor = point.sensor[problem.layout.sensor_index]
    return np.concatenate(
        [np.zeros(3), point.w0, inertia, point.com, point.torque, point.error, sensor, point.bias]
    )


def test_outliers_are_there_and_are_counted_linearly(posed):
    """The robust test above would prove nothing if no residual were beyond the limit."""
    problem, point = posed
    at = evaluate(problem, point)
    beyond = [np.linalg.norm(left, axis=1) > 2 * HUBER for left in (at.left_q, at.left_w)]
    assert all(0.01 < b.mean() < 0.99 for b in beyond)


def descents(problem, point):
    """Return the descent by the code and by central differences of 1e-3 sd, in units of one sd."""
    at = evaluate(problem, point)
    unit = 1 / np.sqrt(np.diag(at.normal))
    numeric = np.zeros(problem.layout.size)
    for k, sd in enumerate(unit):
        step = np.zeros(problem.layout.size)
        step[k] = 1e-3 * sd
        more, less = (evaluate(problem, stepped(problem, point, s)).cost for s in (step, -step))
        numeric[k] = -(more - less) / 2e-3
    return at.descent * unit, numeric


def test_gradient_is_that_of_the_cost(posed):
    """Far from the optimum; the propagator's own steps leave 1e-6 of the largest."""
    found, numeric = descents(*posed)
    near = SQUARES_LEFT_OUT if posed[0].layout.sensor else 1e-5
    np.testing.assert_allclose(found, numeric, rtol=0, atol=near * np.abs(numeric).max())


def test_every_parameter_has_information(posed):
    """No column of zeros: the comparison above has something to compare."""
    problem, point = posed
    information = np.diag(evaluate(problem, point).normal) - problem.prior.weight
    assert (information > 0).all()
    assert problem.layout.size == FIXED + N_TORQUES + 3 + len(problem.layout.sensor) + 3


# --- A gyro's clock -----------------------------------------------------------------------------

AHEAD = 2e-4  # relative


@pytest.fixture(scope="module")
def ticking():
    """A swing under torques, its gyro's clock sought, and a point where that is fast."""
    record = replace(noisy(recording(20.0, gyro=20.0), 3, BIAS), temperature=WARMING)
    bed = platform(gyro=True)
    point = somewhere(0, AHEAD * (np.arange(N_SENSOR) == CLOCK))
    return (
        record,
        bed,
        problem_of(record, bed, Params(TERMS, SENSOR_TERMS[CLOCK : CLOCK + 1])),
        point,
    )


def test_a_clock_is_read_as_rows_that_were_stamped_otherwise(ticking):
    """The coefficient, or the same rows at the times that such a clock means: 1e-4 sd."""
    record, bed, problem, point = ticking
    timed = replace(bed, gyro=replace(bed.gyro, clock=AHEAD))
    there = replace(point, sensor=np.zeros(N_SENSOR))
    restamped = evaluate(problem_of(record, timed, Params(TERMS)), there)
    found = evaluate(problem, point)
    np.testing.assert_allclose(found.left_w, restamped.left_w, rtol=0, atol=1e-4)
    without = evaluate(problem, there)
    assert np.abs(found.left_w - without.left_w).max() > 0.02


def test_the_gradient_by_a_clock_is_that_of_the_cost(ticking):
    """By central differences, of the clock and of all else beside it."""
    _, _, problem, point = ticking
    found, numeric = descents(problem, point)
    np.testing.assert_allclose(found, numeric, rtol=0, atol=1e-5 * np.abs(numeric).max())
    assert abs(numeric[problem.layout.names.index("gyro_clock")]) > 1e-3


# --- Rows that are means ------------------------------------------------------------------------

FAST = np.array([0.3, -0.2, 0.5])  # rad/s
DELAYS, WIDTHS = (0.05, 0.02), (0.2, 0.1)  # s, of camera and gyro


def averaging(record, widths=WIDTHS):
    """Return the problem of a record of sensors that average."""
    testbed = platform(gyro=True)
    testbed = replace(
        testbed,
        attitude=replace(testbed.attitude, delay=DELAYS[0], averaging=widths[0]),
        gyro=replace(testbed.gyro, delay=DELAYS[1], averaging=widths[1]),
    )
    return problem_of(record, testbed, Params())


def moving(w0):
    """Return a record without noise, and a point; the motion begins where the camera measures."""
    t = np.arange(0, 10.01, 0.05)
    motion = travel(line_of(t), w0=w0)
    record = Recording(Samples(t[::4], motion.q[::4]), Samples(t, motion.rate))
    return record, replace(somewhere(0), w0=w0, torque=np.zeros(N_TORQUES))


def windows(t, delay, width, start):
    """Return, for each row, the node of a grid of 0.5 ms at which its averaging begins."""
    return np.round((t - delay - width - start) / 5e-4).astype(int)


def means(values, first, width):
    """Return means by the trapezoidal rule."""
    n = round(width / 5e-4)
    inside = np.stack([values[k : k + n + 1] for k in first])
    return (inside.sum(axis=1) - 0.5 * (inside[:, 0] + inside[:, -1])) / n


def test_rows_are_means():
    """Attitudes and rates by the mean over every row's window, from a motion in steps of 0.5 ms."""
    record, point = moving(FAST)
    problem = averaging(record)
    start = problem.line.t[0]
    assert start == pytest.approx(-DELAYS[0] - WIDTHS[0] / 2)
    fine = problem.line._replace(t=start + np.arange(20_301) * 5e-4, known=np.zeros((20_301, 9)))
    motion, _, _ = predicted(problem, point, fine)
    at = evaluate(problem, point)
    q_first = windows(record.attitude.t[1:], DELAYS[0], WIDTHS[0], start)
    w_first = windows(record.rate.t, DELAYS[1], WIDTHS[1], start)
    q, w = means(motion.q, q_first, WIDTHS[0]), means(motion.rate, w_first, WIDTHS[1])
    q_middle, w_middle = motion.q[q_first + 200], motion.rate[w_first + 100]
    e_q = difference(record.attitude.values[1:], normalise(q))
    e_w = record.rate.values - w - point.bias
    found_q, found_w = (
        at.left_q[1:] * problem.observed.attitude_sd,
        at.left_w * problem.observed.rate_sd,
    )
    # the middles alone would be off by far more than the cubic leaves out
    assert np.linalg.norm(difference(q_middle, normalise(q)), axis=1).max() > 2e-4
    assert np.abs(w_middle - w).max() > 3e-5
    np.testing.assert_allclose(found_q, e_q, rtol=0, atol=1e-6)
    np.testing.assert_allclose(found_w, e_w, rtol=0, atol=2e-7)


def free_descents(problem, point):
    """Return what ``descents`` does of all that may move: without a move one moment is held."""
    free = ~problem.prior.held
    assert np.sum(free) == problem.layout.size - 1
    return [descent[free] for descent in descents(problem, point)]


def test_gradient_of_mean_rates_is_that_of_the_cost():
    """As above; what is averaged is the sensitivity too."""
    record, point = moving(FAST)
    found, numeric = free_descents(averaging(replace(record, attitude=None)), point)
    np.testing.assert_allclose(found, numeric, rtol=0, atol=1e-5 * np.abs(numeric).max())


def test_gradient_of_mean_attitudes_is_that_of_the_cost():
    """A swing, half a second of averaging.

    Sensitivities are averaged in body axes, which turn meanwhile: off by w p T^2 / 12 = 6e-5 for
    w = 0.015 rad/s and a swing of p = 0.18 rad/s; without averaging them, by (p T)^2 / 24 = 3e-4.
    """
    record, point = moving(RATE)
    found, numeric = free_descents(averaging(replace(record, rate=None), (0.5, 0.0)), point)
    np.testing.assert_allclose(found, numeric, rtol=0, atol=1e-4 * np.abs(numeric).max())
