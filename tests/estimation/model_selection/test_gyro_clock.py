"""A gyro whose clock is not the camera's, on records that MuJoCo made."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.model_selection.model_choice import CLOCK, candidates
from equipoise.estimation.model_selection.reference_fit import estimate
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.recording import Samples
from equipoise.model.testbed import AttitudeSensor, Gyro
from tests.oracle import cases
from tests.oracle import mujoco_bench as oracle
from tests.support import thorough
from verification.stated_errors import NAMES, true_values

CLOCK_SD, FAST = 5e-4, 7e-4  # relative
CAMERA = AttitudeSensor(10.0, np.radians(0.05))
GYRO = Gyro(20.0, 1e-4, np.radians(0.5), clock_sd=CLOCK_SD)
SECONDS, SPIN = 120.0, np.radians(60.0)
MOVE = np.array([-0.010, -0.010, -0.030])  # m, at half of the record


@cache
def recorded(fast: float, seed: int = 0):
    """Return platform, record whose gyro's clock is so fast, and testbed."""
    case, rng = cases._fourteen_case(seed, 300.0, CAMERA, GYRO), np.random.default_rng([seed, 4])
    rate = case.platform.rate + np.array([0.0, 0.0, SPIN])
    platform = replace(case.platform, rate=rate)
    t = oracle.middles(SECONDS, 1e-3)[:, None]
    share = oracle.smooth(np.clip((t - SECONDS / 2) / 3.0, 0.0, 1.0))
    run = oracle.driven(platform, share * MOVE, np.zeros((len(t), 3)))
    record = oracle.sensor_log(run, rng, 10.0, CAMERA.noise, 20.0, GYRO.noise, mass_rate=10.0)
    gyro = Samples(record.rate.t * (1 + fast), record.rate.values)
    return platform, replace(record, rate=gyro), case.testbed


@pytest.mark.parametrize("seed", thorough.some([0, 1], 1))
def test_a_gyros_clock_is_found_where_the_motion_shows_it(seed):
    """0.07 % fast: 5 deg of phase in two minutes. Found to 4 sd, J and com too; no events."""
    platform, record, testbed = recorded(FAST, seed)
    found = estimate(record, testbed, Params())
    names = ("gyro_clock", *NAMES)
    truth = np.append(FAST, true_values(platform))
    sd = np.sqrt(np.diag(found.covariance_of(names)))
    assert np.abs((found.values(names) - truth) / sd).max() < 4.0
    assert sd[0] < 0.03 * CLOCK_SD
    assert not found.events
    (reason,) = [r for r in found.outcome.reasons if r.code is Why.GYRO_CLOCK]
    assert reason.numbers["fast"] == found.values(("gyro_clock",))[0]


def test_one_clock_needs_no_term():
    """Gyro and camera on one clock: nothing is corrected."""
    _, record, testbed = recorded(0.0)
    assert not estimate(record, testbed, Params()).has("gyro_clock")


def test_a_clock_stated_as_exact_is_no_candidate():
    """clock_sd 0: the file says that there is one clock."""
    _, record, testbed = recorded(FAST)
    found, cuts = fit(record, testbed, Params()), np.arange(1.0, SECONDS - 1)
    model = RecordModel(record, testbed, Params(), cuts, np.zeros(3), (), found, testbed)
    exact = replace(testbed, gyro=replace(testbed.gyro, clock_sd=0.0))
    assert CLOCK in candidates(model)
    assert CLOCK not in candidates(replace(model, testbed=exact))


@thorough.whole
def test_a_clock_stated_as_exact_is_not_sought():
    """All else is, which takes long: the record does not explain itself."""
    _, record, testbed = recorded(FAST)
    exact = replace(testbed, gyro=replace(testbed.gyro, clock_sd=0.0))
    assert not estimate(record, exact, Params()).has("gyro_clock")
