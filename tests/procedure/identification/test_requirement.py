"""Passed, failed, cannot tell: by bounds, with the floor where it decides."""

import pytest

from equipoise.maths.gaussian_length import Bounded
from equipoise.procedure.identification.requirement import (
    FAILED,
    OPEN,
    PASSED,
    Requirement,
    judged,
    verdict_answer,
)

REQUESTED = Requirement("the torque", 1e-5, "uN m", 1e6)


@pytest.mark.parametrize(
    ("found", "answer"),
    [
        (Bounded(5e-6, 4e-6, 1e-5, 1e-6), PASSED),  # the upper bound is the limit
        (Bounded(2e-5, 1.01e-5, 3e-5, 1e-6), FAILED),
        (Bounded(2e-5, 1e-5, 3e-5, 1e-6), OPEN),  # the lower bound is the limit
        (Bounded(9e-6, 8e-6, 1.1e-5, 1e-6), OPEN),
        (Bounded(9e-6, 0.0, 4e-5, 3e-5), OPEN),
    ],
)
def test_bounds_decide(found, answer):
    assert judged(REQUESTED, found).answer == answer
    assert judged(REQUESTED, found).sentence.startswith(answer)


def test_a_recording_too_poor_says_what_it_could_have_proven():
    text = judged(REQUESTED, Bounded(9e-6, 0.0, 4e-5, 3e-5)).sentence
    assert "The floor of this recording is 30 uN m: even a perfect platform would not pass" in text


def test_a_value_near_the_limit_says_so():
    text = judged(REQUESTED, Bounded(9e-6, 8e-6, 1.1e-5, 1e-6)).sentence
    assert "the torque is 9 uN m (95 %: 8 uN m to 11 uN m); at most 10 uN m is wanted" in text
    assert "too near to the limit" in text


def test_numbers_of_the_bench_have_no_exponent():
    assert "1234 uN m" in judged(REQUESTED, Bounded(1.234e-3, 1e-3, 2e-3, 0.0)).sentence


@pytest.mark.parametrize(
    ("answers", "word"),
    [
        ([PASSED], PASSED),
        ([PASSED, OPEN], OPEN),
        ([PASSED, FAILED, OPEN], FAILED),
    ],
)
def test_one_that_fails_fails_them_all(answers, word):
    assert verdict_answer(answers) == word
