"""Bounds of a share: by hand, and as rarely too low as promised."""

import numpy as np
import pytest
from scipy.stats import binom

from equipoise.study.bounded_share import bounded_share


def test_none_of_some_runs_by_hand():
    """All n runs lack it with probability (1 - p)^n = 2.5 %: p = 1 - 0.025^(1/n)."""
    found = bounded_share(0, 73)
    assert found.low == 0.0
    assert found.high == pytest.approx(1 - 0.025 ** (1 / 73), rel=1e-9)


def test_the_share_of_those_without_it_is_the_rest():
    one, other = bounded_share(3, 20), bounded_share(17, 20)
    np.testing.assert_allclose(one, (1 - other.high, 1 - other.low), atol=1e-12)


@pytest.mark.parametrize("true", [0.01, 0.05, 0.3])
@pytest.mark.parametrize("runs", [20, 100])
def test_the_upper_bound_is_too_low_in_at_most_2_5_percent(true, runs):
    low = [k for k in range(runs + 1) if bounded_share(k, runs).high < true]
    assert binom.pmf(low, runs, true).sum() <= 0.025
