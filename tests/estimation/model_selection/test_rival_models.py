"""Models in which a record is about as probable count in the intervals of the likeliest."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.estimation.events.record_model import Rival, improbability, refitted
from equipoise.estimation.model_selection import model_comparison
from equipoise.estimation.model_selection.model_choice import HEADING, without_group
from equipoise.estimation.model_selection.reference_fit import modelled
from equipoise.estimation.model_selection.rival_models import chosen, weights, with_rivals
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.trajectory import METHOD, Params
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.procedure.steps.clean_record import sound
from tests.oracle.corpus import corpus_record
from tests.support.builders import move_at, noisy, platform, recording
from verification.judged_records import part_of

ROD = 92  # by a gyro; its first half shows drag and an event
ASIDE = np.array([3e-6, 0.0, 0.0])  # m


@cache
def found():
    """A model of a clean record, with an error of the camera that may as well be zero."""
    return modelled(noisy(recording(60.0, move_at(30.0, 60.0)), 0), platform(), Params())


@cache
def two():
    """That model, and the one without the error, of the same record."""
    model = replace(found()[0], rivals=())
    return model, refitted(without_group(model, HEADING))


def test_weights_are_the_probabilities_of_the_rivals():
    """Behind by 0 and by 2 ln 2: 1, 1 and 1/2 of 2.5 in all."""
    model, _ = found()
    rivals = (Rival(model, 0.0), Rival(model, 2 * np.log(2)))
    np.testing.assert_allclose(weights(rivals), [0.4, 0.2])


def test_the_likeliest_is_taken_and_the_other_is_its_rival():
    models = two()
    best = chosen(models)
    (rival,) = best.rivals
    costs = sorted(map(improbability, models))
    assert improbability(best) == pytest.approx(costs[0])
    assert rival.behind == pytest.approx(costs[1] - costs[0])
    assert {best.params.sensor, rival.model.params.sensor} == {m.params.sensor for m in models}


def test_a_choice_among_choices_knows_all_rivals_once():
    best = chosen(two())
    again = chosen([best, *two()])
    assert [r.behind for r in again.rivals] == pytest.approx([r.behind for r in best.rivals])
    assert chosen([best]).rivals[0].model is best.rivals[0].model


@pytest.mark.parametrize(("behind", "count"), [(8.9, 1), (9.1, 0)])
def test_what_is_well_behind_is_no_rival(behind, count):
    model, bare = two()
    assert len(chosen([replace(model, rivals=(Rival(bare, behind),))]).rivals) == count


def test_what_does_not_explain_all_keeps_its_rivals(monkeypatch):
    """Beside the model with process noise, of which the one at hand is taken here."""
    model, bare = two()
    monkeypatch.setattr(model_comparison, "is_calm", lambda _: False)
    (rival,) = model_comparison.compared(model, model, pushed=bare).rivals
    assert rival.behind == pytest.approx(chosen(two()).rivals[0].behind)


def test_intervals_count_the_distance_of_a_rival():
    """As likely as the taken one: half of the square of its distance."""
    model, _ = found()
    aside = replace(
        model.fitted, point=replace(model.fitted.point, com=model.fitted.point.com + ASIDE)
    )
    rival = Rival(replace(model, rivals=(), fitted=aside), 0.0)
    before = conclude(model.fitted, METHOD, model.recording)
    after = with_rivals(before, replace(model, rivals=(rival,)))
    k = before.index("com_x")
    assert after.covariance[k, k] == pytest.approx(before.covariance[k, k] + ASIDE[0] ** 2 / 2)
    assert after.parameters[k].sd == pytest.approx(after.covariance[k, k] ** 0.5)
    assert after.parameters[k].value == before.parameters[k].value
    assert Why.RIVAL_MODELS in [reason.code for reason in after.outcome.reasons]


def test_without_rivals_nothing_changes():
    model, _ = found()
    before = conclude(model.fitted, METHOD, model.recording)
    assert with_rivals(before, replace(model, rivals=())) is before


def test_drag_beside_an_event_is_found_in_half_a_minute():
    """J_yz of half a minute of MuJoCo's rod is 6.6 sd off where drag passes for a second event."""
    record = corpus_record(ROD)
    _, estimate = modelled(*sound(part_of(record.recording, 1), record.testbed), Params())
    k = estimate.index("inertia_P_yz")
    off = estimate.parameters[k].value - record.truth.inertia_P[1, 2]
    assert abs(off) < 3 * estimate.parameters[k].sd
    assert "quadratic" in [p.name for p in estimate.parameters]
