"""Running integrals against polynomials, and against SciPy's."""

import numpy as np
import pytest
import scipy

from equipoise.maths.sampled.running_integral import by_parabolas, by_trapezia, parabola_weights

UNEVEN = np.array([0.0, 0.5, 2.0, 2.25, 4.0, 4.5])


def test_trapezia_by_hand():
    """0.5 (1 + 3) / 2 = 1, then 1.5 (3 + 1) / 2 = 3 more."""
    assert by_trapezia(UNEVEN[:3], np.array([1.0, 3.0, 1.0])).tolist() == [1.0, 4.0]


@pytest.mark.parametrize("rows", [3, 4, 5, 6])
def test_parabolas_are_integrated_exactly(rows):
    t = UNEVEN[:rows]
    rate = np.stack([1.0 + 2.0 * t - 3.0 * t**2, 3.0 * t**2], axis=1)
    wanted = np.stack([t + t**2 - t**3, t**3], axis=1)
    assert by_parabolas(t, rate) == pytest.approx(wanted, abs=1e-13)


@pytest.mark.parametrize("rows", [3, 4, 101, 102])
def test_they_are_as_in_scipy(rows):
    rng = np.random.default_rng(1)
    t, y = np.cumsum(rng.random(rows) + 0.1), rng.standard_normal((rows, 3, 2))
    simpson = scipy.integrate.cumulative_simpson(y, x=t, axis=0, initial=np.zeros((1, 3, 2)))
    assert np.array_equal(by_parabolas(t, y), simpson)
    trapezia = scipy.integrate.cumulative_trapezoid(y[:, 0, 0], t)
    assert np.array_equal(by_trapezia(t, y[:, 0, 0]), trapezia)


@pytest.mark.parametrize("rows", [3, 4, 101, 102])
def test_weights_of_rows_give_the_same(rows):
    rng = np.random.default_rng(2)
    t, y = np.cumsum(rng.random(rows) + 0.1), rng.standard_normal(rows)
    first, weights = parabola_weights(t)
    steps = np.sum(weights * y[first[:, None] + np.arange(3)], axis=1)
    np.testing.assert_allclose(np.cumsum(steps), by_parabolas(t, y), rtol=1e-12, atol=1e-13)
