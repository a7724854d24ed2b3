"""The motion of a fit and what it leaves, from its residuals: by hand, and of a whole fit."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.model_selection.reference_fit import estimate
from equipoise.estimation.output_error.predict import predict
from equipoise.estimation.output_error.trajectory import Params
from equipoise.maths.attitude import difference, exponential
from equipoise.maths.whiteness import autocorrelation
from equipoise.model.estimate import Estimate, Parameter, Residual
from equipoise.model.outcome import outcome
from equipoise.model.predicted_motion import PredictedMotion
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Gyro
from equipoise.procedure.identification.fitted_motion import fitted_motion, residual_series
from tests.support.builders import guessed_wrong, move_at, noisy, platform, recording

T = np.arange(5) * 0.1
TURN = np.array([0.1, -0.2, 0.3])
E_Q = np.array([1e-3, 2e-3, -1e-3]) * np.ones((5, 1))
W = np.array([0.1, 0.2, -0.3]) * np.ones((5, 1))
E_W = np.array([1e-4, -2e-4, 3e-4]) * np.ones((5, 1))
BIAS = {"gyro_bias_x": 0.01, "gyro_bias_y": -0.02, "gyro_bias_z": 0.03}
SCALE, CROSS = 0.05, 0.02  # of x, and of y in what the x axis measures


def fitted(residual):
    """An estimate with a gyro off in bias, in the scale of x, and turned about z."""
    found = BIAS | {"gyro_xx": SCALE, "gyro_xy": CROSS}
    parameters = tuple(Parameter(name, "1", value, 0.1) for name, value in found.items())
    return Estimate("trajectory", outcome(Why.EXPLAINED_ATTITUDE, attitude_rms=0.0), parameters,
                    np.eye(len(parameters)), residual)  # fmt: skip


def rows():
    """Rows of a camera and of a gyro, each off by its residual from a motion of constant rate."""
    true = W - E_W @ np.linalg.inv(matrix()).T
    q = exponential(TURN + E_Q)
    said = true @ matrix().T + list(BIAS.values()) + E_W
    return Recording(attitude=Samples(T, q), rate=Samples(T, said)), true


def matrix():
    """What the gyro does to a rate, written out: w_x' = 1.05 w_x + 0.02 w_y."""
    return np.array([[1 + SCALE, CROSS, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])


PREDICTED = PredictedMotion(T, exponential(np.zeros((5, 3))), np.zeros((5, 3)))


def test_bias_scale_and_alignment_are_taken_off_the_gyro():
    record, true = rows()
    left = Residual(None, None, 1.0, 1, 0.0, attitude=Samples(T, E_Q), rate=Samples(T, E_W))
    found = fitted_motion(record, platform(), fitted(left), PREDICTED)
    np.testing.assert_allclose(found.gyro.values, W, atol=1e-15)
    np.testing.assert_allclose(found.rate.values, true, atol=1e-15)


def test_the_attitude_of_a_fit_is_measured_less_its_residual():
    record, _ = rows()
    left = Residual(None, None, 1.0, 1, 0.0, attitude=Samples(T, E_Q), rate=Samples(T, E_W))
    found = fitted_motion(record, platform(), fitted(left), PREDICTED)
    np.testing.assert_allclose(
        difference(record.attitude.values, found.attitude.values), E_Q, atol=1e-12
    )


def test_rows_that_the_fit_did_not_take_are_left_out():
    record, _ = rows()
    left = Residual(None, None, 1.0, 1, 0.0, attitude=Samples(T[1:], E_Q[1:]))
    found = fitted_motion(record, platform(), fitted(left), PREDICTED)
    np.testing.assert_array_equal(found.attitude.t, T[1:])


def test_without_rows_of_a_fit_the_predicted_motion_stands():
    record, _ = rows()
    found = fitted_motion(record, platform(), fitted(None), PREDICTED)
    np.testing.assert_array_equal(found.attitude.values, PREDICTED.q)
    np.testing.assert_array_equal(found.rate.values, PREDICTED.rate)
    left = found.camera_residual.rows.values
    np.testing.assert_allclose(left, difference(record.attitude.values, PREDICTED.q))


def test_a_fit_keeps_what_it_leaves_of_its_rows():
    """Measured minus predicted, as the model run from its first state says; rms as stated."""
    record, bed = noisy(recording(60.0, move_at(30.0, 60.0)), 5), platform()
    found = estimate(record, guessed_wrong(bed), Params())
    left = found.residual.attitude
    np.testing.assert_array_equal(left.t, record.attitude.t)
    after = predict(record, bed, found)
    off = difference(record.attitude.values, after.q) - left.values
    assert np.sqrt(np.mean(off**2)) < 0.1 * found.residual.attitude_rms
    assert np.sqrt(np.mean(left.values**2)) == pytest.approx(found.residual.attitude_rms)


def test_noise_stands_beside_the_residuals_of_its_sensor():
    bed = replace(platform(), gyro=Gyro(rate=10.0, noise=0.002, bias_sd=0.0))
    record, _ = rows()
    left = Residual(None, None, 1.0, 1, 0.0, attitude=Samples(T, E_Q), rate=Samples(T, E_W))
    found = fitted_motion(record, bed, fitted(left), PREDICTED)
    assert found.gyro_residual.noise == 0.002
    assert found.camera_residual.noise == bed.attitude.noise


def test_autocorrelation_by_hand():
    """1, -1, 1, -1: neighbours -3/4, next but one 2/4."""
    values = np.array([[1.0], [-1.0], [1.0], [-1.0]])
    np.testing.assert_allclose(autocorrelation(values, 2), [[-0.75], [0.5]])


def test_white_noise_stays_within_its_limits():
    """95 % of 25 lags and three axes, to three binomial sd."""
    noise = np.random.default_rng(3).normal(size=(2000, 3))
    series = residual_series(Samples(np.arange(2000.0), noise), 1.0)
    inside = np.mean(np.abs(series.correlation) < series.white)
    assert abs(inside - 0.95) < 3 * np.sqrt(0.95 * 0.05 / series.correlation.size)
