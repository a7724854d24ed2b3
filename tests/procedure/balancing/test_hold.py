"""Hold: minutes after balancing the centre of mass is still where it was wanted."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.tracker import tracker
from equipoise.io.testbed.presets import read_preset
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.recording import Recording
from equipoise.model.units import UM
from equipoise.procedure.balancing.hold import (
    HoldOptions,
    balance_and_hold,
    reason_to_stop,
    without_drift,
)
from equipoise.procedure.balancing.hold_posterior import COM_WALK, ahead, moved_on
from equipoise.procedure.balancing.hold_verdict import Measured
from equipoise.procedure.steps.planned_move import planned_move
from equipoise.simulation.bench import SimulatedBench
from tests.support import thorough

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


def test_drift_is_left_to_the_tracker():
    kept = without_drift(np.arange(1.0, 17.0))
    np.testing.assert_array_equal(kept, [*np.arange(1.0, 14.0), 0.0, 0.0, 0.0])


NOW = Measured(np.array([1.0, 0.0, -100.0]) * UM, np.diag([0.04, 0.04, 0.25]) * UM**2)


def drifting_state(rate_um_s=0.05, sd_um_s=0.02, shared=0.5):
    """A state that drifts along x, whose rate and place correlate."""
    state = tracker.first_state(0.0, np.array([1.0, 0, 0, 0]), read_preset("sputnix"))
    covariance = state.covariance.copy()
    covariance[18:, 18:] = (sd_um_s * UM) ** 2 * np.eye(3)
    covariance[6, 18] = covariance[18, 6] = shared * 0.2 * sd_um_s * UM**2
    return replace(state, drift=np.array([rate_um_s, 0, 0]) * UM, covariance=covariance)


def test_a_while_later_it_has_drifted_and_is_known_less():
    """5 s at 0.05 um/s: 0.25 um. Variance 0.04 + 2 x 5 x 0.002 + 25 x 0.0004 + 5 x 0.0025 um^2."""
    later = ahead(NOW, drifting_state(), 5.0)
    np.testing.assert_allclose(later.com, np.array([1.25, 0, -100]) * UM, atol=1e-15)
    assert later.covariance[0, 0] / UM**2 == pytest.approx(0.04 + 0.02 + 0.01 + 0.0125)
    assert later.covariance[1, 1] / UM**2 == pytest.approx(0.04 + 0.01 + 0.0125)
    assert pytest.approx(0.05 * UM) == COM_WALK


def test_a_move_takes_the_drift_along():
    """x1 and x2 go 1 mm: 2.19 um less, where 0.25 um of drift come on top, and two stops of sd."""
    bed, goal = read_preset("sputnix"), np.array([-1e-3, -1e-3, 0, 0, 0, 0])
    move = planned_move(bed, np.zeros(6), goal, (NOW.com, NOW.covariance), "drift")
    later = ahead(NOW, drifting_state(), 5.0)
    found, gram = moved_on(move, NOW, later), 15.6e-3 / 14.24
    assert found.com[0] == pytest.approx(1.25 * UM - 2e-3 * gram, abs=1e-12)
    stops = 2 * (gram * 0.333e-3) ** 2
    assert found.covariance[0, 0] == pytest.approx(later.covariance[0, 0] + stops)
    assert found.covariance[1, 1] == pytest.approx(later.covariance[1, 1])


@pytest.mark.parametrize(
    ("at_um", "why"), [(3.2, None), (-3.2, VerdictReason.RAILS_ENDED), (-2.8, None)]
)
def test_a_hold_ends_with_the_rails_that_the_drift_needs(at_um, why):
    """x1 and x2 stand at +50 mm: they can take com to -x alone, and the tolerance is 3 um."""
    displacement = np.array([0.05, 0.05, 0, 0, 0, 0])
    there = Measured(HOLDING.target + np.array([at_um, 0, 0]) * UM, NOW.covariance)
    bed = read_preset("sputnix")
    assert reason_to_stop(Recording(), there, displacement, bed, HOLDING) is why


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
    assert "the end of their rails" in last.sentence
