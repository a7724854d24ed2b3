import numpy as np
import pytest

from equipoise.simulation.noise_torque import STEPS, extended, forgotten, start_noise, torque_at

SD, CORRELATION = 2e-6, 10.0


def drawn(until, seed=0, sd=SD, correlation=CORRELATION):
    rng = np.random.default_rng(seed)
    return extended(start_noise(sd, correlation, rng), until, rng)


def test_sd_and_correlation_are_as_stated():
    """3000 correlation times are worth n / 2 = 1500 draws per axis: bounds of 4 sd."""
    noise = drawn(3000 * CORRELATION)
    n = 3 * 1500
    assert np.mean(noise.values**2) / SD**2 == pytest.approx(1.0, abs=4 * np.sqrt(2 / n))
    for lag in (1, STEPS, 2 * STEPS):
        product = np.mean(noise.values[:-lag] * noise.values[lag:]) / SD**2
        assert product == pytest.approx(np.exp(-lag / STEPS), abs=4 * np.sqrt(2 / n))
    axes = np.corrcoef(noise.values.T)[np.triu_indices(3, 1)]
    assert np.all(np.abs(axes) < 4 / np.sqrt(1500))


def test_it_has_its_sd_from_the_start():
    first = np.array([drawn(0.0, seed).values[0] for seed in range(1000)])
    assert np.mean(first**2) / SD**2 == pytest.approx(1.0, abs=4 * np.sqrt(2 / 3000))


def test_drawing_in_parts_and_forgetting_change_nothing():
    t = np.linspace(40.0, 100.0, 777)
    rng = np.random.default_rng(3)
    noise = start_noise(SD, CORRELATION, rng)
    for until in (0.1, 3.0, 3.0, 41.7, 100.0):
        noise = forgotten(extended(noise, until, rng), until - 2.0 if until < 50 else 40.0)
    assert noise.first > 0
    np.testing.assert_array_equal(torque_at(noise, t), torque_at(drawn(100.0, 3), t))


def test_it_covers_the_requested_time_and_at_most_one_step_more():
    noise = drawn(7.3)
    assert 7.3 <= noise.t[-1] < 7.3 + noise.step + 1e-9
    assert noise.step == CORRELATION / STEPS


def test_no_noise_is_zero():
    assert not torque_at(drawn(10.0, sd=0.0), np.linspace(0.0, 10.0, 5)).any()
