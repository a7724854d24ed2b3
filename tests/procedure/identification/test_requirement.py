"""Passed, failed, undecided: by bounds, with the floor where it decides."""

import numpy as np
import pytest

from equipoise.maths.gaussian_length import Bounded
from equipoise.model.verdict import Verdict, VerdictOutcome
from equipoise.procedure.identification.requirement import Requirement, judged

LIMIT = Requirement("torque", 1e-5, np.radians(20.0))
PASSED, FAILED = Bounded(5e-6, 4e-6, 1e-5, 1e-6), Bounded(2e-5, 1.01e-5, 3e-5, 1e-6)
OPEN = Bounded(9e-6, 8e-6, 1.1e-5, 1e-6)


@pytest.mark.parametrize("quantity", ["torque", "offset"])
@pytest.mark.parametrize(
    ("found", "outcome", "first"),
    [
        (PASSED, VerdictOutcome.PASSED, "Passed"),  # the upper bound is the limit
        (FAILED, VerdictOutcome.FAILED, "Failed"),
        (Bounded(2e-5, 1e-5, 3e-5, 1e-6), VerdictOutcome.UNDECIDED, "Cannot tell"),  # the lower
        (OPEN, VerdictOutcome.UNDECIDED, "Cannot tell"),
        (Bounded(9e-6, 0.0, 4e-5, 3e-5), VerdictOutcome.UNDECIDED, "Cannot tell"),
    ],
)
def test_bounds_decide(quantity, found, outcome, first):
    answer = judged(Requirement(quantity, 1e-5), found)
    assert answer.outcome is outcome
    assert answer.sentence.startswith(first)


def test_a_recording_too_poor_says_what_it_could_have_proven():
    text = judged(LIMIT, Bounded(9e-6, 0.0, 4e-5, 3e-5)).sentence
    assert "detection limit of this recording is 30 uN m: even a perfect platform would" in text


def test_a_value_near_the_limit_says_so():
    text = judged(LIMIT, Bounded(9e-6, 8e-6, 1.1e-5, 1e-6)).sentence
    assert "within 20 deg of level, rms, is 9 uN m (95 %: 8 uN m to 11 uN m)" in text
    assert "required: at most 10 uN m" in text
    assert "too near to the limit" in text


def test_numbers_of_the_bench_have_no_exponent():
    assert "1234 uN m" in judged(LIMIT, Bounded(1.234e-3, 1e-3, 2e-3, 0.0)).sentence


@pytest.mark.parametrize(
    ("found", "outcome"),
    [
        ([PASSED], VerdictOutcome.PASSED),
        ([PASSED, OPEN], VerdictOutcome.UNDECIDED),
        ([PASSED, FAILED, OPEN], VerdictOutcome.FAILED),
    ],
)
def test_one_that_fails_fails_them_all(found, outcome):
    reasons = [reason for each in found for reason in judged(LIMIT, each).reasons]
    assert Verdict(tuple(reasons)).outcome is outcome
