"""When a mass travelled between rows, as unknowns of its travel."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.mass_errors import mass_errors, unit_of
from equipoise.actuators.travel_errors import bend
from equipoise.model.recording import Samples
from tests.support.builders import sliding_masses

X, Y, _ = (replace(mass, lag_sd=0.0, sag_sd=0.0) for mass in sliding_masses())  # 10 mm/s
EVEN, SPREAD = 1 / np.sqrt(12), 1 / (2 * np.sqrt(180))
FINE = np.linspace(0.0, 1.0, 40_001)  # s


def track_of(*columns_mm):
    """Return rows 1 s apart."""
    return Samples(np.arange(float(len(columns_mm[0]))), np.array(columns_mm).T * 1e-3)


def by_name(found, name, t):
    """Return the displacement by an unknown, m/s."""
    column = found.response.values[:, found.names.index(name)]
    return np.interp(t, found.response.t, column)


def test_ends_of_a_measured_travel_are_unknowns_by_hand():
    """4 mm, then 6 mm at 10 mm/s: 0.6 s of the first step are open, 0.4 s of the second."""
    found = mass_errors(track_of([0, 0, 4, 10, 10, 10]), (X,))
    ends = "departure_x_1", "arrival_x_1"
    names = ends[0], f"spread_{ends[0]}", ends[1], f"spread_{ends[1]}", "smoothness_x_1"
    assert found.names == names
    assert [unit_of(name) for name in found.names] == ["s"] * 4 + ["1"]
    assert found.sd == pytest.approx([0.6 * EVEN, 0.36 * SPREAD, 0.4 * EVEN, 0.16 * SPREAD, 1.0])
    for start, way, end in ((1.0, 4e-3, ends[0]), (2.0, 6e-3, ends[1])):
        late = by_name(found, end, start + FINE)
        assert late.min() == pytest.approx(-2 * way)
        assert np.trapezoid(late, FINE) == pytest.approx(-way, rel=1e-6)
        assert not by_name(found, end, np.array([start - 0.1, start + 1.1])).any()


@pytest.mark.parametrize("tau", [-0.45, -0.2, 0.0, 0.3])
def test_a_jump_anywhere_in_a_step_keeps_its_moments_in_time(tau):
    """8 mm at once: time integral and first moment in time as of the true path, by quadrature.

    Measured, for it creeps by a nanometre; faster than stated, so that all of the step is open.
    """
    found = mass_errors(track_of([0, 1e-6, 8, 8 + 1e-6]), (replace(X, speed=1e-3),))
    late, spread = (by_name(found, n, 1 + FINE) for n in ("departure_x_1", "spread_departure_x_1"))
    x = (tau**2 - 1 / 12) / 2
    drawn = 8e-3 * FINE + tau * late + x * spread
    true = np.where(tau < FINE - 0.5, 8e-3, 0.0)
    for weight in (1.0, FINE):
        moments = [np.trapezoid(weight * d, FINE) for d in (drawn, true)]
        assert moments[0] == pytest.approx(moments[1], abs=1e-6)


def test_longer_travels_are_late_by_degrees_by_hand():
    """4, 5 and 6 mm: a sixth through the travel five sixths of being late are departure's."""
    found = mass_errors(track_of([0, 0, 4, 9, 15, 15, 15]), (X,))
    assert found.names[:2] == ("departure_x_1", "arrival_x_1")
    at = [by_name(found, name, np.array([1.5]))[0] for name in found.names[:2]]
    assert at == pytest.approx([-4e-3 * 5 / 6, -4e-3 / 6])
    late = found.response
    total = np.trapezoid(late.values[:, :2], late.t, axis=0)
    # 15 mm late by 1 s; but for bends of a product of straight lines, straight between knots
    assert total.sum() == pytest.approx(-0.015, rel=2e-3)


def test_a_long_travel_whose_rows_are_its_corners_leaves_no_time_open():
    """Three steps at its speed of 10 mm/s."""
    assert mass_errors(track_of([0, 0, 10, 20, 30, 30]), (X,)).names == ()


def test_a_jump_is_late_as_a_whole():
    """Whatever its duration, its mean time and how it is spread are all that act."""
    track = track_of([0, 0, 8, 8])
    assert mass_errors(track, (X,)).names == ("departure_x_1", "spread_departure_x_1")
    assert mass_errors(track, (X,), least=1.0).names == ()


def test_masses_have_times_of_their_own():
    """Two masses that travel together depart each on its own."""
    found = mass_errors(track_of([0, 0, 8, 8], [0, 0, 5, 5]), (X, Y))
    assert found.owner.tolist() == [[0, 0], [0, 1], [1, 2], [1, 3]]


# --- how smooth a path is -------------------------------------------------------------------------


def bent(d_mm, at):
    """Return by how much the smooth path is ahead of the straight one, mm; rows every 1 s."""
    t = np.arange(float(len(d_mm)))
    return 1e3 * bend(np.array(at), t, np.array(d_mm) * 1e-3, 0.010)


def test_a_smooth_path_by_hand():
    """4 mm, then 6 mm, 5 mm/s between them: u (1 - u) [(first - v) (1 - u) - (last - v) u]."""
    assert bent([0, 0, 4, 10, 10, 10], [1.0, 1.5, 2.0, 2.5, 3.0, 3.5]) == pytest.approx(
        [0, -0.625, 0, 0.625, 0, 0]
    )


@pytest.mark.parametrize("d_mm", [[0, 0, 4, 14, 24, 30, 30], [0, 0, 8, 8, 8, 8, 8]])
def test_what_goes_at_its_greatest_speed_or_in_one_step_goes_straight(d_mm):
    assert not np.any(bent(d_mm, np.linspace(0, 6, 61)))
    assert not any(n.startswith("smoothness") for n in mass_errors(track_of(d_mm), (X,)).names)


def test_a_smooth_ramp_is_what_the_bend_adds_to_its_rows():
    """30 mm in 5 s, 10 s^3 - 15 s^4 + 6 s^5: a fifth of a straight path's error is left."""
    t, fine = np.arange(0.0, 9.0, 0.5), np.linspace(0.0, 8.5, 500)
    ramp = [30.0 * smooth(np.clip((at - 1.8) / 5.0, 0, 1)) for at in (t, fine)]
    off = ramp[1] - np.interp(fine, t, ramp[0])
    left = off - 1e3 * bend(fine, t, ramp[0] * 1e-3, 0.02)
    assert np.abs(left).max() < 0.2 * np.abs(off).max()
    assert 6 * np.sqrt(np.mean(left**2)) < np.sqrt(np.mean(off**2))


def smooth(s):
    """Return a share of a way that is gone smoothly."""
    return 10 * s**3 - 15 * s**4 + 6 * s**5
