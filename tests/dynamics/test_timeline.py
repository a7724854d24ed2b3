"""The grid: every row, every corner, no step too long, inputs straight within each."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from equipoise.dynamics.timeline import (
    MOST_STEPS,
    corners,
    distinct,
    fill,
    straight_lines,
    timeline,
)
from equipoise.model.errors import InputError
from equipoise.model.recording import Samples
from tests.support.builders import move_at

NONE = np.zeros(0)
gaps = st.lists(st.floats(1e-3, 5.0), min_size=1, max_size=20)


def channel(t, *columns) -> Samples:
    return Samples(np.array(t, dtype=float), np.array(columns, dtype=float).T)


def test_fill_by_hand():
    """0 to 1 in thirds, 1 to 1.2 as it is."""
    filled = fill(np.array([0.0, 1.0, 1.2]), 0.4)
    np.testing.assert_allclose(filled, [0, 1 / 3, 2 / 3, 1, 1.2], atol=1e-15)


def test_times_too_distant_are_refused():
    """By the number of steps alone: 4e6 are taken, one more is not."""
    assert len(fill(np.array([0.0, 1.0]), 1.0 / MOST_STEPS)) == MOST_STEPS + 1
    with pytest.raises(InputError):
        fill(np.array([0.0, 1.0]), 1.0 / (MOST_STEPS + 1))
    with pytest.raises(InputError, match=r"1e\+09 s from first to last, which takes 1e\+10 steps"):
        fill(np.array([0.0, 1.0, 1e9]), 0.1)


def test_a_step_of_just_the_longest_is_not_cut():
    """Rounding in 0.1 + 0.1 + ... must not double the work."""
    t = np.arange(601) / 5.0
    assert len(fill(t, 0.2)) == 601


@given(gaps, st.floats(0.01, 2.0))
def test_fill_keeps_all_and_cuts_equally(steps, longest):
    """Old times stay to the bit, no step is too long, and no fewer would do."""
    t = np.cumsum([0.0, *steps])
    filled = fill(t, longest)
    assert np.isin(t, filled).all()
    assert np.diff(filled).max() <= longest * (1 + 1e-8)
    needed = np.maximum(np.ceil(np.diff(t) / longest - 1e-9), 1)
    assert len(filled) == 1 + needed.sum()


def test_fill_of_one_time():
    """Nothing to cut."""
    assert fill(np.array([3.0]), 0.1).tolist() == [3.0]


def test_times_that_differ_by_rounding_are_one():
    """0.1 + 0.2 is not 0.3 to a computer; a microsecond is a step."""
    found = distinct(np.array([0.1 + 0.2, 0.0, 0.3, 0.3 + 1e-6, 0.0]))
    assert found.tolist() == [0.0, 0.3, 0.3 + 1e-6]


def test_a_cut_beside_a_corner_makes_no_step_of_nothing():
    """Travel ends at 10 s, the cut is a rounding later: one node for both."""
    cut = np.array([10.0 + 2e-15])
    line = timeline(np.array([0.0, 20.0]), NONE, move_at(5.0, 20.0), 3, 1.0, cut=cut)
    assert np.diff(line.t).min() > 0.1


def test_straight_lines_by_hand():
    """Half-way between rows half the change; the first and last value outside."""
    d = channel([10, 20], [0, 4], [1, -1])
    found = straight_lines(d, np.array([0.0, 10, 15, 17.5, 25]), 2)
    assert found.tolist() == [[0, 1], [0, 1], [2, 0], [3, -0.5], [4, -1]]


def test_absent_input_is_zero():
    """No channel, or one without rows."""
    assert straight_lines(None, np.arange(4.0), 3).tolist() == [[0.0] * 3] * 4
    empty = Samples(NONE, np.zeros((0, 3)))
    assert straight_lines(empty, np.arange(2.0), 3).tolist() == [[0.0] * 3] * 2


def test_corners_by_hand():
    """Where the slope changes, of any column; not where a line is merely sampled."""
    d = channel([0, 1, 2, 3, 4, 5], [0, 0, 1, 2, 2, 2], [0, 0, 0, 0, 0, 5])
    assert corners(d, 0.0, 5.0).tolist() == [1.0, 3.0, 4.0]


def test_ends_of_a_moving_channel_are_corners():
    """Constant outside its rows: a ramp from 2 to 4 s bends at both, inside a longer record."""
    assert corners(channel([2, 4], [0, 1]), 0.0, 10.0).tolist() == [2.0, 4.0]
    assert corners(channel([2, 4], [1, 1]), 0.0, 10.0).tolist() == []
    assert corners(channel([2, 4], [0, 1]), 3.0, 10.0).tolist() == [4.0]


@pytest.mark.parametrize("absent", [None, channel([1], [2])])
def test_constant_channel_has_no_corners(absent):
    """None, or a single row."""
    assert corners(absent, 0.0, 10.0).tolist() == []


def test_every_sensor_row_is_a_node():
    """Camera and gyro at unrelated times; each is found at its own node to the bit."""
    camera, gyro = np.arange(0.03, 10, 0.2), np.arange(0, 10, 0.047)
    line = timeline(camera, gyro, move_at(4.0, 10.0), 3, 0.05)
    assert line.t[line.attitude_node].tolist() == camera.tolist()
    assert line.t[line.rate_node].tolist() == gyro.tolist()
    assert np.diff(line.t).max() <= 0.05 * (1 + 1e-8)
    assert np.isin([4.0, 5.0, 9.0], line.t).all()


def test_simultaneous_sensor_rows_share_a_node():
    """Camera and gyro rows with the same stamp."""
    t = np.arange(5.0)
    line = timeline(t, t[1:3], None, 0, 10.0)
    assert line.t.tolist() == t.tolist()
    assert line.rate_node.tolist() == [1, 2]


def test_known_inputs_stand_in_their_columns():
    """Momentum, torque, warmth, masses, errors, in this order, at every node; kinks too."""
    errors = channel([0, 1, 2], [0, 1, 1])
    momentum = channel([0, 1], [1, 1], [2, 2], [3, 3])
    torque = channel([0, 2], [0, 4], [5, 5], [6, 6])
    owner = np.array([[2, 0]])
    line = timeline(
        np.array([0.0, 2.0]), NONE, channel([0, 2], [0, 1], [0, 0], [2, 0]), 3, 10.0,
        momentum, torque, errors, owner, temperature=channel([0, 2], [20, 24]),
    )  # fmt: skip
    assert line.t.tolist() == [0, 1, 2]  # 1 s: the corner of the error
    assert line.owners.tolist() == [[2, 0]]
    assert line.known[1].tolist() == [1, 2, 3, 2, 5, 6, 2, 0.5, 0, 1, 1]
