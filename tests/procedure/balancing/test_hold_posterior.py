"""What a hold predicts of a centre of mass that drifts, and when its masses can follow no more."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.tracker import tracker
from equipoise.io.testbed.presets import read_preset
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.recording import Recording
from equipoise.model.units import UM
from equipoise.procedure.balancing.hold import HoldOptions, reason_to_stop
from equipoise.procedure.balancing.hold_posterior import COM_WALK, ahead, moved_on
from equipoise.procedure.balancing.hold_verdict import Measured
from equipoise.procedure.steps.planned_move import planned_move

HOLDING = HoldOptions(duration=60.0)
NOW = Measured(np.array([1.0, 0.0, -100.0]) * UM, np.diag([0.04, 0.04, 0.25]) * UM**2)


def drifting_state(rate_um_s=0.05, sd_um_s=0.02, shared=0.5):
    """A state that drifts along x, whose rate and place correlate."""
    state = tracker.first_state(0.0, np.array([1.0, 0, 0, 0]), read_preset("sputnix"))
    covariance = state.covariance.copy()
    covariance[18:21, 18:21] = (sd_um_s * UM) ** 2 * np.eye(3)
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
    there = HOLDING.target + np.array([at_um, 0, 0]) * UM
    bed = read_preset("sputnix")
    assert reason_to_stop(Recording(), there, displacement, bed, HOLDING) is why
