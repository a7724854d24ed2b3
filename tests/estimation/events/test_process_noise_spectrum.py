"""Jumps of process noise that go one way for a while are denser than white ones."""

import numpy as np
import pytest

from equipoise.estimation.events.process_noise_spectrum import block_ratios, densest


def test_ratios_by_hand() -> None:
    """Sums over two: 3, 7 and -1, -1 and 0, 0; mean squares 29, 1, 0; over two."""
    u = np.array([[1.0, -1.0, 1.0], [2.0, 0.0, -1.0], [3.0, 0.0, 2.0], [4.0, -1.0, -2.0]])
    np.testing.assert_allclose(block_ratios(u, 2), [14.5, 0.5, 0.0])


def test_a_row_left_over_does_not_count() -> None:
    u = np.array([[1.0] * 3, [1.0] * 3, [9.0] * 3])
    np.testing.assert_allclose(block_ratios(u, 2), 2.0)


def test_white_jumps_are_hardly_denser() -> None:
    """Over 40 draws of 300 jumps: half are as dense as they are, none is three times denser."""
    rng = np.random.default_rng(3)
    found = np.array([densest(rng.normal(size=(300, 3))) for _ in range(40)])
    assert np.median(found) < 1.8
    assert found.max() < 5.0


def test_smoothed_jumps_of_less_than_their_size_are_white() -> None:
    assert np.all(densest(0.5 * np.random.default_rng(4).normal(size=(300, 3))) == 1.0)


def test_a_push_that_changes_its_sign_every_32_cuts() -> None:
    """All of a block alike: n times the density of white ones, on that axis alone."""
    u = 0.3 * np.random.default_rng(5).normal(size=(512, 3))
    u[:, 1] = 0.5 * np.where(np.arange(512) // 32 % 2, 1.0, -1.0)
    assert densest(u) == pytest.approx([1.0, 0.25 * 32, 1.0])


def test_too_few_jumps_yield_a_white_spectrum() -> None:
    assert np.all(densest(np.ones((15, 3))) == 1.0)
