"""When an event happened, and what it adds to intervals that this is not known."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2

from equipoise.estimation.events.event_search import doubted, merged, pruned
from equipoise.estimation.events.event_time_covariance import with_moments
from equipoise.estimation.events.event_times import later, moment_errors, timed
from equipoise.estimation.events.record_model import Happening, RecordModel, refitted
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.solution import settle
from equipoise.estimation.output_error.trajectory import METHOD, Params, problem_of
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.recording import window
from tests.support.builders import noisy
from tests.support.event_records import EVENT, KINDS, TRUTH, reported, with_event

every_kind = pytest.mark.parametrize("kind", KINDS)
CUTS = np.arange(1.0, 39.0, 0.5)  # s


def by_camera(record):
    """The record without its gyro, whose rows an event passes one by one."""
    return replace(record, rate=None)


def estimated(record, *events, testbed=None):
    """The model with these events, from the truth on."""
    testbed, params = testbed or reported(), Params(use_prior=True)
    if record.rate is None:
        testbed = replace(testbed, gyro=None)
    first = settle(problem_of(record, testbed, params), TRUTH)
    happened = tuple(Happening(t, kind) for t, kind in events)
    return refitted(
        RecordModel(record, testbed, params, CUTS, np.zeros(3), happened, first, testbed)
    )


@every_kind
@pytest.mark.parametrize("off", [-0.15, 0.1])
def test_an_event_at_a_wrong_moment_says_by_how_much(kind, off):
    """By camera, without noise, a hundred times the size: one linear step finds nine tenths."""
    model = estimated(by_camera(with_event(kind, 100.0)), (EVENT + off, kind))
    late, _ = moment_errors(model)
    assert late[0] == pytest.approx(-off, rel=0.1)


@every_kind
@pytest.mark.parametrize("off", [-2.0, 1.5])
def test_newton_steps_find_the_moment(kind, off):
    """Seconds off, without noise."""
    found = timed(estimated(with_event(kind, 30.0), (EVENT + off, kind)))
    assert found.events[0].t == pytest.approx(EVENT, abs=0.02)
    assert found.fitted.at.cost < 0.5


@every_kind
def test_sd_of_a_moment_is_the_curvature_of_the_cost(kind):
    """All else refitted at three moments: second difference of the cost = sd^-2.

    To a tenth: the rows near the event, which it passes one by one, make the cost bend unevenly.
    """
    model = timed(estimated(by_camera(noisy(with_event(kind, 100.0), 3)), (EVENT, kind)))
    _, sd = moment_errors(model)
    costs = [later(model, share * sd).fitted.at.cost for share in (-2.0, 0.0, 2.0)]
    curvature = (costs[0] - 2 * costs[1] + costs[2]) / (2 * sd[0]) ** 2
    assert sd[0] == pytest.approx(curvature**-0.5, rel=0.1)


@every_kind
def test_moments_are_off_by_their_sd(kind):
    """Twelve seeds: the sum of squares is chi-square."""
    total = 0.0
    for seed in range(12):
        testbed = reported(np.random.default_rng(500 + seed))
        record = by_camera(noisy(with_event(kind, 100.0), seed))
        model = timed(estimated(record, (EVENT + 0.3, kind), testbed=testbed))
        total += ((model.events[0].t - EVENT) / moment_errors(model)[1][0]) ** 2
    assert chi2.ppf(1e-3, 12) < total < chi2.isf(1e-3, 12)


def test_two_events_are_timed_together():
    """An impulse and a step before it that is not there: both move at once, one cost falls."""
    record = noisy(with_event("impulse", 30.0), 5)
    model = estimated(record, (EVENT - 1.0, "impulse"), (EVENT + 4.0, "com_step"))
    found = timed(model)
    assert found.fitted.at.cost < model.fitted.at.cost
    assert abs(found.events[0].t - EVENT) < 0.5


def test_what_is_not_known_of_a_moment_widens_intervals():
    """By the outer product of what the estimate moves by within one sd of the moment."""
    record = by_camera(noisy(with_event("impulse", 100.0), 4))
    model = timed(estimated(record, (EVENT, "impulse")))
    before = conclude(model.fitted, METHOD, record)
    after = with_moments(before, model)
    moved = later(model, moment_errors(model)[1])
    there = conclude(moved.fitted, METHOD, record)
    names = COM + INERTIA
    rise = max(1.0, 2 * (moved.fitted.at.cost - model.fitted.at.cost))
    column = (there.values(names) - before.values(names)) / rise**0.5
    added = after.covariance_of(names) - before.covariance_of(names)
    np.testing.assert_allclose(added, np.outer(column, column), rtol=1e-6, atol=0)
    for name in names:
        k = after.index(name)
        assert after.parameters[k].sd == pytest.approx(after.covariance[k, k] ** 0.5)
        assert after.parameters[k].sd > before.parameters[k].sd


def test_nothing_is_widened_where_nothing_happened():
    record = noisy(with_event("impulse", 0.0), 4)
    model = estimated(record)
    concluded = conclude(model.fitted, METHOD, record)
    assert with_moments(concluded, model) is concluded


@every_kind
def test_two_neighbours_become_the_one_that_they_were(kind):
    """An event either side of the true one: one is left, where it was."""
    record = noisy(with_event(kind, 30.0), 6)
    model = estimated(record, (EVENT - 0.8, kind), (EVENT + 0.8, kind))
    found = merged(model)
    assert len(found.events) == 1
    assert found.events[0].t == pytest.approx(EVENT, abs=0.2)
    assert found.events[0].kind == kind


def test_an_event_that_explains_nothing_is_taken_back():
    record = noisy(with_event("impulse", 30.0), 7)
    model = estimated(record, (EVENT, "impulse"), (12.0, "impulse"))
    assert [event.t for event in pruned(model).events] == pytest.approx([EVENT], abs=0.2)


@every_kind
def test_a_plain_event_is_of_one_kind(kind):
    """Thirty times the size, with noise."""
    plain = timed(estimated(noisy(with_event(kind, 30.0), 8), (EVENT, kind)))
    assert [event.unclear for event in doubted(plain).events] == [False]


@pytest.mark.parametrize(("kind", "share"), [("impulse", 1.0), ("com_step", 2.0)])
def test_the_kind_of_an_event_stays_ambiguous_until_enough_swing_follows(kind, share):
    """The same one, without noise: half a second behind it does not show, eighteen do.

    Then nothing but its own kind may jump in the fit; before, the other as well.
    """
    record = with_event(kind, share)
    records = (window(record, 0.0, EVENT + 0.5), record)
    early, whole = (doubted(timed(estimated(observed, (EVENT, kind)))) for observed in records)
    own, both = KINDS[kind][0], sorted(name for names, *_ in KINDS.values() for name in names)
    assert [event.unclear for event in (*early.events, *whole.events)] == [True, False]
    assert [event.kind for event in (*early.events, *whole.events)] == [kind, kind]
    assert [sorted(jump.names) for jump in early.fitted.problem.jumps] == [both]
    assert [jump.names for jump in whole.fitted.problem.jumps] == [own]
