"""Ultimate gain and period: by hand, by calculation and by experiment."""

import numpy as np
import pytest

from equipoise.control.elements.loop_stability import (
    Sampled,
    closed,
    radius,
    steps_late,
    swing_input,
    swing_matrix,
)
from equipoise.control.elements.ziegler_nichols import (
    BAND,
    Gains,
    Loop,
    Relay,
    Ultimate,
    band_of,
    has_settled,
    measured,
    relay_step,
    rule,
    ultimate,
)

A, W0 = 458.0, 0.4  # rad/s^2 per m, rad/s: the reference table at 350 um


def test_ultimate_by_hand():
    """w = 1: atan(w L) = 45 degrees = w T + asin(BAND); K = (1 - w0^2) / (a sqrt 2)."""
    late = np.pi / 4 - np.arcsin(BAND)
    found = ultimate(Loop(A, 0.5, 1.0, late, 1e-3, 1e-12))
    assert found.period == pytest.approx(2 * np.pi)
    assert found.gain == pytest.approx(0.75 / (A * np.sqrt(2)))


def test_masses_that_take_time_are_a_delay_and_a_smaller_harmonic():
    """With d / R = 0.3 s beside 0.2 s: as 0.5 s of delay, over sin(0.3 w) / (0.3 w)."""
    slow, late = (ultimate(Loop(A, W0, 2.0, *x)) for x in ((0.2, 1e-5, 3e-6), (0.5, 1e-5, 1e-14)))
    x = 0.3 * 2 * np.pi / late.period
    assert slow.period == pytest.approx(late.period)
    assert slow.gain == pytest.approx(late.gain * x / np.sin(x))


def test_a_lag_beyond_the_lead_leaves_no_gain():
    assert ultimate(Loop(A, W0, 1.0, 1.5, 1e-5, 1e-9)).gain == 0.0


def test_the_rule_by_hand():
    """K_u = 2, T_u = 1.2 s, lead 0.5 s: K = 0.9, T_i = 1 s; 0.9 (1 + 0.5), 0.9 / 1, 0.9 x 0.5."""
    np.testing.assert_allclose(rule(Ultimate(2.0, 1.2), 0.5), [1.35, 0.9, 0.45])


def experiment(loop: Loop, step: float, noise: float = 0.0) -> Ultimate:
    """A relay on a plain axis: masses go at R to +-d, sampled every ``step`` s; Euler, fine."""
    rng, fine = np.random.default_rng(1), step / 200
    cycle, relay = ultimate(loop), Relay()
    tilt, rate, v, t = 0.002, 0.0, 0.0, 0.0
    while not has_settled(relay) and t < 400:
        sigma = tilt + loop.lead * rate + noise * rng.normal()
        relay = relay_step(relay, t, sigma, band_of(loop, cycle))
        goal = relay.output * loop.relay
        for _ in range(200):
            v += np.clip(goal - v, -loop.slew * fine, loop.slew * fine)
            rate += fine * (-(loop.frequency**2) * tilt + loop.gain * v)
            tilt += fine * rate
        t += step
    return measured(relay, loop.relay)


@pytest.mark.parametrize("travel", [0.25, 0.5, 0.75, 1.0, 1.25])
def test_experiment_and_calculation_agree(travel):
    """Within 8 % in gain, for masses that take up to 2.5 s from one side to the other."""
    loop = Loop(A, W0, 2.5, 0.05, 1.4e-5, 1.4e-5 * travel)
    found, expected = experiment(loop, 0.1), ultimate(loop)
    assert found.gain == pytest.approx(expected.gain, rel=0.08)
    assert found.period == pytest.approx(expected.period, rel=0.05)


def test_the_period_is_set_by_the_masses_lag():
    """Three times the travel, more than twice the period, a quarter of the gain at most."""
    quick, slow = (experiment(Loop(A, W0, 2.5, 0.05, 1.4e-5, 1.4e-5 * t), 0.1) for t in (0.5, 1.5))
    assert slow.period > 2 * quick.period  # 11.2 and 2.6 s
    assert slow.gain < quick.gain / 4


def test_the_dead_band_keeps_noise_from_switching():
    """Noise of a twentieth of the cycle changes gain and period by a few per cent only."""
    loop = Loop(A, W0, 2.5, 0.05, 1.4e-5, 1.4e-5)
    noise = 0.05 * 4 * loop.relay / (np.pi * ultimate(loop).gain)
    quiet, noisy = experiment(loop, 0.1), experiment(loop, 0.1, noise)
    assert noisy.gain == pytest.approx(quiet.gain, rel=0.12)
    assert noisy.period == pytest.approx(quiet.period, rel=0.05)


# --- The sampled loop ------------------------------------------------------------------------


def test_the_swing_is_sampled_exactly():
    """A quarter swing takes (1, 0) to (0, -w0); a weight held over half of one, to 2 a v / w0^2."""
    np.testing.assert_allclose(swing_matrix(W0, np.pi / 2 / W0) @ [1, 0], [0, -W0], atol=1e-15)
    np.testing.assert_allclose(swing_input(W0, np.pi / W0), [2 / W0**2, 0], atol=1e-15)


def test_the_sampled_loop_has_the_poles_of_the_equation():
    """With fine steps: s^3 + a K_d s^2 + (w0^2 + a K_p) s + a K_i."""
    gains, h = Gains(3e-4, 5e-5, 8e-4), 1e-3
    poles = np.log(np.linalg.eigvals(closed(Sampled(A, W0, h, 1), gains)).astype(complex)) / h
    slow = np.sort_complex(poles[np.abs(poles) < 5])
    p, i, d = gains
    expected = np.sort_complex(np.roots([1, A * d, W0**2 + A * p, A * i]))
    np.testing.assert_allclose(slow, expected, rtol=5e-3)


@pytest.mark.parametrize("gain", np.geomspace(1e-7, 1e-2, 11))
def test_proportional_action_alone_is_unstable_at_every_gain(gain):
    """Which is why the test of 1942 cannot be done on the tilt."""
    assert radius(closed(Sampled(A, W0, 0.05, 1), Gains(gain, 0.0, 0.0))) > 1 + 1e-9


def test_with_its_lead_the_loop_is_stable_below_the_ultimate_gain_only():
    """Late by n steps and half a step of hold, T = (n + 1/2) h; no dead band."""
    h, n, lead = 0.05, 8, 2.0
    axis = Sampled(A, W0, h, n)
    w = next(w for w in np.arange(1.0, 30, 1e-3) if np.arctan(w * lead) < w * (n + 0.5) * h)
    edge = (w**2 - W0**2) / (A * np.hypot(1, w * lead))
    for share, inside in ((0.97, True), (1.03, False)):
        gains = Gains(share * edge, 1e-6 * edge, share * edge * lead)
        assert (radius(closed(axis, gains)) < 1) is inside


def test_steps_late_by_hand():
    assert [steps_late(d, 0.25) for d in (0.0, 0.1, 0.25, 0.4)] == [1, 1, 2, 3]
