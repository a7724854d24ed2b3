"""Balancing a platform whose centre of mass drifts by 1 um/min, which nobody declared."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.torque_terms import GROUPS
from equipoise.procedure.balancing.balance import BalanceOptions, balance
from equipoise.simulation.bench import SimulatedBench
from verification.drift import drifting


def run(testbed, seed):
    bench = SimulatedBench(testbed, seed)
    return bench, list(balance(bench, BalanceOptions()))


def stated(steps):
    """The steps that state what to declare."""
    return [step for step in steps if any(r.code is Why.TERMS_TO_DECLARE for r in step.reasons)]


@pytest.mark.parametrize("seed", [2, 8])
def test_a_drift_that_nobody_declared_is_found_and_stated(seed):
    """Com at the verdict within 4 sd (9 and 13 without drift in the model), and it passes."""
    bench, steps = run(replace(drifting(seed), disturbances=()), seed)
    judged = steps[-1].verdict
    assert np.abs((judged.com - bench.truth().com) / judged.sd).max() < 4.0
    assert judged.passed
    assert np.all(np.abs(bench.truth().com - BalanceOptions().target) < BalanceOptions().tolerance)
    (step,) = stated(steps)
    assert "[disturbance] consider in the testbed file: drift" in step.sentence
    assert any(r.code is Why.TERMS_TO_DECLARE for r in steps[-1].estimate.outcome.reasons)


def test_a_drift_that_does_not_show_is_in_the_interval_of_com():
    """In 52 s 1 um/min does not show; com was 4.6 sd off. It is in the model, unstated."""
    bench, steps = run(replace(drifting(1), disturbances=()), 1)
    judged = steps[-1].verdict
    assert not stated(steps)
    assert steps[-1].estimate.has("drift_y")
    assert np.abs((judged.com - bench.truth().com) / judged.sd).max() < 4.0


def test_nothing_is_stated_of_a_platform_that_stands_still():
    """Nor is anything found: the drift's interval holds none."""
    _, steps = run(read_preset("sputnix"), 3)
    assert steps[-1].verdict.passed
    assert not stated(steps)
    estimate = steps[-1].estimate
    sd = np.sqrt(np.diag(estimate.covariance_of(GROUPS["drift"])))
    assert np.all(np.abs(estimate.values(GROUPS["drift"])) < 4.0 * sd)
