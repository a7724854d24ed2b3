"""The offsets that a verdict's record cannot distinguish from zero, by hand."""

import math

import numpy as np
import pytest

from equipoise.app.text.estimate_text import noise_floor_line
from tests.support.outcomes import halted, undecided
from tests.support.outcomes import verdict as verdict_of


def test_the_floor_is_the_half_interval():
    """1.96 sd, whatever the centre of mass is."""
    verdict = verdict_of(True, np.array([3e-6, 0, 0]), np.array([1e-6, 5e-7, 1e-5]))
    assert verdict.noise_floor == pytest.approx([1.96e-6, 0.98e-6, 19.6e-6], rel=1e-4)


def test_an_unobservable_axis_has_no_noise_floor():
    sd = np.array([1e-6, 5e-7, math.inf])
    line = noise_floor_line(undecided(np.zeros(3), sd))
    assert "x 2.0 um, y 0.98 um, z unobservable" in line


def test_a_verdict_without_numbers_says_nothing():
    assert noise_floor_line(halted()) == ""
