"""Rows where what was found puts them: a log of the masses that is late."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.lags import STAMP_SD, lagging
from equipoise.estimation.model_selection.reference_fit import modelled
from equipoise.estimation.model_selection.row_timing import by_lag, retimed
from equipoise.estimation.output_error.predict import predict
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.maths.attitude import difference
from equipoise.model.estimate import INERTIA as NAMES
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.recording import Samples
from tests.support.builders import INERTIA, move_at, noisy, platform, recording

LATE = 0.35  # s, where 0.1 is one sd: the masses travel for one second and for four
AFTER = move_at(40.0, 120.0)


@pytest.fixture(scope="module")
def late():
    """The shared record with its log stamped late: testbed, record, model and estimate."""
    testbed, record = platform(gyro=True), noisy(recording(120.0, AFTER, gyro=20.0), 0)
    record = replace(record, masses=Samples(AFTER.t + LATE, AFTER.values))
    model, found = modelled(record, testbed, Params())
    return testbed, record, model, found


def test_the_lag_is_found_and_inertia_is_right(late):
    *_, found = late
    (reason,) = [r for r in found.outcome.reasons if r.code is Why.LATE_LOG]
    lag = found.parameters[found.index(reason.parameters[0])]
    assert abs(lag.value + LATE) < 4 * lag.sd < 0.1 * LATE
    assert found.events == ()
    sd = np.sqrt(np.diag(found.covariance_of(NAMES)))
    assert np.all(np.abs(found.values(NAMES) - INERTIA) < 4 * sd)


def test_masses_are_placed_by_the_lag_and_what_is_left_is_small(late):
    """The fit is that of a log set right, but that this lag is unlikely: (0.35 / 0.1)^2 / 2."""
    _, record, model, _ = late
    assert model.testbed.masses[0].lag == pytest.approx(-LATE, abs=0.02)
    assert by_lag(model) is model
    assert retimed(model) is model
    prompt = replace(model.testbed, masses=lagging(model.testbed.masses, 0.0))
    right = fit(replace(record, masses=AFTER), prompt, model.params)
    unlikely = (LATE / STAMP_SD) ** 2 / 2
    assert model.fitted.at.cost - right.at.cost == pytest.approx(unlikely, rel=0.1)


def test_the_prediction_places_the_masses_as_the_fit_did(late):
    testbed, record, _, found = late
    motion = predict(record, testbed, found)
    left = difference(motion.q, record.attitude.values)
    assert np.sqrt(np.mean(left**2)) == pytest.approx(found.residual.attitude_rms, rel=0.02)
