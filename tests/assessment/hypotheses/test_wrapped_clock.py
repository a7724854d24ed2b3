"""Readings are compared over all rows of a clock that wraps, and without rows that are wrong."""

import numpy as np
import pytest

from equipoise.assessment.hypotheses.number_table import NumberTable
from equipoise.assessment.hypotheses.ranking import ranked
from equipoise.model.arrays import Series1
from tests.support.recordings.recorded_motion import Motion, motion

NAMES = ("ms", "qw", "qx", "qy", "qz", "gx", "gy", "gz")


@pytest.fixture(scope="module")
def long_motion() -> Motion:
    return motion(3, 10.0, 5.0, duration=200.0)


def gyro_of(made: Motion, clock: Series1, q=None):
    """Return the gyro of the first reading."""
    q = made.q if q is None else q
    first = ranked(NumberTable(NAMES, np.column_stack([clock, q, made.w]))).alike[0]
    assert first.gyro is not None
    return first.gyro


def test_a_counter_that_wraps_three_times_is_one_clock(long_motion) -> None:
    """The same spans are compared as of the clock that does not wrap, to the last digit."""
    clock = np.round(1e3 * long_motion.t)
    whole, wrapped = gyro_of(long_motion, clock), gyro_of(long_motion, clock % 2.0**16)
    assert wrapped.spans == whole.spans
    assert wrapped.misfit == pytest.approx(whole.misfit, rel=1e-6)


def test_a_stamp_ahead_and_garbage_cost_their_rows_alone(long_motion) -> None:
    clock, q = np.round(1e3 * long_motion.t), long_motion.q.copy()
    clock[4000] = 9e9
    q[[1000, 2000, 3000]] = [[0.0, 0.0, 0.0, 0.0], [1.0, 1.0, 1.0, 1.0], [-7.0, 3.0, 2.0, 0.0]]
    whole, hurt = gyro_of(long_motion, 1e3 * long_motion.t), gyro_of(long_motion, clock, q)
    assert hurt.columns == whole.columns == NAMES[5:]
    assert hurt.unit == whole.unit == "rad/s"
    assert hurt.misfit < 2 * whole.misfit
    assert hurt.spans >= whole.spans - 8
