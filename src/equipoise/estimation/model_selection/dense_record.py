"""A dense record: fitted and surveyed as means of its rows, then fitted once by all of them.

The search and the survey take the condensed record (``decimation``); their model is taken over, and
the descent on all rows begins at their optimum, a few evaluations from its own. Values, residual
and intervals are those of all rows.

A row's noise is that of a mean times sqrt(k) if rows err independently. Where it is less, they err
together, and an interval is as much wider as means scatter more than their rows say
(``Estimated.coloured``).

The linear start integrates the motion, which a gap stops: it is given the rows before the first.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.events.noise_identification import are_known, noise_factors, noisier
from equipoise.estimation.events.record_model import (
    RecordModel,
    active,
    fitted_in,
    refitted,
    smoothed,
)
from equipoise.estimation.model_selection.decimation import TURNED, Condensed
from equipoise.estimation.model_selection.survey import survey
from equipoise.estimation.motion.sensor_noise import (
    camera_noise,
    gyro_noise,
    vector_noise,
    with_noise,
    with_vector_noise,
)
from equipoise.estimation.output_error.problem import Problem, quickest_swing
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.output_error.trajectory import Params, fit, problem_of
from equipoise.maths.attitude import turned_on
from equipoise.model.recording import Recording, window
from equipoise.model.testbed import Testbed

EARLY = 0.02  # of the record, chosen: the least part that the linear start is given
FINE = 2.0  # chosen: cuts are nodes too; the optimum may not depend on that by what a cut shows
WIDE = 3.0  # rows, chosen: a shorter interruption is no gap


def first_gap(recording: Recording, testbed: Testbed) -> float:
    """Return when (s) rows first stop for longer than a swing can be followed; the end if never."""
    start, end = recording.span
    found, least = end, start + EARLY * (end - start)
    for channel in (recording.attitude, recording.rate):
        if channel is not None and len(channel) > 1:
            separation = np.diff(channel.t)
            long = max(TURNED / quickest_swing(testbed), WIDE * channel.period)
            stops = channel.t[:-1][(separation > long) & (channel.t[:-1] > least)]
            found = min(found, float(stops[0])) if len(stops) else found
    return found


def fitted_means(few: Condensed, params: Params) -> tuple[Recording, Testbed, Params, Fitted]:
    """Return the plain fit of a condensed record, of what record, with what sensors and terms."""
    recording, testbed, params = few.recording, few.testbed, replace(params, fineness=FINE)
    early = window(recording, recording.span[0], first_gap(recording, testbed))
    return recording, testbed, params, fit(recording, testbed, params, early=early)


def with_noise_of(few: Condensed, model: RecordModel, testbed: Testbed) -> Testbed:
    """Return the testbed with a row's noise by that of the means: times sqrt(k).

    What the model says of the masses' log and of the gyro's clock holds for all rows, too.
    """
    gyro, found = testbed.gyro, model.testbed.gyro
    gyro = gyro and replace(gyro, clock=found.clock if found else 0.0)
    testbed = replace(testbed, masses=model.testbed.masses, gyro=gyro)
    testbed = with_vector_noise(testbed, vector_noise(model.testbed))
    camera, gyro = camera_noise(model.testbed), gyro_noise(model.testbed)
    return with_noise(testbed, camera * few.attitude_rows**0.5, gyro * few.rate_rows**0.5)


def moved(fitted: Fitted, problem: Problem) -> Fitted:
    """Return a fit with its first attitude where that of another record of the motion begins."""
    point, late = fitted.point, float(problem.line.t[0] - fitted.problem.line.t[0])
    q0 = turned_on(point.q0, point.w0, late)
    return replace(fitted, point=replace(point, q0=q0))


def with_all_rows(
    few: Condensed, model: RecordModel, recording: Recording, stated: Testbed
) -> RecordModel:
    """Return the model of a condensed record as one of the record, not fitted yet."""
    testbed = with_noise_of(few, model, stated)
    first = moved(model.fitted, problem_of(recording, testbed, model.params))
    params = replace(model.params, fineness=1.0)
    return replace(
        model, recording=recording, testbed=testbed, params=params, stated=stated, fitted=first
    )


def with_rows_own_noise(model: RecordModel) -> RecordModel:
    """Return the model with the rows' own noise, if that is not what their means say."""
    factors = noise_factors(*smoothed(model))
    if are_known(factors, model.fitted):
        return model
    testbed = noisier(model, *factors)
    return refitted(replace(model, testbed=testbed, coloured=max(1.0, 1.0 / min(factors))))


def surveyed_densely(
    few: Condensed, recording: Recording, testbed: Testbed, params: Params
) -> RecordModel:
    """Return the model that a dense record supports, and the fit of all rows in it."""
    model = survey(*fitted_means(few, params))
    whole = with_all_rows(few, model, recording, testbed)
    if not model.fitted.converged:
        return replace(whole, fitted=fitted_in(whole, active(whole), 1))
    whole = refitted(whole)
    return with_rows_own_noise(whole) if whole.fitted.converged else whole
