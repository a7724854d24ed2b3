"""Random scramblings of known motions: what is decided is right, what is open shows the right one.

Drawn are the order and direction of the quaternion; order, signs (left-handed ones too) and unit of
the gyro; unit, start and wrap of the clock; names with meaning or none; further columns; the order
of all of them. A third of the motions hardly turn about the vertical.
"""

from collections import Counter

import numpy as np
import pytest

from equipoise.assessment.hypotheses.ranking import ranked
from tests.assessment.hypotheses.scrambled_records import Scrambled, is_right, scrambled
from tests.support import thorough
from tests.support.recordings.recorded_motion import Motion, motion, swinging, turning

DRAWS = thorough.count(200, 40)
SEED = 1000
WITH_GYRO, CAMERA = 0.98, 0.95  # shares that must be right


@pytest.fixture(scope="module")
def motions() -> tuple[Motion, ...]:
    return turning(), motion(5, 8.0, 3.0), swinging()


def result_of(made: Scrambled) -> str:
    """Return what the readings of a table are worth."""
    found = ranked(made.table)
    right = [is_right(reading, made) for reading in found.alike]
    if found.decided:
        return "decided right" if right[0] else "decided wrong"
    return "open" if any(right) else "lost"


def results(motions: tuple[Motion, ...], gyro: bool) -> tuple[Counter[str], list[str]]:
    """Return how often each result came, and how the wrong ones were made."""
    made = [
        scrambled(np.random.default_rng(SEED + k), motions[k % len(motions)], gyro)
        for k in range(DRAWS)
    ]
    found = [result_of(each) for each in made]
    wrong = [
        each.how for each, r in zip(made, found, strict=True) if r in ("decided wrong", "lost")
    ]
    return Counter(found), wrong


def test_with_a_gyro_the_reading_is_decided_and_right(motions) -> None:
    counts, wrong = results(motions, gyro=True)
    assert counts["decided right"] >= WITH_GYRO * DRAWS, (counts, wrong)
    assert counts["lost"] + counts["decided wrong"] <= (1 - WITH_GYRO) * DRAWS, (counts, wrong)


def test_a_camera_alone_is_right_or_left_open(motions) -> None:
    counts, wrong = results(motions, gyro=False)
    assert counts["decided right"] + counts["open"] >= CAMERA * DRAWS, (counts, wrong)
