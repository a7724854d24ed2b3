"""Han's tracking differentiator against values by hand and the analytic low pass."""

import numpy as np
import pytest

from equipoise.maths.sampled.tracking_differentiator import (
    Pace,
    advance,
    begin,
    fhan,
    pace_for,
    track,
    track_twice,
)

STEP, H0 = 1e-3, 0.1  # s
T = STEP * np.arange(4001)


def filtered(signal, h0=H0):
    signal = signal[:, None]
    return track(pace_for(signal, h0), T, signal)


# With r0 = 2 and h0 = 0.5: d = 1, d0 = 0.5.
BY_HAND = {
    "linear": (0.1, 0.1, -0.8),  # y = 0.15, a = 0.1 + 0.3 = 0.4: -2 x 0.4 / 1
    "near, fast": (0.1, 0.7, -2.0),  # y = 0.45, a = 0.7 + 0.9 = 1.6 > d
    "far": (1.0, 0.0, -2.0),  # y = 1, a0 = sqrt(17), a = 1.56 > d
    "far, slowing": (1.5, -1.5, 0.394448724536011),  # y = 0.75, a0 = sqrt(13), a = -0.197224
    "far, too fast back": (2.0, -2.5, 2.0),  # y = 0.75, a = -1.197
    "at rest": (0.0, 0.0, 0.0),
}


@pytest.mark.parametrize(("x1", "x2", "out"), BY_HAND.values(), ids=BY_HAND)
def test_fhan_by_hand(x1, x2, out):
    assert fhan(x1, x2, 2.0, 0.5) == pytest.approx(out, abs=1e-14)


@pytest.mark.parametrize(("x1", "x2", "out"), BY_HAND.values(), ids=BY_HAND)
def test_fhan_is_odd(x1, x2, out):
    assert fhan(-x1, -x2, 2.0, 0.5) == pytest.approx(-out, abs=1e-14)


def test_ramp_is_two_h0_late():
    """Exactly, once the start is forgotten (40 h0); the slope is right."""
    out = filtered(3.0 * T)
    np.testing.assert_allclose(out.value[-1], 3 * (T[-1] - 2 * H0), rtol=1e-10)
    np.testing.assert_allclose(out.slope[-1], 3.0, rtol=1e-10)


def test_twice_is_four_h0_late():
    signal = np.column_stack([3 * T, -T])
    out = track_twice(pace_for(signal, H0), T, signal)
    np.testing.assert_allclose(out.value[-1], np.array([3, -1]) * (T[-1] - 4 * H0), rtol=1e-10)


def test_value_and_slope_are_equally_late():
    """Of t^2 the slope is 2 (t - 2 h0) where the value is (t - 2 h0)^2 and a constant."""
    out = filtered(T**2)
    assert out.slope[-1].item() == pytest.approx(2 * (T[-1] - 2 * H0), rel=1e-10)
    rise = out.value[-1] - out.value[-3]
    np.testing.assert_allclose(out.slope[-2], rise / (2 * STEP), rtol=1e-10)


def test_jump_is_answered_as_by_the_critically_damped_low_pass():
    """1 - (1 + t / h0) exp(-t / h0); Euler's steps err by some step / h0 = 1 %."""
    signal = np.where(T >= 1, 1.0, 0.0)
    u = np.clip(T - 1, 0, None) / H0
    out = filtered(signal)
    np.testing.assert_allclose(out.value[:, 0], 1 - (1 + u) * np.exp(-u), atol=0.01)
    np.testing.assert_allclose(out.slope[:, 0], u * np.exp(-u) / H0, atol=0.01 / H0)
    assert out.value.max() < 1 + 1e-12  # no overshoot


def test_linear_zone_is_never_left_at_the_pace_chosen():
    """Two signals together are answered as each alone, though each has a pace of its own."""
    rng = np.random.default_rng(1)
    one, two = np.sign(np.sin(9 * T)), rng.normal(size=len(T))
    whole = filtered(one + two).value
    np.testing.assert_allclose(whole, filtered(one).value + filtered(two).value, atol=1e-12)


def test_slow_pace_bounds_the_slope_of_the_slope():
    """At r0 = 5 a jump of 1 is followed with v2 changing by no more than 5 a second."""
    signal = np.where(T >= 1, 1.0, 0.0)[:, None]
    out = track(Pace(np.array([5.0]), 0.01), T, signal)
    change = np.diff(out.slope[:, 0]) / STEP
    assert np.abs(change).max() == pytest.approx(5.0, rel=1e-6)
    assert out.value[-1].item() == pytest.approx(1.0, abs=1e-6)


def test_integral_of_a_constant_is_exact():
    np.testing.assert_allclose(filtered(np.full_like(T, 2.0)).integral[:, 0], 2 * T, atol=1e-12)


def test_integral_of_a_ramp_is_as_late_as_its_value():
    """Its growth is that of (t - 2 h0)^2 / 2, once the start is forgotten."""
    late = 0.5 * (T - 2 * H0) ** 2
    grown = filtered(T).integral[:, 0] - late
    np.testing.assert_allclose(grown[2500:], grown[2500], atol=1e-9)


def test_integral_of_a_sine_is_as_late_as_the_value_of_its_integral():
    """The integral of sin 3t behind the filter, and -cos(3t) / 3 through it, differ by a constant.

    That is what a momentum row needs. A forward step would be half a step late: 5e-4.
    """
    separation = (filtered(np.sin(3 * T)).integral - filtered(-np.cos(3 * T) / 3).value)[:, 0]
    np.testing.assert_allclose(separation[2500:], separation[2500], atol=2e-6)


def test_row_by_row_is_all_at_once():
    signal = np.random.default_rng(2).normal(size=(200, 3))
    t = np.cumsum(np.random.default_rng(3).uniform(0.5, 1.5, 200)) * STEP
    pace = pace_for(signal, 0.01)
    _, whole = advance(pace, begin(t[0], signal[0]), t, signal)
    state, parts = begin(t[0], signal[0]), []
    for k in range(200):
        state, part = advance(pace, state, t[k : k + 1], signal[k : k + 1])
        parts.append(part)
    for mine, theirs in zip(whole, zip(*parts, strict=True), strict=True):
        assert np.array_equal(mine, np.vstack(theirs))
