"""Periods of swing: made-up ones with their sd, a pendulum's elliptic one, what is no swing."""

import numpy as np
import pytest
from scipy.special import ellipk

from equipoise.assessment.metrics.period import swings
from equipoise.assessment.metrics.spectrum import is_even, spectrum
from equipoise.assessment.metrics.spin_lines import spin_lines

RNG = np.random.default_rng
T = np.arange(0.0, 120.0, 0.2)


def two_swings(t, noise, seed, decay=0.002):
    """Swings of 3 and 2 deg at 0.05 and 0.07 Hz along x and y, with noise."""
    fade = np.exp(-decay * t)
    x = np.radians(3.0) * fade * np.cos(2 * np.pi * 0.05 * t + 0.3)
    y = np.radians(2.0) * fade * np.sin(2 * np.pi * 0.07 * t) + 0.01
    return np.column_stack([x, y]) + noise * RNG(seed).normal(size=(len(t), 2))


def test_two_swings_are_found_with_amplitude_decay_and_shape():
    slow, quick = swings(T, two_swings(T, 1e-5, 1))
    assert slow.frequency == pytest.approx(0.05 * (1 + slow.amplitude**2 / 16), rel=2e-3)
    assert slow.decay == pytest.approx(0.002, rel=0.01)
    assert quick.decay == pytest.approx(0.002, rel=0.01)
    assert np.abs(slow.shape) == pytest.approx([1, 0], abs=1e-3)
    assert np.abs(quick.shape) == pytest.approx([0, 1], abs=1e-3)
    rms = np.sqrt(np.mean(np.exp(-0.004 * T)))
    assert slow.amplitude == pytest.approx(np.radians(3.0) * rms, rel=1e-3)


def test_frequencies_err_as_much_as_they_say():
    """Forty records of small swings: the correction for amplitude is then nothing."""
    off = []
    for seed in range(40):
        found = swings(T, 0.05 * two_swings(T, 2e-2, seed))
        off += [(s.frequency - f) / s.sd for s, f in zip(found, (0.05, 0.07), strict=True)]
    assert 0.8 < np.std(off) < 1.2
    assert abs(np.mean(off)) < 3 / np.sqrt(len(off))


def test_a_large_swing_is_slower_as_the_elliptic_integral_has_it():
    """T / T0 = 2 K(sin^2(a/2)) / pi; 30 deg: 1.0174. Corrected to within the stated sd."""
    amplitude = np.radians(30.0)
    t, dt = np.arange(0.0, 200.0, 0.01), 0.01
    angle = np.empty((len(t), 2))
    angle[0] = amplitude, 0.0
    for k in range(len(t) - 1):  # leapfrog, omega 0.5 rad/s
        middle = angle[k, 1] - 0.5 * dt * 0.25 * np.sin(angle[k, 0])
        next_angle = angle[k, 0] + dt * middle
        angle[k + 1] = next_angle, middle - 0.5 * dt * 0.25 * np.sin(next_angle)
    tilt = np.sin(angle[::20, 0])
    (swing,) = swings(t[::20], np.column_stack([tilt, 0 * tilt]))
    assert 2 * ellipk(np.sin(amplitude / 2) ** 2) / np.pi == pytest.approx(1.0174, abs=1e-4)
    assert abs(swing.frequency - 0.5 / (2 * np.pi)) < 0.3 * swing.sd


def test_noise_alone_is_no_swing():
    none = [swings(T, 1e-3 * RNG(seed).normal(size=(len(T), 2))) for seed in range(20)]
    assert none == [()] * 20


SPIN = np.radians(42.0)  # rad/s: a turn in 8.57 s


def camera_that_leans(t, lean, noise, seed):
    """A still platform that turns at SPIN, by a camera whose vertical leans (rad)."""
    turning = np.column_stack([np.cos(SPIN * t), -np.sin(SPIN * t)])
    harmonic = 0.3 * np.column_stack([np.sin(2 * SPIN * t), np.cos(3 * SPIN * t)])
    return lean * (turning + harmonic) + noise * RNG(seed).normal(size=(len(t), 2))


def test_what_turns_with_the_platform_is_no_swing():
    """Without the lines its spin is taken for a swing of 8.57 s, in each of twenty records."""
    t = np.arange(0.0, 60.0, 0.1)
    lines = spin_lines(t, SPIN * t)
    for seed in range(20):
        s = camera_that_leans(t, np.radians(0.2), np.radians(0.05), seed)
        assert 1 / swings(t, s)[0].frequency == pytest.approx(8.57, abs=0.02)
        assert swings(t, s, lines) == ()


def test_a_spin_that_slows_down_is_followed():
    """By 2 % in a minute: 50 deg between the heading and that of an even spin."""
    t = np.arange(0.0, 60.0, 0.1)
    psi = SPIN * (t - 0.02 * t**2 / 60.0)
    s = np.radians(0.2) * np.column_stack([np.cos(psi), -np.sin(psi)])
    s += np.radians(0.02) * RNG(1).normal(size=s.shape)
    assert swings(t, s, spin_lines(t, psi)) == ()


def test_a_swing_beside_the_lines_is_found_within_its_sd():
    """Swings of 0.2 deg at 21 and 6.2 s while the camera leans by as much: forty records."""
    t, off = np.arange(0.0, 60.0, 0.1), []
    lines = spin_lines(t, SPIN * t)
    for seed in range(20):
        s = camera_that_leans(t, np.radians(0.2), np.radians(0.05), seed)
        for k, period in enumerate((21.0, 6.2)):
            s[:, k] += np.radians(0.2) * np.cos(2 * np.pi * t / period + seed)
        slow, quick = swings(t, s, lines)
        off += [(slow.frequency - 1 / 21.0) / slow.sd, (quick.frequency - 1 / 6.2) / quick.sd]
    assert np.sqrt(np.mean(np.square(off))) < 1.2
    assert np.abs(off).max() < 4.0


def test_a_swing_that_a_record_cannot_separate_from_a_line_is_left_out():
    """A swing of 8.2 s and a turn of 8.57 s: 0.3 of what a minute resolves. The other stays."""
    t = np.arange(0.0, 60.0, 0.1)
    s = camera_that_leans(t, np.radians(0.2), np.radians(0.02), 3)
    s[:, 0] += np.radians(1.0) * np.cos(2 * np.pi * t / 8.2)
    s[:, 1] += np.radians(1.0) * np.cos(2 * np.pi * t / 21.0)
    (swing,) = swings(t, s, spin_lines(t, SPIN * t))
    assert 1 / swing.frequency == pytest.approx(21.0, rel=0.01)


def test_less_than_a_swing_is_none():
    t = np.arange(0.0, 10.0, 0.2)
    assert swings(t, two_swings(t, 1e-5, 1)) == ()


def test_gaps_are_bridged_by_least_squares():
    keep = (T < 40) | (T > 55)
    t, s = T[keep], two_swings(T, 1e-4, 2)[keep]
    assert not is_even(t)
    assert is_even(T)
    even, gappy = spectrum(T, two_swings(T, 1e-4, 2)), spectrum(t, s)
    for found in (even, gappy):
        peaks = found.frequency[np.argmax(found.amplitude, axis=0)]
        np.testing.assert_allclose(peaks, [0.05, 0.07], atol=0.5 / 120)
    np.testing.assert_allclose(gappy.amplitude.max(axis=0), even.amplitude.max(axis=0), rtol=0.15)
    assert even.resolution == pytest.approx(1 / 120, rel=0.01)
