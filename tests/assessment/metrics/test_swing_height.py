"""Which swing is which, and the height that follows from it."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.assessment.metrics.period import Swing
from equipoise.assessment.metrics.spin_lines import SpinLines, no_lines
from equipoise.assessment.metrics.swing_height import Turning, by_mode, hanging, spin_doubt
from equipoise.assessment.metrics.swing_modes import moment_for, swing_rates, swing_shapes

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


def test_a_swing_alone_of_a_platform_that_turns_is_named_by_the_sense_in_which_it_goes_round():
    """Its direction alone says nothing: each of the two goes round nearly on a circle."""
    spin = 0.4
    shapes = swing_shapes(MOMENT, J, DOWN, spin)
    for mode, rate in enumerate(swing_rates(MOMENT, J, DOWN, spin)):
        (one,) = reported(swing(rate / (2 * np.pi), tuple(shapes[mode])), spin=spin)
        assert one.mode == mode
        assert one.moment == pytest.approx(MOMENT, rel=1e-6)


def test_a_swing_that_cannot_show_may_move_the_other():
    """Where the slow one is at a line of the spin, it may be there: the quick one is less sure.

    By a quarter of 1/T, as if its frequency were 1/240 Hz higher.
    """
    spin, duration = 0.4, 60.0
    slow, quick = swing_rates(MOMENT, J, DOWN, spin) / (2 * np.pi)
    shape = tuple(swing_shapes(MOMENT, J, DOWN, spin)[1])
    line = SpinLines(np.zeros((1, 1)), np.array([slow]))
    sure, unsure = (
        hanging((swing(quick, shape),), Turning(duration, J, DOWN, spin, 0.0, lines))[0]
        for lines in (no_lines(1), line)
    )
    assert unsure.mode == sure.mode == 1
    assert sure.sd < 0.01 * MOMENT
    higher = moment_for(2 * np.pi * (quick + 1 / 240), 1, J, DOWN, spin)
    assert unsure.sd == pytest.approx(higher - MOMENT, rel=0.01)


def test_the_spin_is_known_to_half_the_square_of_the_tilt():
    """5 deg: W within 0.38 %; of m g h more, as torques of the slow swing nearly cancel."""
    spin = 0.4
    pair = [swing(f, amplitude=np.radians(5.0)) for f in swing_rates(MOMENT, J, DOWN, spin)]
    assert spin_doubt(tuple(pair[:1]), spin) == pytest.approx(0.0038 * spin, rel=0.01)
    rates = swing_rates(MOMENT, J, DOWN, spin)
    by_hand = moment_for(rates[0], 0, J, DOWN, spin + 0.002) - MOMENT
    exact = replace(swing(rates[0] / (2 * np.pi)), sd=0.0)
    found = by_mode(exact, 0, Turning(T, J, DOWN, spin, 0.002, no_lines(1)))
    assert found.sd == pytest.approx(abs(by_hand), rel=1e-6)
    assert found.sd > 1.5 * 0.002 / spin * MOMENT


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
