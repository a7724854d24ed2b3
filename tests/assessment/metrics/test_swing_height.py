"""Which swing is which, and the height that follows from it."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.assessment.metrics.period import Swing
from equipoise.assessment.metrics.spin_lines import no_lines
from equipoise.assessment.metrics.swing_height import Turning, hanging
from equipoise.assessment.metrics.swing_modes import swing_rates

DOWN = np.array([0.0, 0.0, -1.0])
J = np.diag([0.30, 0.40, 0.60])
MOMENT = 0.014  # N m: 100 um of 14 kg
SLOW, QUICK = swing_rates(MOMENT, J, DOWN) / (2 * np.pi)
T = 120.0


def swing(frequency, along=(1.0 + 0j, 0j), amplitude=0.05):
    return Swing(frequency, 1e-3 * frequency, amplitude, 0.0, along, (0.0, 0.0))


def reported(*swings, duration=T, spin=0.0):
    return hanging(swings, Turning(duration, J, DOWN, spin, 0.0, no_lines(1)))


def test_both_swing_modes_give_the_same_height():
    slow, quick = reported(swing(SLOW), swing(QUICK, (0j, 1.0 + 0j)))
    assert (slow.mode, quick.mode) == (0, 1)
    assert slow.moment == pytest.approx(MOMENT, rel=1e-9)
    assert quick.moment == pytest.approx(MOMENT, rel=1e-9)
    assert slow.sd == pytest.approx(2e-3 * MOMENT, rel=0.01)  # m g h goes with f^2


def test_a_swing_alone_is_named_by_its_direction():
    """The slow one is about y, where the inertia is greater, and moves the vertical along x."""
    (slow,), (quick,) = (
        reported(swing(SLOW), duration=2 * T),
        reported(swing(QUICK, (0j, 1.0 + 0j)), duration=2 * T),
    )
    assert slow.mode == 0
    assert quick.mode == 1
    assert slow.moment == pytest.approx(MOMENT, rel=1e-9)
    assert quick.moment == pytest.approx(MOMENT, rel=1e-9)


def test_two_indistinguishable_swing_modes_are_reported_as_one():
    """Thirty seconds: 15 % of a period of 27 s cannot be resolved."""
    (both,) = reported(swing(0.5 * (SLOW + QUICK), (0.7 + 0j, 0.7 + 0j)), duration=30.0)
    assert both.mode is None
    assert abs(both.moment - MOMENT) < both.sd
    assert both.sd == pytest.approx(0.5 * MOMENT * (J[1, 1] - J[0, 0]) / 0.35, rel=0.05)


def test_an_overtone_is_no_swing():
    (only,) = reported(swing(SLOW), swing(2 * SLOW, amplitude=0.02))
    assert only.swing.frequency == SLOW


def test_a_spin_goes_into_the_height():
    """Without it the height is off by more than its sd."""
    rates = swing_rates(MOMENT, J, DOWN, 0.05) / (2 * np.pi)
    pair = swing(rates[0]), swing(rates[1], (0j, 1.0 + 0j))
    assert reported(*pair, spin=0.05)[0].moment == pytest.approx(MOMENT, rel=1e-9)
    assert abs(reported(*pair)[0].moment - MOMENT) > 3 * reported(*pair)[0].sd


def test_an_impossible_swing_yields_no_height():
    assert reported() == ()
    assert reported(replace(swing(SLOW), frequency=1e-6), spin=1.0) == ()
