"""When a mass travelled between rows, as unknowns of its travel."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.mass_errors import mass_errors, unit_of
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
    assert found.names == (ends[0], f"spread_{ends[0]}", ends[1], f"spread_{ends[1]}")
    assert [unit_of(name) for name in found.names] == ["s"] * 4
    assert found.sd == pytest.approx([0.6 * EVEN, 0.36 * SPREAD, 0.4 * EVEN, 0.16 * SPREAD])
    for start, way, end in ((1.0, 4e-3, ends[0]), (2.0, 6e-3, ends[1])):
        late = by_name(found, end, start + FINE)
        assert late.min() == pytest.approx(-2 * way)
        assert np.trapezoid(late, FINE) == pytest.approx(-way)
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


def test_steps_of_a_stepper_are_late_by_degrees():
    """Three jumps of 2 mm in 0.1 s each: what departure has no share in is arrival's."""
    t = np.array([0.0, 1.0, 1.1, 1.2, 1.3, 2.0])
    d = np.array([[0.0, 0, 2, 4, 6, 6]]).T * 1e-3
    found = mass_errors(Samples(t, d), (X,))
    assert found.names == ("departure_x_1", "arrival_x_1")
    late = found.response
    total = np.trapezoid(late.values, late.t, axis=0)
    # 6 mm late by 1 s; but for bends of a product of straight lines, straight between knots
    assert total.sum() == pytest.approx(-0.006, rel=0.02)


def test_a_jump_is_late_as_a_whole():
    """Whatever its duration, its mean time and how it is spread are all that act."""
    track = track_of([0, 0, 8, 8])
    assert mass_errors(track, (X,)).names == ("departure_x_1", "spread_departure_x_1")
    assert mass_errors(track, (X,), least=1.0).names == ()


def test_masses_have_times_of_their_own():
    """Two masses that travel together depart each on its own."""
    found = mass_errors(track_of([0, 0, 8, 8], [0, 0, 5, 5]), (X, Y))
    assert found.owner.tolist() == [[0, 0], [0, 1], [1, 2], [1, 3]]
