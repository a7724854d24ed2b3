"""Outliers from the motion of all other rows: left out of a robust estimate, and counted.

Huber's loss keeps a gross error from pulling a fit, but not from being counted in what the fit
leaves: a few of a hundred sd make any model seem wrong, and a sensor seem noisy. So the motion is
followed once by the robust fit, and rows whose residual
exceeds ``OUTLYING`` times the usual one (by the median) are no part of what is estimated, judged
and surveyed then. Where many rows are outliers it is the model that is wrong, and none is left out.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.motion.observed_vectors import observed
from equipoise.estimation.output_error.problem import vector_moments
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.estimation.regression.solvers.robust import MEDIAN
from equipoise.model.arrays import Bools, Series
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed

OUTLYING = 8.0  # chosen: of the sd of an axis; one sound row of 1e12 exceeds it
MOST = 0.2  # chosen: with more outliers, it is the model


def outlying(left: Series) -> Bools:
    """Return which residual vectors (n, 3), in sd, are outliers."""
    size = np.linalg.norm(left, axis=1)
    if not len(size):
        return np.zeros(0, dtype=bool)
    scale = max(float(np.median(size)) / MEDIAN[3], 1.0)
    outlying = size > OUTLYING * scale
    return outlying if outlying.mean() < MOST else np.zeros(len(size), dtype=bool)


def without(channel: Samples | None, outlying: Bools) -> Samples | None:
    """Return a channel without some rows."""
    if channel is None or not outlying.any():
        return channel
    return channel.where(~outlying)


def outlying_vectors(fitted: Fitted) -> dict[str, Bools]:
    """Return which rows of each sensor of a vector are outliers, by its channel.

    Each is judged by itself: a magnetometer near iron says nothing of an accelerometer.
    """
    problem, found = fitted.problem, dict[str, Bools]()
    sensors = observed(problem.recording, problem.testbed)
    order, _ = vector_moments(problem.recording, problem.testbed, problem.line.t)
    of, first = problem.observed.vectors.sensor, 0
    for k, (sensor, rows) in enumerate(sensors):
        wild = np.zeros(len(rows), dtype=np.bool_)
        wild[order[of == k] - first] = outlying(fitted.at.left_v[of == k])
        found[sensor.channel], first = wild, first + len(rows)
    return found


def without_outliers(
    recording: Recording, testbed: Testbed, params: Params
) -> tuple[Recording, int]:
    """Return the record without the outliers of its robust fit, and their number."""
    fitted = fit(recording, testbed, replace(params, robust=True))
    camera, gyro = outlying(fitted.at.left_q), outlying(fitted.at.left_w)
    vectors = outlying_vectors(fitted)
    kept = replace(
        recording,
        attitude=without(recording.attitude, camera),
        rate=without(recording.rate, gyro),
        **{name: without(getattr(recording, name), rows) for name, rows in vectors.items()},
    )
    return kept, int(sum(rows.sum() for rows in (camera, gyro, *vectors.values())))
