"""How great a surprise must be, and what a model pays for an event."""

from dataclasses import replace
from math import erfc, exp, pi, sqrt

import numpy as np
import pytest

from equipoise.estimation.events import jump_test
from equipoise.estimation.events.jump_test import threshold
from equipoise.estimation.events.record_model import (
    Happening,
    RecordModel,
    evidence,
    refitted,
    smoothed,
)
from equipoise.estimation.output_error.solution import settle
from equipoise.estimation.output_error.trajectory import Params, problem_of
from tests.support.builders import noisy
from tests.support.event_records import EVENT, KINDS, TRUTH, reported, with_event

PRICE = 20.0


@pytest.mark.parametrize("spacing", [0.1, 0.4, 2.0])
def test_both_kinds_at_all_cuts_exceed_the_threshold_once_an_hour(spacing):
    """P(chi-square of 3 > x) = erfc(sqrt(x/2)) + sqrt(2x/pi) exp(-x/2), in closed form."""
    x = threshold(spacing)
    chance = erfc(sqrt(x / 2)) + sqrt(2 * x / pi) * exp(-x / 2)
    assert 2 * 3600.0 / spacing * chance == pytest.approx(1.0, rel=1e-9)


def estimated(record, *events):
    """The model with these events."""
    testbed, params = reported(), Params(use_prior=True)
    first = settle(problem_of(record, testbed, params), TRUTH)
    cuts = np.arange(1.0, 39.0, 0.5)
    return refitted(RecordModel(record, testbed, params, cuts, np.zeros(3), events, first, testbed))


@pytest.mark.parametrize("kind", KINDS)
def test_an_event_gains_what_the_cost_falls_by_less_its_price(kind):
    """All else is as informed as if it were known, however well or badly its size is."""
    record = noisy(with_event(kind, 3.0), 2)
    plain, reported_of = estimated(record), estimated(record, Happening(EVENT, kind))
    fell = 2 * (plain.fitted.at.cost - reported_of.fitted.at.cost)
    gained = evidence(*smoothed(plain), PRICE) - evidence(*smoothed(reported_of), PRICE)
    assert fell > 20
    assert gained == pytest.approx(fell - PRICE, abs=0.3)


def test_a_wider_prior_of_an_event_changes_nothing(monkeypatch):
    """What the flat prior is said to be is not part of the comparison."""
    record = noisy(with_event("impulse", 3.0), 2)
    values, impulse = [], jump_test.KINDS["impulse"]
    for width in (1.0, 10.0):
        monkeypatch.setitem(jump_test.KINDS, "impulse", impulse._replace(sd=width))
        values.append(evidence(*smoothed(estimated(record, Happening(EVENT, "impulse"))), PRICE))
    assert values[0] == pytest.approx(values[1], abs=1e-3)


def test_process_noise_is_paid_for_by_its_prior():
    """-2 ln evidence with jumps of known sd, by hand: the record's information on them added."""
    record = noisy(with_event("impulse", 0.0), 2)
    calm = estimated(record)
    wandering = refitted(replace(calm, walk=np.full(3, 1e-9)))
    # noise that small neither explains nor costs anything
    assert evidence(*smoothed(wandering), PRICE) == pytest.approx(
        evidence(*smoothed(calm), PRICE), abs=0.01
    )
