"""Long-run covariance by hand: white noise, neighbours that err together, differences."""

import numpy as np
import pytest

from equipoise.maths.sampled.long_run import correlations, long_run_covariance, memory

WHITE = np.random.default_rng(4).standard_normal((20_000, 2))


def test_three_vectors_by_hand():
    """Lag 1, flat: both neighbours whole; at lag 2 the window is 2 (1 - 2/3) = 2/3."""
    v = np.array([[1.0], [2.0], [4.0]])
    total = 1 + 4 + 16 + 2 * (2 + 8) + 2 * (2 / 3) * 4
    assert long_run_covariance(v, 1)[0, 0] == pytest.approx(total)
    assert long_run_covariance(v, 0)[0, 0] == pytest.approx(21.0)


def test_white_noise_has_no_memory():
    assert memory(WHITE) == 0
    found = long_run_covariance(WHITE, 0) / len(WHITE)
    np.testing.assert_allclose(found, np.eye(2), atol=0.03)


def test_means_of_five_err_together():
    """Means of 5 of unit noise: correlated up to lag 4 by (5 - l) / 5; their sum has variance n."""
    means = np.apply_along_axis(lambda x: np.convolve(x, np.ones(5) / 5, "valid"), 0, WHITE)
    np.testing.assert_allclose(correlations(means, 5), [1, 0.8, 0.6, 0.4, 0.2, 0], atol=0.03)
    assert memory(means) == 4
    found = long_run_covariance(means, 4) / len(means)
    np.testing.assert_allclose(found, np.eye(2), atol=0.1)


def test_differences_cancel_in_their_sum():
    """Variance 2 each, -1 between neighbours: what is left is the least that is taken."""
    steps = np.diff(WHITE, axis=0)
    assert memory(steps) == 1
    assert np.diag(long_run_covariance(steps, 1)).max() < 0.1 * 2 * len(steps)
