"""What the rows of a track leave open of when a mass travelled."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.travel_times import MOST, merged_travels, timed, unresolved_steps
from equipoise.model.recording import Samples
from tests.support.builders import sliding_masses

SPEED = 0.01  # m/s
X, _, _ = (replace(mass, lag_sd=0.0, sag_sd=0.0) for mass in sliding_masses())
EVEN = 1 / np.sqrt(12)


def one(t, d_mm):
    """Return the only travel of a mass."""
    (found,) = timed(np.array(t), np.array(d_mm) * 1e-3, SPEED)
    return found


def test_rows_at_the_corners_leave_nothing_open():
    """10 mm at 10 mm/s from 10 to 11 s."""
    found = one([0.0, 10, 11, 20], [0, 0, 10, 10])
    assert (found.departure_sd, found.arrival_sd) == (0, 0)
    track = Samples(np.array([0.0, 10, 11, 20]), np.array([[0, 0, 0.01, 0.01]]).T)
    assert not unresolved_steps(track, (X,)).any()


def test_a_travel_caught_by_even_rows_departs_and_arrives_within_its_slack_by_hand():
    """Rows every 1 s; it moves 4 mm, 10 mm, 7 mm: 0.6 s open at the start, 0.3 s at the end."""
    found = one([0.0, 1, 2, 3, 4, 5], [0, 0, 4, 14, 21, 21])
    assert (found.first, found.last) == (1, 4)
    assert found.departure_sd == pytest.approx(0.6 * EVEN)
    assert found.arrival_sd == pytest.approx(0.3 * EVEN)


def test_a_jump_may_take_all_of_a_step_and_arrives_as_late_as_its_path_takes():
    """50 mm between rows 1 s apart, at 10 mm/s: 4 s more than the step."""
    found = one([0.0, 1, 2, 3], [0, 0, 50, 50])
    assert found.departure_sd == pytest.approx(EVEN)
    assert found.arrival_sd == pytest.approx(np.hypot(EVEN, 4.0))


def test_a_travel_at_the_greatest_speed_is_late_by_no_rounding():
    """3 s at 1 mm/s from many places: differences of decimals are off by some 1e-15 s."""
    t = np.array([0.0, 1, 2, 3, 4, 5])
    for start in range(200):
        d = np.array([start, start, start + 1, start + 2, start + 3, start + 3]) * 1e-3
        (found,) = timed(t, d, 1e-3)
        assert (found.departure_sd, found.arrival_sd, found.is_late) == (0, 0, False)


def test_small_steps_with_short_pauses_are_one_travel():
    """A stepper: 1 mm within 0.1 s, then 0.4 s of rest, ten times; then a travel 20 s later."""
    corners = np.concatenate([[0.5 * k, 0.5 * k + 0.1] for k in range(10)])
    t = np.concatenate([corners, [25.0, 26.0, 27.0]])
    d = np.concatenate([np.repeat(np.arange(11.0), 2)[1:-1], [10, 10, 20, 20]]) * 1e-3
    t, d = t[: len(d)], d[: len(t)]
    assert merged_travels(t, d, SPEED)[0] == (0, 19)
    assert len(merged_travels(t, d, SPEED)) == 2


def test_a_record_of_very_many_travels_has_few_unknowns():
    """Two hundred moves of 10 s each way, caught by rows every 2 s."""
    t = np.arange(0.0, 4000.0, 2.0)
    d = np.interp(t, 10.0 * np.arange(401), 0.01 * (np.arange(401) // 2 % 2))
    assert 0 < len(timed(t, d, SPEED)) <= MOST
