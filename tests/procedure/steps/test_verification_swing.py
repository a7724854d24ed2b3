"""When a platform has to be pushed before its proof."""

import numpy as np
import pytest

from equipoise.estimation.motion.attitude_filter import AttitudeState
from equipoise.maths.attitude import exponential
from equipoise.procedure.steps.verification_swing import STILL, swinging


def turning(rate, turn):
    values = np.zeros(14)
    values[1:5], values[11:14] = exponential(np.array(turn)), rate
    return AttitudeState(values)


def test_a_spin_about_the_vertical_is_no_swing():
    now = turning([0.0, 0.0, 0.05], [0.0, 0.0, 0.7])
    assert now.rate == pytest.approx([0.0, 0.0, 0.05])
    assert swinging(now) == pytest.approx(0.0, abs=1e-15)


def test_what_is_across_the_vertical_is():
    """Leaning by 30 deg about x, a turn about the body's z is half across."""
    leaning = turning([0.0, 0.0, 2 * STILL], [np.radians(30), 0.0, 0.0])
    assert swinging(leaning) == pytest.approx(STILL)
    assert swinging(turning([0.003, -0.004, 0.0], [0.0, 0.0, 0.2])) == pytest.approx(0.005)
