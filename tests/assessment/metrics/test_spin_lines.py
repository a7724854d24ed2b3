"""Lines of a platform that turns: its heading as recorded, and where they are."""

import numpy as np
import pytest

from equipoise.assessment.metrics.spin_lines import heading, is_separate, no_lines, spin_lines
from equipoise.maths.attitude import exponential

T = np.arange(0.0, 60.0, 1.0)


def turned(rate):
    """Attitudes that turn about the vertical at ``rate`` (rad/s)."""
    return exponential(np.outer(rate * T, [0.0, 0.0, 1.0]))


@pytest.mark.parametrize("rate", [0.1, -0.7, 3.5])
def test_the_heading_is_followed_over_all_turns_even_by_a_slow_camera(rate):
    """At 3.5 rad/s a row a second is more than half a turn after the one before."""
    psi = heading(T, turned(rate), np.array([1.0, 0.0, 0.0]), rate)
    np.testing.assert_allclose(psi - psi[0], rate * T, atol=1e-9)


def test_lines_lie_at_the_spin_and_its_harmonics():
    """42 deg/s are 0.11667 Hz; a minute separates what is more than 1/120 Hz off."""
    lines = spin_lines(T, np.radians(42.0) * T)
    np.testing.assert_allclose(lines.frequency, [0.11667, 0.23333, 0.35], atol=1e-5)
    psi = np.radians(42.0) * T
    waves = [wave(k * psi) for k in (1, 2, 3) for wave in (np.cos, np.sin)]
    np.testing.assert_allclose(lines.columns, np.transpose(waves), atol=1e-12)
    assert not is_separate(0.11667 + 0.9 / 120, lines, 60.0)
    assert not is_separate(0.35 - 0.9 / 120, lines, 60.0)
    assert is_separate(0.11667 + 1.1 / 120, lines, 60.0)
    assert is_separate(0.11667, no_lines(len(T)), 60.0)


def test_a_platform_that_makes_less_than_half_a_turn_has_none():
    assert not spin_lines(T, np.radians(2.9) * T).turns
    assert spin_lines(T, np.radians(3.1) * T).turns
