"""Hold: minutes after balancing the centre of mass is still where it was wanted."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.tracker import tracker
from equipoise.io.testbed.presets import read_preset
from equipoise.model.defects import TrueLamp
from equipoise.model.units import UM
from equipoise.procedure.balancing.hold import HoldOptions, balance_and_hold
from equipoise.procedure.balancing.hold_posterior import standing
from equipoise.procedure.balancing.hold_start import first_state
from equipoise.procedure.steps.joint_fit import learn
from equipoise.simulation.bench import SimulatedBench
from tests.support import thorough
from verification import lamp

MINUTES = thorough.count(2, 1)
HOLDING = HoldOptions(duration=60.0 * MINUTES)
# Ten minutes of balancing find the inertia that a long hold needs; a short one does without.
FIRST = replace(HOLDING.balancing, max_time=float(thorough.count(600, 100)))  # s


@pytest.fixture(scope="module")
def held():
    bench = SimulatedBench(read_preset("sputnix"), 3)
    return bench, list(balance_and_hold(bench, FIRST, HOLDING))


def test_a_short_hold_passes(held):
    """By the verdict, and by the truth at the end (3 um on every axis)."""
    bench, steps = held
    assert steps[-1].kind == "verify"
    assert steps[-1].verdict.passed, steps[-1].sentence
    assert f"held for {MINUTES} min" in steps[-1].sentence
    assert np.all(np.abs(bench.truth().com - HOLDING.target) < HOLDING.tolerance)


def test_the_hold_lasts_for_the_requested_time(held):
    """Minutes after the verdict on balancing."""
    _, steps = held
    balanced = [step for step in steps[:-1] if step.verdict is not None][-1]
    assert steps[-1].time - balanced.time == pytest.approx(60.0 * MINUTES, abs=1e-6)


def test_a_hold_whose_rails_end_fails_and_says_so():
    """Rails of 3 mm end within minutes of 10 um/min; the verdict on balancing is another one."""
    bed = read_preset("sputnix")
    drift = {"drift_x": 10 * UM / 60}
    truth = replace(bed.truth, torque=drift, com_low=np.array([-2, -2, -105]) * UM,
                    com_high=np.array([2, 2, -95]) * UM)  # fmt: skip
    rails = tuple(replace(mass, travel=(-0.012, 0.012)) for mass in bed.masses)
    bench = SimulatedBench(replace(bed, masses=rails, inertia_sd=0.01, truth=truth), 5)
    *_, last = balance_and_hold(bench, replace(FIRST, max_time=60.0), HoldOptions(duration=600.0))
    assert (last.kind, last.verdict.outcome) == ("stop", "failed")
    assert last.verdict.code == "rails_ended"
    assert "the ends of their rails" in last.sentence


def test_the_tracker_goes_on_under_a_lamp_that_is_on():
    """By the coefficients of the fit, and its switch before the hold: com within 4 sd later."""
    bed = lamp.roughly_known(lamp.logged(0))
    lit = TrueLamp(np.array([[20.0, 400.0]]))
    bed = replace(bed, truth=replace(bed.truth, lamp=lit))
    bench = SimulatedBench(bed, 1)
    knowledge = learn(None, bench.read(100.0), bed)
    state = first_state(knowledge, bed)
    np.testing.assert_array_equal(state.thermal, knowledge.estimate.values(lamp.TERMS))
    params = tracker.Params(torque=knowledge.fitted.point.torque)
    state = tracker.track(bench.read(100.0), bed, params, state).end
    held = standing(state, bed, knowledge.displacement)
    error = (held.com - bench.com) / np.sqrt(np.diag(held.covariance))
    assert np.abs(error).max() < 4.0
