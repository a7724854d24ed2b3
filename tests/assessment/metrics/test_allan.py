"""Drift, walk and Allan deviation of series whose answers are known."""

import numpy as np
import pytest

from equipoise.assessment.metrics.allan import allan_deviation, wander_of

T = 60.0 * np.arange(240)
SD = np.full((240, 3), 1e-7)


def noise(seed):
    return 1e-7 * np.random.default_rng(seed).normal(size=(240, 3))


def walk(seed, c=1e-8):
    steps = c * np.sqrt(60.0) * np.random.default_rng(seed).normal(size=(240, 3))
    return np.cumsum(steps, axis=0)


def test_a_steady_drift_leaves_its_way_over_root_two():
    """D m T / sqrt(2), by hand: 1e-9 m/s over 4 x 60 s leaves 170 nm."""
    r = 1e-9 * T[:, None] * np.array([1.0, -2.0, 0.0])
    np.testing.assert_allclose(allan_deviation(r, 4), np.array([1.697, 3.394, 0]) * 1e-7, rtol=1e-3)


def test_the_allan_deviation_of_three_measurements_by_hand():
    """1, 2, 4: half the mean of the squares of 1 and 2, so 2.5 of root: 1.118."""
    r = np.outer([1.0, 2.0, 4.0], [1.0, 0, 0])
    assert allan_deviation(r, 1)[0] == pytest.approx(np.sqrt(0.5 * (1 + 4) / 2))


def test_the_deviation_of_pure_measurement_noise_falls_with_the_root_of_the_count():
    squares = [wander_of(T, noise(s), SD).deviation ** 2 for s in range(40)]
    found = wander_of(T, noise(0), SD)
    ratio = np.sqrt(np.mean(squares, axis=0)) / found.measurements_alone
    np.testing.assert_allclose(ratio[:5], 1.0, atol=0.08)


def test_a_walk_grows_with_the_root_of_time():
    """c sqrt(m T / 3), where means of m estimates are long against one estimate."""
    squares = [allan_deviation(walk(s), 16) ** 2 for s in range(60)]
    expected = 1e-8 * np.sqrt(16 * 60.0 / 3)
    assert np.sqrt(np.mean(squares)) == pytest.approx(expected, rel=0.08)


def test_drift_and_walk_are_found_with_honest_doubt():
    """1 nm/s under a walk and white errors: sixty courses, errors as large as stated."""
    true, off, walks = np.array([1e-9, 0.0, -3e-10]), [], []
    for seed in range(60):
        found = wander_of(T, noise(seed) + walk(seed + 100) + T[:, None] * true, SD)
        off.append((found.drift - true) / found.drift_sd)
        walks.append(found.walk)
    assert 0.8 < np.sqrt(np.mean(np.square(off))) < 1.2
    assert np.sqrt(np.mean(np.square(walks))) == pytest.approx(1e-8, rel=0.1)


def test_spans_double_and_their_doubt_grows():
    found = wander_of(T, noise(1), SD)
    np.testing.assert_allclose(found.span, 60.0 * 2.0 ** np.arange(7))
    assert found.error[0] == pytest.approx(1 / np.sqrt(2 * 239))
    assert np.all(np.diff(found.error) > 0)
