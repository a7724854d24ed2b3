"""How much an interval is widened for what a model leaves, by hand."""

import pytest

from equipoise.estimation.conclusion import widening
from equipoise.model.estimate import Residual


def left(chi_square, peak, degrees_of_freedom=1000):
    """What a model leaves: its chi-square, and the peak of its spectral density over its mean."""
    return Residual(0.003, None, chi_square, degrees_of_freedom, 0.0, 1.0, spectral_peak=peak)


def test_noise_as_stated_and_white_widens_nothing():
    assert widening(left(1000.0, 1.0)) == 1.0


def test_colour_widens_by_the_root_of_its_peak():
    assert widening(left(1000.0, 6.25)) == pytest.approx(2.5)


def test_a_residual_larger_than_stated_widens_by_its_root():
    """Beyond four sd of its own chance, 4 sqrt(2 / 1000) = 0.18; a smaller excess is chance."""
    assert widening(left(1440.0, 1.0)) == pytest.approx(1.2)
    assert widening(left(1150.0, 1.0)) == 1.0


def test_both_together_multiply():
    assert widening(left(1440.0, 6.25)) == pytest.approx(3.0)
