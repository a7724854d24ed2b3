"""Rows where the clock and the lag that were found put them.

A fit reads the gyro's rows, and places the masses, to first order about the times at which they are
stamped. A clock that is off takes a row many steps of integration away, and a log that is late by
the length of a travel is no small error of it. So once either is found, rows are timed by it, and
the fit seeks the little that is left: Gauss-Newton in the time, as in everything else. What is
reported is both together (``problem.counted_by_timing``).

Lags of drives of several kinds are left to first order.
"""

from dataclasses import replace

import numpy as np

from equipoise.actuators.lags import LAG, lagging
from equipoise.estimation.events.record_model import RecordModel, refitted
from equipoise.estimation.output_error.solution import cost_of
from equipoise.estimation.output_error.trajectory import fit
from equipoise.model import sensor_terms
from equipoise.model.sensor_terms import GYRO_CLOCK

TURNS = 3  # chosen: of a lag that is found anew each time
SMALL = 1e-3  # s, chosen: less of a lag is left to first order


def with_clock(model: RecordModel, fast: float) -> RecordModel:
    """Return the model with the gyro's rows timed by a clock that is so fast, not fitted yet."""
    assert model.testbed.gyro is not None
    gyro = replace(model.testbed.gyro, clock=fast)
    return replace(model, testbed=replace(model.testbed, gyro=gyro))


def with_lag(model: RecordModel, lag: float) -> RecordModel:
    """Return the model with masses that follow their rows so late (s), not fitted yet."""
    testbed = replace(model.testbed, masses=lagging(model.testbed.masses, lag))
    return replace(model, testbed=testbed)


def by_clock(model: RecordModel) -> RecordModel:
    """Return the model with the gyro's rows where the clock that was found puts them, not fitted.

    The same model where none is sought.
    """
    gyro, point = model.testbed.gyro, model.fitted.point
    if GYRO_CLOCK not in model.params.sensor or gyro is None:
        return model
    at = sensor_terms.TERMS.index(GYRO_CLOCK)
    sensor = np.where(np.arange(len(point.sensor)) == at, 0.0, point.sensor)
    fitted = replace(model.fitted, point=replace(point, sensor=sensor))
    return with_clock(replace(model, fitted=fitted), gyro.clock + float(point.sensor[at]))


def by_lag(model: RecordModel) -> RecordModel:
    """Return the model with the masses where the lag that was found puts them, not fitted.

    The same model where that is small, or there is none or more than one.
    """
    point, names = model.fitted.point, model.fitted.problem.layout.errors
    lags = [k for k, name in enumerate(names) if name.startswith(LAG)]
    if len(lags) != 1 or abs(point.error[lags[0]]) < SMALL:
        return model
    error = np.where(np.arange(len(names)) == lags[0], 0.0, point.error)
    fitted = replace(model.fitted, point=replace(point, error=error))
    found = model.testbed.masses[0].lag + float(point.error[lags[0]])
    return with_lag(replace(model, fitted=fitted), found)


def started_anew(model: RecordModel) -> RecordModel:
    """Return the model from the linear methods again, where it strayed while masses were off.

    One with events, which came from where it strayed to, is left as it is.
    """
    if model.events or model.fitted.converged:
        return model
    found = fit(model.recording, model.testbed, model.params)
    return replace(model, fitted=min(model.fitted, found, key=cost_of))


def retimed(model: RecordModel) -> RecordModel:
    """Return the model with all rows where what was found puts them, fitted again."""
    timed = by_clock(model)
    if timed is not model:
        model = refitted(timed)
    for turn in range(TURNS):
        timed = by_lag(model)
        if timed is model:
            break
        model = refitted(timed) if turn else started_anew(refitted(timed))
    return model
