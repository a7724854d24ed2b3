"""Sampled functions as fewer straight pieces."""

import numpy as np

from equipoise.maths.sampled.straight_pieces import knots, nearest_values, straight_pieces

T = np.linspace(0.0, 10.0, 1001)


def test_straight_pieces_come_back_as_they_were():
    """Level, a ramp from 3 to 7 s, level: four rows say it all, whatever the other column does."""
    ramp = np.interp(T, [3.0, 7.0], [0.0, 0.05])
    t, v = straight_pieces(T, np.column_stack([ramp, 2 * T]), np.array([1e-6, 1e-6]))
    np.testing.assert_allclose(t, [0.0, 3.0, 7.0, 10.0])
    np.testing.assert_allclose(v, [[0, 0], [0, 6], [0.05, 14], [0.05, 20]], atol=1e-12)


def test_no_chord_is_off_by_more_than_the_tolerance():
    """A chord of length h is off a parabola t^2 by h^2 / 4: 0.01 for pieces of 0.2 s."""
    at = knots(T, T[:, None] ** 2, np.array([0.01]))
    off = np.abs(np.interp(T, T[at], T[at] ** 2) - T**2)
    assert off.max() <= 0.01
    assert 50 <= len(at) - 1 <= 100  # at most twice as many as needed: pieces are halved


def test_values_at_knots_are_those_of_the_least_squared_distance():
    """Against the hat functions in full, by NumPy's least squares."""
    v, at = np.column_stack([np.sin(T), np.cos(T)]), np.array([0, 130, 300, 700, 1000])
    hats = np.column_stack([np.interp(T, T[at], unit) for unit in np.eye(len(at))])
    expected = np.linalg.lstsq(hats, v, rcond=None)[0]
    np.testing.assert_allclose(nearest_values(T, v, at), expected, atol=1e-12)


def test_bends_are_not_always_missed_on_the_same_side():
    """Chords of a swing are inside it everywhere and make it smaller; these lines do not."""
    v = 1e-4 * np.sin(T)[:, None]
    t, found = straight_pieces(T, v, np.array([1e-6]))
    size = np.interp(T, t, found[:, 0]) @ v[:, 0] / (v[:, 0] @ v[:, 0])
    at = knots(T, v, np.array([1e-6]))
    of_chords = np.interp(T, T[at], v[at, 0]) @ v[:, 0] / (v[:, 0] @ v[:, 0])
    assert 1 - of_chords > 2e-3
    assert abs(size - 1) < 0.05 * (1 - of_chords)
