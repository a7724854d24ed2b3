"""What an event is taken for that may be of either kind: open to both, but at the stop a push."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.events.event_search import doubted
from equipoise.estimation.events.record_model import Happening, RecordModel, refitted
from equipoise.estimation.output_error.solution import settle
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.maths.attitude import tilt
from equipoise.model.recording import Recording, window
from equipoise.model.testbed import Testbed
from tests.support.builders import noisy
from tests.support.event_records import EVENT, KINDS, TRUTH, reported, with_event

BEHIND = 0.6  # s: nothing swings within


def touched() -> Recording:
    """A push, and so few rows behind it that a part that shifts explains them as well."""
    return window(noisy(with_event("impulse", 0.7), 2), 0.0, EVENT + BEHIND)


def concluded(bed: Testbed, kind: str) -> Happening:
    """What the event is taken for in the end."""
    record, params, events = touched(), Params(use_prior=True), (Happening(EVENT, kind),)
    first = settle(problem_of(record, bed, params), TRUTH)
    cuts = np.arange(1.0, EVENT + 1.0, 0.5)
    model = RecordModel(record, bed, params, cuts, np.zeros(3), events, first, bed)
    (event,) = doubted(refitted(model)).events
    return event


def limited(bed: Testbed, share: float) -> Testbed:
    """The testbed with its stop at a share of the tilt at the event."""
    rows = touched().attitude
    assert rows is not None
    there = float(np.interp(EVENT, rows.t, tilt(rows.values, bed.up)))
    return replace(bed, tilt_limit=share * there)


@pytest.mark.parametrize("kind", KINDS)
def test_away_from_the_stop_it_may_be_either(kind):
    assert concluded(limited(reported(), 3.0), kind).unclear


@pytest.mark.parametrize("kind", KINDS)
def test_at_the_stop_it_is_a_push(kind):
    """Whichever of the two the search had taken it for."""
    event = concluded(limited(reported(), 1.0), kind)
    assert (event.kind, event.unclear) == ("impulse", False)
