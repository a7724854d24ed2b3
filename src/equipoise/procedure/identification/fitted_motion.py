"""The motion as a fit has it at the rows of camera and gyro, and what it leaves of them.

    q_fit = q (x) exp(-e_q),    w = (E + M)^-1 (z - b),    w_fit = w - (E + M)^-1 e_w

q, z: rows of camera and gyro; e_q, e_w: their residuals in the fit; b, M: the gyro's bias, scale
errors and misalignment as estimated (``sensors.gyro``). Events and process noise are part of the
fit, so that they are in this motion, which no run of the model from its first state would show.

Without the rows of a fit (of other methods) the motion is the one that the estimate predicts.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.maths.whiteness import autocorrelation
from equipoise.model import sensor_terms
from equipoise.model.arrays import Matrix3, Series, Series1, Vector3
from equipoise.model.estimate import NORMAL_95, Estimate
from equipoise.model.predicted_motion import PredictedMotion
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.gyro import gyro_matrix

BIAS = ("gyro_bias_x", "gyro_bias_y", "gyro_bias_z")
LAGS = 25  # rows, chosen: more than neighbours that share a cause


@dataclass(frozen=True, slots=True, eq=False)
class ResidualSeries:
    """The residuals of one sensor, and how they hang together."""

    rows: Samples  # rad or rad/s: measured minus fitted
    noise: float | None  # stated sd of a row, in the same unit
    correlation: Series  # (lags, 3) from lag 1 on; no rows for a record too short to show it

    @property
    def white(self) -> float:
        """Return the limit within which 95 % of the correlations of white noise lie."""
        return NORMAL_95 / float(np.sqrt(max(len(self.rows), 1)))


@dataclass(frozen=True, slots=True, eq=False)
class FittedMotion:
    """A motion at the rows of the sensors."""

    attitude: Samples | None  # at the camera's rows, scalar first
    rate: Samples  # rad/s, body axes
    gyro: Samples | None  # rad/s, body axes: measured, bias and alignment removed
    camera_residual: ResidualSeries | None
    gyro_residual: ResidualSeries | None


def residual_series(rows: Samples | None, noise: float | None) -> ResidualSeries | None:
    """Return residuals with their autocorrelation; None without rows."""
    if rows is None or not len(rows):
        return None
    lags = min(LAGS, len(rows) // 4)  # chosen: beyond a quarter of the rows chance rules
    return ResidualSeries(rows, noise, autocorrelation(rows.values, lags))


def residuals_of(
    testbed: Testbed, camera: Samples | None, gyro: Samples | None
) -> tuple[ResidualSeries | None, ResidualSeries | None]:
    """Return the residuals of camera (rad) and gyro (rad/s) beside the noise of the testbed."""
    return (
        residual_series(camera, testbed.attitude.noise if testbed.attitude else None),
        residual_series(gyro, testbed.gyro.noise if testbed.gyro else None),
    )


def fitted_motion(
    recording: Recording, testbed: Testbed, estimate: Estimate, after: PredictedMotion
) -> FittedMotion:
    """Return the motion of a fit; ``after`` is what its estimate predicts.

    A fit of other rows than the recording's, such as means of them, leaves the predicted motion.
    """
    residual = estimate.residual
    left_q = None if residual is None else residual.attitude
    left_w = None if residual is None else residual.rate
    attitude = _attitude(recording.attitude, left_q, after)
    if recording.attitude is not None and left_q is None:
        left_q = Samples(after.t, difference(recording.attitude.values, after.q))
    gyro = gyro_in_body_axes(recording.rate, estimate)
    rate = _rate(gyro, left_w, alignment(estimate)[1], after)
    return FittedMotion(attitude, rate, gyro, *residuals_of(testbed, left_q, left_w))


def alignment(estimate: Estimate) -> tuple[Vector3, Matrix3]:
    """Return the estimated bias (rad/s) and (E + M)^-1 of a gyro; none sought: 0 and E."""
    found = {p.name: p.value for p in estimate.parameters}
    sensor = np.array([found.get(term, 0.0) for term in sensor_terms.TERMS])
    bias = np.array([found.get(name, 0.0) for name in BIAS])
    matrix = np.array(gyro_matrix(sensor), dtype=np.float64).reshape(3, 3)
    return bias, np.linalg.inv(matrix).astype(np.float64, copy=False)


def gyro_in_body_axes(rows: Samples | None, estimate: Estimate) -> Samples | None:
    """Return the gyro's rates (rad/s) without the bias, scale errors and misalignment found."""
    bias, inverse = alignment(estimate)
    return None if rows is None else Samples(rows.t, (rows.values - bias) @ inverse.T)


def rows_at(rows: Samples | None, t: Series1) -> Samples | None:
    """Return the rows with these times (s); None where some have no row."""
    if rows is None:
        return None
    found = rows.where(np.isin(rows.t, t))
    return found if len(found) == len(t) else None


def _attitude(
    camera: Samples | None, left: Samples | None, after: PredictedMotion
) -> Samples | None:
    """Return the attitude of a fit at the camera's rows: q (x) exp(-e_q)."""
    fitted = None if left is None else rows_at(camera, left.t)
    if left is not None and fitted is not None:
        return Samples(left.t, multiply(fitted.values, exponential(-left.values)))
    return None if camera is None else Samples(after.t, after.q)


def _rate(
    gyro: Samples | None, left: Samples | None, inverse: Matrix3, after: PredictedMotion
) -> Samples:
    """Return the rate of a fit at the gyro's rows: w - (E + M)^-1 e_w."""
    fitted = None if left is None else rows_at(gyro, left.t)
    if left is not None and fitted is not None:
        return Samples(left.t, fitted.values - left.values @ inverse.T)
    return Samples(after.t, after.rate)
