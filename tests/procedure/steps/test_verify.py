"""Verdicts: probabilities worked by hand, and evidence against them."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import block_diag

from equipoise.dynamics.rigid_body import KNOWN_WARMTH
from equipoise.model.estimate import Parameter
from equipoise.model.move import Move
from equipoise.model.reasons.step_reasons import MoveReason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.torque_terms import GROUPS
from equipoise.model.units import UM
from equipoise.procedure.steps.joint_fit import learn_alone
from equipoise.procedure.steps.verify import (
    FRESH,
    Aim,
    com_then,
    fresh_enough,
    is_known,
    probability_within,
    verdict,
)
from tests.support.builders import noisy, platform, recording
from tests.support.outcomes import of_use


@pytest.fixture(scope="module")
def known():
    """A minute of camera, nothing moved, by a model without drift."""
    return learn_alone(noisy(recording(60.0), 1), platform())


def wide(known) -> np.ndarray:
    """A tolerance beyond doubt, 10 sd."""
    return 10 * known.sd


def test_probability_by_hand():
    """On target with 2 sd of tolerance 0.9545; at the edge 0.5; 1 sd beyond a wide one 0.1587."""
    com, sd = np.array([0.0, 10.0, 11.0]) * UM, np.array([5.0, 1e-3, 1.0]) * UM
    found = probability_within(com, sd, np.zeros(3), np.full(3, 10 * UM))
    np.testing.assert_allclose(found, [0.9545, 0.5, 0.1587], atol=5e-5)


def test_what_is_uncertain_fits_into_four_sd_and_not_into_one(known):
    """Of three axes 4 sd hold 99.98 %, one sd 0.6827^3 or, as they correlate, some more."""
    assert is_known(known, 4 * known.sd, 0.99)
    assert not is_known(known, known.sd, 0.7)


def test_on_target_passes(known):
    judged = verdict(known, None, 0.0, Aim(known.com, wide(known)))
    assert judged.passed
    assert judged.sentence.startswith("Passed")


def test_outside_fails_and_names_the_axis(known):
    target = known.com + np.array([0.0, 20.0, 0.0]) * known.sd
    judged = verdict(known, None, 0.0, Aim(target, wide(known)))
    assert judged.outcome == "failed"
    assert judged.reasons[0].parameters == ("y",)
    assert judged.sentence.endswith("y outside the tolerance.")


def test_too_uncertain_an_estimate_gives_an_inconclusive_verdict(known):
    """A tolerance of one sd holds with probability 0.68 at best."""
    judged = verdict(known, None, 0.0, Aim(known.com, known.sd))
    assert judged.outcome == "undecided"
    assert judged.sentence.startswith("Cannot tell")
    assert "not known precisely enough" in judged.sentence


@pytest.mark.parametrize(("off", "answer"), [(1.9, "undecided"), (2.1, "failed")])
def test_outside_by_less_than_is_known_is_not_outside_for_sure(known, off, answer):
    """Two sd beyond a tolerance: 1.96 of them leave 2.5 % for a truth within it."""
    tolerance = wide(known)
    target = known.com + np.array([0.0, 0.0, 1.0]) * (tolerance + off * known.sd)
    judged = verdict(known, None, 0.0, Aim(target, tolerance))
    assert judged.outcome == answer


def test_what_is_hardly_known_has_not_failed(known):
    """An sd of ten tolerances about the very target: 8 % within, and no failure."""
    judged = verdict(known, None, 0.0, Aim(known.com, 0.1 * known.sd))
    assert judged.sentence.startswith("Cannot tell")


@pytest.mark.parametrize(("off", "passes"), [(2.0, True), (20.0, False)])
def test_a_move_that_led_elsewhere_fails(known, off, passes):
    """The measurement after a move tests its prediction: 2 sd may be chance, 20 are not."""
    there = known.com + off * np.sqrt(2) * known.sd
    move = Move({}, 0.0, 1.0, there, known.covariance, MoveReason.TO_TARGET)
    judged = verdict(known, move, 0.0, Aim(known.com, wide(known)))
    assert judged.passed == passes
    assert (judged.code == "move_missed") != passes


def test_an_estimate_that_cannot_be_used_is_no_verdict(known):
    bad = replace(known, estimate=replace(known.estimate, outcome=of_use(False)))
    judged = verdict(bad, None, 0.0, Aim(known.com, wide(known)))
    assert judged.outcome == "undecided"
    assert judged.sentence == f"Cannot tell: {of_use(False).sentence}"


def test_a_verdict_needs_fresh_data(known):
    assert fresh_enough(known, 60.0 - FRESH)
    assert not fresh_enough(known, 60.0 - FRESH + 0.1)


def with_drift(known, drift, sd, names=GROUPS["drift"]):
    """The same knowledge with an independent drift (m/s), or warmth (m/K), in its estimate."""
    extra = tuple(
        Parameter(name, "m/s", float(rate), sd) for name, rate in zip(names, drift, strict=True)
    )
    covariance = block_diag(known.estimate.covariance, sd**2 * np.eye(3))
    parameters = (*known.estimate.parameters, *extra)
    estimate = replace(known.estimate, parameters=parameters, covariance=covariance)
    return replace(known, estimate=estimate)


def test_a_drift_that_is_not_known_is_no_contradiction(known):
    """Of a drift of 0 +- 1 um/min over 30 s, 1.5 um are 3 sd; without drift far more than 4."""
    move = Move({}, 0.0, 1.0, known.com + 1.5 * UM, 1e-18 * np.eye(3), MoveReason.TO_TARGET)
    aim, vague = Aim(known.com, wide(known)), with_drift(known, np.zeros(3), UM / 60)
    assert verdict(vague, move, 30.0, aim).passed
    assert [r.code for r in verdict(known, move, 30.0, aim).reasons] == [VerdictReason.MOVE_MISSED]


def test_drift_since_the_move_is_no_contradiction(known):
    """A drift of 1 um/min over 30 s moves the centre of mass 0.5 um beyond the prediction."""
    drifting = with_drift(known, (1 / 60) * UM * np.array([1.0, -2.0, 0.0]), 1e-9)
    before, sd = com_then(drifting, 30.0)
    np.testing.assert_allclose(known.com - before, [0.5 * UM, -1.0 * UM, 0.0], rtol=1e-9)
    np.testing.assert_allclose(sd, np.hypot(known.sd, 30e-9), rtol=1e-12)
    np.testing.assert_array_equal(com_then(known, 30.0)[0], known.com)
    move = Move({}, 0.0, 1.0, before, 1e-18 * np.eye(3), MoveReason.TO_TARGET)
    assert verdict(drifting, move, 30.0, Aim(known.com, wide(known))).passed


def test_warmth_since_the_move_is_no_contradiction(known):
    """Warmer by 1 K before the move and by 2 K behind it: only the latter moved it since."""
    warm = with_drift(known, UM * np.array([1.0, 0.0, -0.5]), 1e-9, GROUPS["thermal"])
    line = warm.fitted.problem.line
    inputs = line.known.copy()
    inputs[:, KNOWN_WARMTH] = np.interp(line.t, [0.0, 30.0, 60.0], [0.0, 1.0, 3.0])
    problem = replace(warm.fitted.problem, line=line._replace(known=inputs))
    warm = replace(warm, fitted=replace(warm.fitted, problem=problem))
    before, sd = com_then(warm, 30.0)
    np.testing.assert_allclose(known.com - before, [2.0 * UM, 0.0, -1.0 * UM], rtol=1e-9)
    np.testing.assert_allclose(sd, np.hypot(known.sd, 2e-9), rtol=1e-12)
