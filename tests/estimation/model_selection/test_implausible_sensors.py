"""Errors of sensors that no real one has: a sign that something is read the wrong way."""

from dataclasses import replace

import pytest

from equipoise.estimation.model_selection.reference_fit import estimate
from equipoise.estimation.output_error.trajectory import Params
from equipoise.model.outcome import Trust
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.recording import Samples
from tests.oracle import cases
from tests.support import thorough


def turned_round(record):
    """Return the record with quaternions that turn from the laboratory to the body."""
    q = record.attitude.values * [1.0, -1.0, -1.0, -1.0]
    return replace(record, attitude=Samples(record.attitude.t, q))


@pytest.mark.parametrize("seed", range(thorough.count(3, 1)))
def test_a_quaternion_that_turns_the_other_way_is_not_trusted(seed):
    """Camera and gyro cannot both be right; what absorbs it is no error of a gyro."""
    logged = cases.case_i(seed)
    found = estimate(turned_round(logged.recording), logged.testbed, Params())
    assert found.outcome.trust in {Trust.NOT_TRUSTWORTHY, Trust.NOT_USABLE}


@pytest.mark.parametrize("seed", range(thorough.count(3, 1)))
def test_a_gyro_with_errors_that_gyros_have_is_trusted(seed):
    """Scale 1 % and 0.3 deg of misalignment, as low-cost ones have."""
    logged = cases.case_i(seed, ("gyro",))
    found = estimate(logged.recording, logged.testbed, Params())
    assert found.outcome.usable
    assert Why.SENSOR_IMPLAUSIBLE not in {reason.code for reason in found.outcome.reasons}
