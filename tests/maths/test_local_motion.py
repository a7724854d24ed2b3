"""Local polynomials on the rotation group: exact for what they hold, noise as a filter's."""

import numpy as np
import pytest

from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.maths.local_motion import (
    DEGREE,
    LONGEST,
    NEIGHBOURS,
    TURN,
    half_window,
    local_motion,
)

AXIS = np.array([0.6, 0.0, 0.8])
START = exponential(np.array([0.1, 0.2, 1.0]))


def times(uneven: bool) -> np.ndarray:
    t = np.arange(120) / 5.0
    return t + np.random.default_rng(3).uniform(-0.08, 0.08, len(t)) if uneven else t


def about_one_axis(angle: np.ndarray) -> np.ndarray:
    return multiply(START, exponential(angle[:, None] * AXIS))


@pytest.mark.parametrize("uneven", [False, True])
def test_constant_spin_is_exact(uneven):
    """A straight line in the rotation vector; the ridge of 1e-9 leaves less than 1e-7 of it."""
    t = times(uneven)
    truth = about_one_axis(0.2 * t)
    q, w = local_motion(t, truth, 2.0)
    np.testing.assert_allclose(w, np.tile(0.2 * AXIS, (len(t), 1)), atol=2e-8)
    np.testing.assert_allclose(difference(q, truth), 0.0, atol=2e-8)


@pytest.mark.parametrize("uneven", [False, True])
def test_constant_acceleration_is_exact(uneven):
    """0.01 rad/s^2 about one axis is a parabola, within the cubic: at both ends too."""
    t = times(uneven)
    truth = about_one_axis(0.1 * t + 0.005 * t**2)
    q, w = local_motion(t, truth, 2.0)
    np.testing.assert_allclose(w, (0.1 + 0.01 * t)[:, None] * AXIS, atol=5e-8)
    np.testing.assert_allclose(difference(q, truth), 0.0, atol=5e-8)


def test_sign_of_the_quaternions_does_not_matter():
    """q and -q are one attitude."""
    t = times(False)
    q = about_one_axis(0.2 * t)
    flipped = q * np.where(np.arange(len(t)) % 3 == 0, -1.0, 1.0)[:, None]
    np.testing.assert_allclose(
        local_motion(t, flipped, 2.0)[1], local_motion(t, q, 2.0)[1], atol=1e-12
    )


def test_noise_is_that_of_the_linear_filter():
    """At rest the slope and the mean are linear in the noise, with least-squares weights.

    20 000 rows of three axes, correlated over 21: 4 sd of the rms are 5 %.
    """
    rng, sd, half = np.random.default_rng(5), 1e-3, 2.0
    t = np.arange(20_000) / 5.0
    noise = exponential(sd * rng.normal(size=(len(t), 3)))
    q, w = local_motion(t, noise, half)  # 2 s at 5 Hz: ten rows on either side
    offsets = np.arange(-10, 11) / 5.0
    weights = np.linalg.pinv(np.vander(offsets, DEGREE + 1, increasing=True))
    inside = slice(10, -10)
    predicted = sd * np.linalg.norm(weights, axis=1)
    assert np.std(w[inside]) == pytest.approx(predicted[1], rel=0.05)
    assert np.std(difference(q, np.eye(4)[0])[inside]) == pytest.approx(predicted[0], rel=0.05)


def plain_fit(t, q, rows, k, half):
    """The same fit by least squares on a Vandermonde matrix, with the ridge as extra rows."""
    phi = difference(q[rows], np.tile(q[k], (len(rows), 1)))
    vander = np.vander((t[rows] - t[k]) / half, DEGREE + 1, increasing=True)
    ridge = np.sqrt(1e-9) * np.eye(DEGREE + 1)
    found, *_ = np.linalg.lstsq(np.vstack([vander, ridge]), np.vstack([phi, np.zeros((4, 3))]))
    return found[0], found[1] / half


WINDOWS = [(0, (0, 21)), (4, (0, 21)), (60, (50, 71)), (119, (99, 120))]


@pytest.mark.parametrize(("k", "rows"), WINDOWS)
def test_agrees_with_plain_least_squares(k, rows):
    """Tumbling, noise and uneven times, at the ends and within; windows slide in at the ends."""
    t = times(True)
    rng = np.random.default_rng(8)
    q = exponential(rng.normal(scale=1e-2, size=(len(t), 3)) + 0.3 * np.sin(t)[:, None] * AXIS)
    half = 9.99 * float(np.median(np.diff(t)))  # ten rows on either side
    smooth, w = local_motion(t, q, half)
    offset, slope = plain_fit(t, q, np.arange(*rows), k, half)
    np.testing.assert_allclose(w[k], slope, atol=1e-9)
    np.testing.assert_allclose(difference(smooth[k], q[k]), offset, atol=1e-9)


def test_dense_records_use_every_few_rows():
    """At 500 Hz, 2000 rows of a window are thinned to about the allowed number, with no bias."""
    t = np.arange(5000) / 500.0
    _, w = local_motion(t, about_one_axis(0.1 * t + 0.005 * t**2), 2.0)
    np.testing.assert_allclose(w, (0.1 + 0.01 * t)[:, None] * AXIS, atol=5e-8)
    assert 2000 // NEIGHBOURS > 1


@pytest.mark.parametrize("rows", [2, 3, 4])
def test_few_rows_lower_the_degree(rows):
    """Two rows hold a line, three a parabola: constant spin is still exact."""
    t = np.arange(rows) / 5.0
    _, w = local_motion(t, about_one_axis(0.2 * t), 2.0)
    np.testing.assert_allclose(w, np.tile(0.2 * AXIS, (rows, 1)), atol=1e-5)


@pytest.mark.parametrize(
    ("speed", "expected"),
    [
        (0.01, LONGEST),  # slow: the longest
        (0.5, TURN / 0.5),  # 0.6 rad at 0.5 rad/s: 1.2 s
        (6.0, 0.5),  # fast: two and a half rows of 0.2 s
    ],
)
def test_window_suits_the_motion(speed, expected):
    """As long as swings allow, shorter when fast, never fewer than five rows."""
    t = times(False)
    assert half_window(t, about_one_axis(speed * t)) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("speed", [0.05, 0.11, 0.9])
def test_it_is_the_least_squares_polynomial_of_the_rotation_vectors(speed):
    """By NumPy, of slow motions, of fast ones, and of one whose windows are of both kinds."""
    t, rng = times(uneven=True), np.random.default_rng(4)
    q = multiply(about_one_axis(speed * t), exponential(rng.normal(0.0, 1e-2, (len(t), 3))))
    half = 2.5
    reach = int(np.ceil(half / np.median(np.diff(t))))
    smooth, w = local_motion(t, q, half)
    for k in (0, 3, 50, 119):
        first = min(max(k - reach, 0), len(t) - 1 - 2 * reach)
        rows = np.arange(first, first + 2 * reach + 1)
        powers = np.vander(t[rows] - t[k], DEGREE + 1, increasing=True)
        still, slope = np.linalg.lstsq(powers, difference(q[rows], q[k]), rcond=None)[0][:2]
        np.testing.assert_allclose(w[k], slope, atol=1e-8)
        np.testing.assert_allclose(difference(smooth[k], q[k]), still, atol=1e-8)
