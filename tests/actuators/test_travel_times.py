"""What the rows of a track leave open of when a mass travelled."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.mass_errors import mass_errors, unit_of
from equipoise.actuators.travel_times import MOST, bend, merged_travels, timed, unresolved_steps
from equipoise.model.recording import Samples
from tests.oracle.mujoco_bench import smooth
from tests.support.builders import sliding_masses

SPEED = 0.01  # m/s
X, Y, _ = (replace(mass, lag_sd=0.0, sag_sd=0.0) for mass in sliding_masses())
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


def test_times_are_unknowns_by_hand():
    """4 mm, then 6 mm: a quarter through the travel three quarters of being late is departure's."""
    track = Samples(np.arange(6.0), np.array([[0, 0, 4, 10, 10, 10]]).T * 1e-3)
    found = mass_errors(track, (X,))
    assert found.names == ("departure_x_1", "arrival_x_1", "smoothness_x_1")
    assert [unit_of(name) for name in found.names] == ["s", "s", "1"]
    assert found.sd == pytest.approx([0.6 * EVEN, 0.4 * EVEN, 1.0])
    late = found.response
    at = [np.interp(1.5, late.t, late.values[:, k]) for k in (0, 1)]
    assert at == pytest.approx([-4e-3 * 0.75, -4e-3 * 0.25])
    total = np.trapezoid(late.values[:, :2], late.t, axis=0)
    # 10 mm late by 1 s; but for bends of a product of straight lines, straight between knots
    assert total.sum() == pytest.approx(-0.010, rel=1e-3)
    assert not np.interp([0.0, 0.2, 4.9], late.t, late.values[:, 0]).any()


def test_a_jump_of_a_record_is_one_unknown():
    """Late as a whole: whatever its duration, its mean time is all that acts."""
    track = Samples(np.arange(4.0), np.array([[0, 0, 8, 8]]).T * 1e-3)
    assert mass_errors(track, (X,)).names == ("departure_x_1",)
    assert mass_errors(track, (X,), least=1.0).names == ()


def bent(d_mm, at):
    """Return by how much the smooth path is ahead of the straight one, mm; rows every 1 s."""
    t = np.arange(float(len(d_mm)))
    track = Samples(t, np.array([d_mm]).T * 1e-3)
    return 1e3 * bend(np.array(at), track, 0, one(t, d_mm))


def test_a_smooth_path_by_hand():
    """4 mm, then 6 mm, 5 mm/s between them: u (1 - u) [(first - v) (1 - u) - (last - v) u]."""
    assert bent([0, 0, 4, 10, 10, 10], [1.0, 1.5, 2.0, 2.5, 3.0, 3.5]) == pytest.approx(
        [0, -0.625, 0, 0.625, 0, 0]
    )


@pytest.mark.parametrize("d_mm", [[0, 0, 4, 14, 24, 30, 30], [0, 0, 8, 8, 8, 8, 8]])
def test_what_goes_at_its_greatest_speed_or_in_one_step_goes_straight(d_mm):
    track = Samples(np.arange(7.0), np.array([d_mm]).T * 1e-3)
    assert not np.any(bent(d_mm, np.linspace(0, 6, 61)))
    assert not any(name.startswith("smoothness") for name in mass_errors(track, (X,)).names)


def test_a_smooth_ramp_is_what_the_bend_adds_to_its_rows():
    """30 mm in 5 s, 10 s^3 - 15 s^4 + 6 s^5: a sixth of a straight path's error is left."""
    t, fine = np.arange(0.0, 9.0, 0.5), np.linspace(0.0, 8.5, 500)
    ramp = [30.0 * smooth(np.clip((at - 1.8) / 5.0, 0, 1)) for at in (t, fine)]
    track = Samples(t, ramp[0][:, None] * 1e-3)
    (travel,) = timed(t, track.values[:, 0], 0.02)
    off = ramp[1] - np.interp(fine, t, ramp[0])
    left = off - 1e3 * bend(fine, track, 0, travel)
    assert np.abs(left).max() < 0.2 * np.abs(off).max()
    assert 6 * np.sqrt(np.mean(left**2)) < np.sqrt(np.mean(off**2))


def test_masses_have_times_of_their_own():
    """Two masses that travel together depart each on its own."""
    track = Samples(np.arange(4.0), np.array([[0, 0, 8, 8], [0, 0, 5, 5]]).T * 1e-3)
    assert mass_errors(track, (X, Y)).owner.tolist() == [[0, 0], [1, 1]]
