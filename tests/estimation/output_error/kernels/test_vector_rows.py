"""Rows of accelerometer, sun sensor and magnetometer: against plain NumPy and central differences.

The platform carries travelling masses whose way is not quite known and a wheel that speeds up, so
that every part of the angular acceleration and of its sensitivities counts.
"""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.output_error.solution import evaluate
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.estimation.parameters.fit_parameters import physical
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.model.devices import MagneticField
from equipoise.model.recording import Samples
from equipoise.model.sensor_terms import BIASES, MOUNTINGS, TERMS
from equipoise.model.torque_terms import TERMS as TORQUES
from equipoise.model.vector_sensors import Accelerometer, Magnetometer, SunSensor
from equipoise.sensors.camera import N_SENSOR
from tests.estimation.output_error.kernels.test_normal_equations import (
    BIAS,
    predicted,
    somewhere,
    with_nodes,
)
from tests.support.builders import (
    GRAVITY,
    MASS,
    WARMING,
    move_at,
    noisy,
    platform,
    recording,
)
from tests.support.plain_problem import stepped, with_errors

PLACE, LAMP = np.array([0.3, -0.2, 0.15]), np.array([0.6, 0.0, 0.8])
FIELD, SOON = np.array([2e-5, 5e-6, -4e-5]), 5e-4
OFF = {"accelerometer": [0.02, -0.01, 0.03], "field": [1e-7, -2e-7, 3e-7]}
TURNED = {"accelerometer": [1e-3, -1e-3, 5e-4], "sun": [-0.01, 0.005, 0.015]}  # rad
SD = {"accelerometer": 1e-5, "sun": 1e-3, "field": 1e-7}
END, DELAY = 20.0, 0.013


def seeing():
    """Return the platform with sensors of vectors, whose camera and gyro weigh next to nothing."""
    plain = platform(3e-4, gyro=True)
    return replace(
        plain,
        attitude=replace(plain.attitude, noise=1e3),
        gyro=replace(plain.gyro, noise=1e3),
        magnetic_field=MagneticField(FIELD),
        accelerometer=Accelerometer(20.0, SD["accelerometer"], 0.1, PLACE, DELAY, 0.01),
        sun=SunSensor(5.0, SD["sun"], LAMP, mounting_sd=0.02),
        magnetometer=Magnetometer(10.0, SD["field"], 1e-6),
    )


def record():
    """Return a record of everything; what the rows say does not matter here."""
    clean = noisy(recording(END, move_at(5.0, END), gyro=20.0), 3, BIAS)
    t, rng = np.arange(1, 200) * 0.1, np.random.default_rng(1)
    vectors = {
        "accelerometer": Samples(t, rng.normal(size=(len(t), 3)) * 0.01 + [0.0, 0.0, GRAVITY]),
        "sun": Samples(t[::2], np.tile(LAMP, (len(t[::2]), 1))),
        "field": Samples(t[1::2], np.tile(FIELD, (len(t[1::2]), 1))),
    }
    wheel = Samples(np.array([0.0, 3.0, END]), np.array([[0, 0, 0], [0.004, 0, 0.002], [0.0] * 3]))
    return replace(clean, momentum=wheel, temperature=WARMING, **vectors)


@pytest.fixture(scope="module")
def posed():
    problem = problem_of(record(), seeing(), Params(TORQUES, fineness=4.0))
    sensor = np.zeros(N_SENSOR)
    for channel, off in OFF.items():
        first = TERMS.index(BIASES[channel][0])
        sensor[first : first + 3] = off
    for channel, turn in TURNED.items():
        first = TERMS.index(MOUNTINGS[channel][0])
        sensor[first : first + 3] = turn
    return problem, somewhere(len(problem.layout.errors), sensor)


def vectors_by_numpy(problem, point):
    """Return what each row should say, with w' by central differences of the rate."""
    observed, line = problem.observed.vectors, problem.line
    lengths = np.append(np.diff(line.t), 1.0)
    t = line.t[observed.node] + observed.share * lengths[observed.node]
    line = line._replace(known=with_errors(problem, point.error))
    line = with_nodes(line, np.concatenate([t, t - SOON, t + SOON]))
    motion, _, _ = predicted(problem, point, line)
    here, before, after = (np.abs(line.t[:, None] - x).argmin(axis=0)
                           for x in (t, t - SOON, t + SOON))  # fmt: skip
    R, w = to_matrix(motion.q[here]), motion.rate[here]
    turning = (motion.rate[after] - motion.rate[before]) / (line.t[after] - line.t[before])[:, None]
    k = observed.sensor
    vector_N, p = observed.vector_N[k], observed.place[k]
    level = np.einsum("nji,nj->ni", R, vector_N)
    force = level + np.cross(turning, p) + np.cross(w, np.cross(w, p))
    said = np.empty_like(force)
    for i, channel in enumerate(("accelerometer", "sun", "field")):
        mounting = to_matrix(exponential(np.array(TURNED.get(channel, [0.0] * 3))))
        said[k == i] = force[k == i] @ mounting + OFF.get(channel, [0.0] * 3)
    return t, said


def test_every_row_is_there_in_order(posed):
    problem, _ = posed
    observed = problem.observed.vectors
    assert np.bincount(observed.sensor).tolist() == [199, 100, 99]
    assert (np.diff(observed.node) >= 0).all()
    sought = {*BIASES["accelerometer"], *BIASES["field"], *MOUNTINGS["accelerometer"],
              *MOUNTINGS["sun"]}  # fmt: skip
    assert sought == {name for name in problem.layout.names if name in TERMS}


def test_rows_are_predicted_as_by_plain_numpy(posed):
    """Away from where masses start and stop, where the rate has a corner."""
    problem, point = posed
    t, said = vectors_by_numpy(problem, point)
    observed = problem.observed.vectors
    expected = (observed.values - said) / observed.sd[observed.sensor][:, None]
    corners = np.array([3.0, 5.0, 6.0, 10.0])
    smooth = np.abs(t[:, None] - corners).min(axis=1) > 2 * SOON
    found = evaluate(problem, point).left_v
    assert smooth.mean() > 0.9
    np.testing.assert_allclose(found[smooth], expected[smooth], rtol=0, atol=3e-3)


def test_an_accelerometer_aside_sees_how_the_platform_turns(posed):
    """The comparison above would prove little if turning added nothing: it adds 100 sd."""
    problem, point = posed
    vectors = problem.observed.vectors._replace(place=np.zeros((3, 3)))
    at_centre = replace(problem, observed=problem.observed._replace(vectors=vectors))
    change = evaluate(at_centre, point).left_v - evaluate(problem, point).left_v
    assert np.abs(change).max() > 100


def test_sensitivities_are_derivatives_of_the_residuals(posed):
    """A of the rows, by central differences of 1e-3 sd, all but the gyro's bias."""
    problem, point = posed
    at = evaluate(problem, point)
    unit, columns = 1 / np.sqrt(np.diag(at.normal)), []
    for k, sd in enumerate(unit):
        step = 1e-3 * sd * (np.arange(len(unit)) == k)
        more, less = (evaluate(problem, stepped(problem, point, s)).left_v for s in (step, -step))
        columns.append(-(more - less).ravel() / 2e-3)
    S = np.stack(columns, axis=1)
    scaled = at.normal * np.outer(unit, unit) - np.diag(problem.prior.weight * unit**2)
    np.testing.assert_allclose(scaled, S.T @ S, rtol=0, atol=3e-5)
    assert np.flatnonzero(np.diag(S.T @ S) == 0).tolist() == list(range(len(unit)))[-3:]
    off = problem.prior.weight * (problem.prior.mean - physical(point, MASS, problem.layout)) * unit
    b = at.descent * unit - off
    np.testing.assert_allclose(b, S.T @ at.left_v.ravel(), atol=3e-5 * np.abs(b).max())
