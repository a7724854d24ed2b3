"""A search ends when its budget is spent, with the best that it has, and says what it left.

No clock here: a budget is spent after so many questions.
"""

import itertools
import tracemalloc
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.model_selection.drift_smoother import estimate as smoothed_estimate
from equipoise.estimation.output_error import solution
from equipoise.estimation.output_error.solution import settle
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.estimation.search_budget import UNLIMITED, Budget, Stage
from equipoise.model.errors import InputError
from equipoise.model.estimate import BODY
from equipoise.model.outcome import Trust
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.recording import Samples
from equipoise.procedure.identification.assess import AssessOptions, assess
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.procedure.steps.joint_fit import learn
from tests.support.builders import guessed_wrong, level, noisy, platform, recording
from tests.support.event_records import KINDS, TRUTH, eventful

CUT_SHORT = {Why.BUDGET_SPENT, Why.BUDGET_TOO_SMALL}
TOUCH = 100 * KINDS["impulse"][2]  # rad/s
BED = level(platform(gyro=True))
MEMORY = 200e6  # bytes; nodes of the longest record that is integrated take as much
SURE = 5.0  # sd: beyond is wrong


class Stages(Counter):
    """What a search was at, and how often."""

    def update_one(self, stage):
        self[stage] += 1


def budget(questions, stages=None):
    stages = Stages() if stages is None else stages

    def begin():
        number = itertools.count()
        return lambda: next(number) >= questions

    return Budget(begin, stages.update_one)


@pytest.fixture(scope="module")
def touched():
    """A platform that is touched at 22 s, as noisy sensors see it."""
    return noisy(eventful(touch=TOUCH), 4)


def estimated(record, bed, budget):
    *_, last = identify(record, bed, IdentifyOptions("trajectory", budget=budget))
    return last.estimate


def test_a_budget_begins_with_the_first_question_and_keeps_what_was_refused():
    stages = Stages()
    allowed = budget(2, stages)
    answers = [allowed.allows(stage) for stage in (Stage.NOISE, Stage.EVENTS, Stage.EVENTS)]
    assert answers == [True, True, False]
    assert not allowed.allows(Stage.EVENTS)
    assert not allowed.allows(Stage.MODELS)
    assert allowed.unfinished == (Stage.EVENTS, Stage.MODELS)
    assert stages == {Stage.NOISE: 1, Stage.EVENTS: 3, Stage.MODELS: 1}
    assert allowed.renewed().allows(Stage.EVENTS)


def test_the_budget_of_whoever_sets_none_has_no_end():
    assert all(UNLIMITED.allows(stage) for stage in Stage)
    assert UNLIMITED.unfinished == ()


def test_a_descent_in_parts_goes_the_way_of_one_that_is_not_stopped(monkeypatch):
    """To the bit, however far off it begins: it goes on with the damping that it had."""
    record = noisy(recording(20.0, gyro=20.0), 3, np.zeros(3))
    bed = guessed_wrong(platform(gyro=True))
    problem = problem_of(record, bed, Params(use_prior=True))
    off = replace(TRUTH, com=TRUTH.com + 3e-4, w0=TRUTH.w0 * 1.2, error=np.zeros(0))
    whole = settle(problem, off)
    monkeypatch.setattr(solution, "AT_ONCE", 1.0)
    parts = settle(problem, off)
    assert whole.evaluations > 3 * solution.FEWEST
    assert parts.evaluations == whole.evaluations
    assert parts.converged
    np.testing.assert_array_equal(parts.point.flat, whole.point.flat)


def test_a_descent_ends_between_parts_once_its_budget_is_spent(monkeypatch):
    monkeypatch.setattr(solution, "AT_ONCE", 1.0)
    record = noisy(recording(20.0, gyro=20.0), 3, np.zeros(3))
    allowed = budget(1)
    problem = problem_of(record, platform(gyro=True), Params(budget=allowed))
    off = replace(TRUTH, com=TRUTH.com + 3e-4, w0=TRUTH.w0 * 1.2, error=np.zeros(0))
    found = settle(problem, off)
    assert (found.evaluations, found.converged) == (2 * solution.FEWEST, False)
    assert found.at.cost < settle(problem, off, most=1).at.cost
    assert allowed.unfinished == (Stage.MOTION,)


@pytest.mark.parametrize("questions", [0, 1, 4, 12, 30])
def test_a_search_that_is_cut_short_ends_finite_and_is_not_trusted(questions, touched, monkeypatch):
    """What remains to do then does not depend on what was left: few descents."""
    calls, descend, allowed = Counter(), solution.gauss_newton.descend, budget(questions)

    def counted(*given):
        calls[not allowed.unfinished] += 1
        return descend(*given)

    monkeypatch.setattr(Budget, "renewed", lambda self: self)
    monkeypatch.setattr(solution.gauss_newton, "descend", counted)
    found = estimated(touched, BED, allowed)
    codes = {reason.code for reason in found.outcome.reasons}
    assert len(codes & CUT_SHORT) == 1
    assert found.outcome.trust in (Trust.NOT_TRUSTWORTHY, Trust.NOT_USABLE)
    assert np.isfinite(found.values(BODY)).all()
    (why,) = (reason for reason in found.outcome.reasons if reason.code in CUT_SHORT)
    assert why.parameters == tuple(stage.value for stage in allowed.unfinished)
    assert "--budget-s 300" in why.sentence
    assert calls[False] < 60
    if found.outcome.usable:
        truth = TRUTH.body(BED.body.mass)
        off = found.com - truth.com
        assert np.abs(off / found.sd(("com_x", "com_y", "com_z"))).max() < SURE


def test_a_search_that_is_finished_says_nothing_of_its_budget(touched):
    stages = Stages()
    found = estimated(touched, BED, budget(100_000, stages))
    assert not {reason.code for reason in found.outcome.reasons} & CUT_SHORT
    assert found.outcome.usable
    assert {Stage.EVENTS, Stage.TERMS, Stage.MODELS} <= set(stages)


def test_every_estimate_by_a_search_says_that_it_was_cut_short(touched, monkeypatch):
    """Assessing, a smoother and the fits of a balancing as well as identifying."""
    monkeypatch.setattr(solution, "AT_ONCE", 1.0)
    options = AssessOptions(budget=budget(0))
    *_, assessed, _ = assess(touched, BED, options)
    smoothed = smoothed_estimate(touched, BED, Params(budget=budget(0)))
    learnt = learn(None, touched, BED, budget(0)).estimate
    for found in (assessed.estimate, smoothed, learnt):
        assert {reason.code for reason in found.outcome.reasons} & CUT_SHORT


# --- times that are too distant ---


def later(channel, rows, seconds):
    t = channel.t.copy()
    t[rows] += seconds
    return Samples(t, channel.values)


def shifted(record, rows, seconds):
    return replace(
        record,
        masses=None,
        mass_names=(),
        attitude=later(record.attitude, rows, seconds),
        rate=later(record.rate, rows, seconds),
    )


def scaled(record, factor):
    channels = {
        name: Samples(channel.t * factor, channel.values)
        for name, channel in (("attitude", record.attitude), ("rate", record.rate))
    }
    return replace(record, masses=None, mass_names=(), **channels)


@pytest.fixture(scope="module")
def short():
    return noisy(recording(4.0, gyro=20.0), 7, np.zeros(3))


def peak_of(record, allowed):
    """Return the estimate, or the refusal, and by how much memory grew at most, bytes."""
    tracemalloc.start()
    try:
        found = estimated(record, BED, allowed)
    except InputError as refused:
        found = refused
    finally:
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    return found, peak


@pytest.mark.parametrize(
    "wrong",
    [
        lambda record: shifted(record, -1, 1e9),
        lambda record: shifted(record, slice(10, None), 1e9),
        lambda record: scaled(record, 1e6),
    ],
    ids=["a stamp of another clock", "another clock from the middle on", "microseconds"],
)
def test_rows_too_distant_are_refused_before_memory_is_taken(wrong, short):
    found, peak = peak_of(wrong(short), UNLIMITED)
    assert isinstance(found, InputError)
    assert "steps" in str(found)
    assert peak < MEMORY


def test_a_record_in_milliseconds_ends_within_its_budget_and_memory(short):
    found, peak = peak_of(scaled(short, 1e3), budget(8))
    assert not found.outcome.usable
    assert peak < MEMORY
