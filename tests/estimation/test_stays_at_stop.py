"""A platform that lies on its stop is pressed there: no estimate of that record is to be used."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.estimation.events.record_model import Happening
from equipoise.estimation.method_contract import Options, estimated
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.model_selection.reference_fit import estimate as identified
from equipoise.estimation.model_selection.reference_fit import modelled
from equipoise.estimation.model_selection.survey_reasons import pressed_stays
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.stays_at_stop import (
    judged_by_stays,
    longest_without,
    stay_reasons,
    stays,
    swing_time,
)
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential
from equipoise.model.estimate import Estimate
from equipoise.model.outcome import OutcomeCode
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.recording import Recording, Samples, window
from equipoise.model.verdict import VerdictOutcome
from equipoise.procedure.identification.assess import AssessOptions, assess
from equipoise.simulation.carried_out import performed
from tests.support.outcomes import of_use

BED = read_preset("sputnix")
LIMIT = BED.tilt_limit
MOVES = [(30.0, {"x1": -0.01, "y1": -0.01, "z1": -0.05})]


def leaning(shares):
    """A record that leans about x by shares of the limit, five rows a second."""
    turns = np.outer(np.array(shares) * LIMIT, [1.0, 0.0, 0.0])
    return Recording(Samples(0.2 * np.arange(len(shares)), exponential(turns)))


def empty(usable=True):
    return Estimate("trajectory", of_use(usable), (), np.zeros((0, 0)))


@cache
def lying():
    """A bench whose platform swings to its stop, and lies there until a mass goes down."""
    bench, record = performed(BED, 114, None, 60.0, MOVES)
    (touch,) = bench.touches
    assert touch.end - touch.start > 20.0
    return record, touch


@cache
def estimate_of(name):
    """What a method makes of that record."""
    return estimated(METHODS[name], lying()[0], BED, Options())


def test_a_stay_is_at_the_limit_for_long():
    """Rows 10 to 29, 2 to 5.8 s; not a touch of 1 s, nor what leans half as much again."""
    assert stays(leaning([0.5] * 10 + [1.0] * 20 + [0.5] * 10), BED) == [(2.0, pytest.approx(5.8))]
    assert stays(leaning([0.5] * 10 + [1.0] * 6 + [0.5] * 10), BED) == []
    assert stays(leaning([0.5] * 10 + [1.5] * 20 + [0.5] * 10), BED) == []
    assert stays(Recording(rate=Samples(np.arange(3.0), np.zeros((3, 3)))), BED) == []


def test_the_longest_part_without():
    record = leaning([0.5] * 51)  # 10 s
    assert longest_without(record, [(1.0, 2.0), (7.0, 8.0)]) == (2.0, 7.0)
    assert longest_without(record, [(6.0, 8.0)]) == (0.0, 6.0)


def test_the_longest_stay_is_named_with_the_longest_part():
    (reason,) = stay_reasons(leaning([0.5] * 51), [(1.0, 2.0), (7.0, 9.0)])
    assert reason.numbers == {"start": 7.0, "end": 9.0, "first": 2.0, "last": 7.0}
    assert stay_reasons(leaning([0.5] * 51), []) == ()


def test_a_swing_turns_by_a_radian_within_this_time():
    """sqrt(J / (m g r)) with the mean moment and the distance of the testbed's body."""
    body = replace(BED.body, com=np.array([0.0, 0.0, -1e-4]))
    body = replace(body, inertia_P=np.diag([0.4, 0.5, 0.6]))
    bed = replace(BED, body=replace(body, mass=0.5 / 9.0 / BED.gravity / 1e-4))
    assert swing_time(empty(), bed) == pytest.approx(3.0)


@pytest.mark.parametrize(("rows", "rejected"), [(20, False), (100, True)])
def test_a_stay_longer_than_a_turn_rejects_any_estimate(rows, rejected):
    """The testbed's swing turns by a radian within some seconds: not 4 s, but 20."""
    record = leaning([0.5] * 100 + [1.0] * rows + [0.5] * 100)
    assert 4.0 < swing_time(empty(), BED) < 19.0
    found = judged_by_stays(empty(), record, BED)
    assert (found.outcome.code is OutcomeCode.MODEL_REJECTED) == rejected


def test_what_is_not_usable_stays_as_it_is():
    unusable, record = empty(usable=False), leaning([1.0] * 100)
    assert judged_by_stays(unusable, record, BED) is unusable


@pytest.mark.parametrize("name", METHODS)
def test_no_method_states_numbers_of_a_record_with_a_stay(name):
    assert not estimate_of(name).outcome.usable


def test_the_stay_and_the_part_without_it_are_those_of_the_bench():
    record, touch = lying()
    found = estimate_of("trajectory")
    (reason,) = [r for r in found.outcome.reasons if r.code is Why.LAY_ON_STOP]
    assert reason.numbers["start"] == pytest.approx(touch.start, abs=0.3)
    assert touch.end < reason.numbers["end"] == reason.numbers["first"] < touch.end + 5.0
    assert reason.numbers["last"] == record.span[1]
    part = window(record, reason.numbers["first"], reason.numbers["last"])
    assert identified(part, BED, Params()).outcome.usable


def test_an_assessment_of_a_record_with_a_stay_has_no_verdict():
    *_, last = assess(lying()[0], BED, AssessOptions(require_torque=1.0))
    assert last.verdict is not None
    assert last.verdict.outcome is VerdictOutcome.UNDECIDED


def test_a_swing_that_turns_near_the_limit_is_estimated():
    """Its turn takes 2 s there and is no stay, as the fit needs no push; with one it would be."""
    bench, record = performed(BED, 1, None, 60.0, MOVES)
    assert not bench.touches
    ((start, end),) = stays(record, BED)
    model, found = modelled(record, BED, Params())
    assert found.outcome.usable
    assert pressed_stays(model) == []
    pushed = replace(model, events=(Happening(0.5 * (start + end), "impulse"),))
    assert pressed_stays(pushed) == [(start, end)]
