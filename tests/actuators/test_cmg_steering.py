"""Torque from gimbal rates: exact where it can be, bounded where it cannot, out of a lock."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.linalg import null_space

from equipoise.actuators import cmg_steering as steering
from equipoise.actuators.control_moment_gyros import (
    jacobian,
    rotor_momentum,
    singularity_measure,
    spin_axes,
)
from tests.support.gyro_pyramid import pyramid

H0 = 2 / 3
FOUR = pyramid(np.arccos(3**-0.5), H0, 1.0)
ELLIPTIC = np.radians([-90.0, 0.0, 90.0, 0.0])  # D has nothing along x: every h_x is at its extreme
PUSH = np.array([0.05, 0.0, 0.0])  # N m
angles4 = arrays(np.float64, 4, elements=st.floats(-np.pi, np.pi))
torques = arrays(np.float64, 3, elements=st.floats(-0.1, 0.1))


def delivered(x, rates):
    return -jacobian(FOUR, x) @ rates


@given(angles4, torques)
def test_pseudo_inverse_is_exact_away_from_singularities(x, torque):
    """And it is minus the slope of the momentum: gimbals that move so make this torque."""
    assume(singularity_measure(FOUR, x) > 0.1)
    rates = steering.pseudo_inverse(FOUR, x, torque)
    np.testing.assert_allclose(delivered(x, rates), torque, atol=1e-14)
    step = 1e-4
    ahead, behind = (rotor_momentum(FOUR, x + s * rates) for s in (step, -step))
    np.testing.assert_allclose(-(ahead - behind) / (2 * step), torque, atol=1e-6)


@given(angles4, torques)
def test_robust_is_exact_where_the_measure_is_good_and_bounded_where_not(x, torque):
    """Bounded by |u| / (2 sqrt(l)) and, where l is 0, by the least singular value that m allows.

    m is the product of D's singular values, the squares of which sum up to 4 (four unit columns),
    so that the least is m / 2 at least: at any m, 10 |u| / h0 is beyond what l and m let through.
    """
    rates = steering.singularity_robust(FOUR, x, torque)
    assert np.linalg.norm(rates) <= 10 * np.linalg.norm(torque) / H0 + 1e-15
    if singularity_measure(FOUR, x) >= 0.4:
        np.testing.assert_allclose(delivered(x, rates), torque, atol=1e-13)


@given(angles4, torques, st.floats(0, 100))
def test_generalised_is_all_but_exact_where_the_measure_is_good(x, torque, t):
    """l = 0.01 exp(-10 m^2) is below 5e-7 at m = 1; the least singular value is above 1/4."""
    assume(singularity_measure(FOUR, x) > 1.0)
    found = delivered(x, steering.generalised_robust(FOUR, x, torque, t))
    np.testing.assert_allclose(found, torque, atol=16 * 5e-7 * 1.1 * np.linalg.norm(torque) + 1e-15)


def test_the_lock_is_one():
    """At (-90, 0, 90, 0) deg there is no torque along x, and null motion does not lead away.

    h = (2 / sqrt 3) h0 along x: well inside what the gyros hold. To second order, null
    motion changes h_x by -1/2 sum (h_i)_x d_i^2: of one sign over D's null space, so elliptic.
    """
    np.testing.assert_allclose(jacobian(FOUR, ELLIPTIC)[0], 0.0, atol=1e-16)
    np.testing.assert_allclose(rotor_momentum(FOUR, ELLIPTIC), [2 * H0 / 3**0.5, 0, 0], atol=1e-15)
    null = null_space(jacobian(FOUR, ELLIPTIC), rcond=1e-10)
    assert null.shape == (4, 2)
    along = H0 * spin_axes(FOUR, ELLIPTIC)[:, 0]
    assert np.linalg.eigvalsh(null.T @ (along[:, None] * null)).min() > 0.1 * H0


def test_robust_is_locked_and_generalised_is_not():
    """The dither's rates are about e |u| / h0 = 0.01 x 0.075 rad/s."""
    rates = steering.singularity_robust(FOUR, ELLIPTIC, -PUSH)
    assert np.abs(rates).max() < 1e-12
    dithered = [steering.generalised_robust(FOUR, ELLIPTIC, -PUSH, t) for t in (0.5, 1.0, 2.5)]
    assert min(np.abs(d).max() for d in dithered) > 1e-4


def steered(rule, seconds=40.0, dt=0.01, start=ELLIPTIC, torque=-PUSH):
    """Return angles, rates and the time over a constant torque, rates limited to 1 rad/s."""
    t = np.arange(0.0, seconds, dt)
    x, all_x, all_rates = start.copy(), [], []
    for now in t:
        rates = steering.limited_rates(FOUR, rule(x, torque, now))
        all_x.append(x)
        all_rates.append(rates)
        x = x + dt * rates
    return t, np.array(all_x), np.array(all_rates)


def robust(x, torque, now):
    return steering.singularity_robust(FOUR, x, torque)


def generalised(x, torque, now):
    return steering.generalised_robust(FOUR, x, torque, now)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_only_the_dither_leads_out_of_the_lock(sign):
    """The lock lasts for ever, the dither ends it within 25 s, and what is asked for comes.

    From 0.77 N m s along x, inwards fast and outwards, where 2.1 could be held, slowly.
    """
    _, locked, _ = steered(robust, seconds=32.0, torque=sign * PUSH)
    assert np.abs(locked - ELLIPTIC).max() < 1e-9
    _, free, _ = steered(generalised, seconds=32.0, torque=sign * PUSH)
    gained = rotor_momentum(FOUR, free[-1]) - rotor_momentum(FOUR, ELLIPTIC)
    assert singularity_measure(FOUR, free[-1]) > 0.1
    assert -sign * gained[0] > 0.3


@pytest.mark.parametrize("rule", [robust, generalised])
def test_rates_stay_bounded_through_a_singularity(rule):
    """From rest with 0.05 N m along -x: the pseudo-inverse runs away at the lock, these do not.

    |u| / (2 sqrt(l)) / h0 with l = 0.01 at the lock: 5 |u| / h0 = 0.375 rad/s; on the way there,
    where l is smaller, the singular values are larger: twice that.
    """
    x = np.radians([-89.9, 0.1, 89.9, -0.1])
    assert np.abs(steering.pseudo_inverse(FOUR, x, -PUSH)).max() > 10.0
    _, angles, rates = steered(rule, seconds=30.0, start=np.zeros(4))
    measure = [singularity_measure(FOUR, row) for row in angles]
    assert min(measure) < 0.05
    assert np.linalg.norm(rates, axis=1).max() < 0.75


def test_limits_scale_all_rates_alike():
    fast = np.array([2.0, -0.5, 0.1, 0.0])
    np.testing.assert_allclose(steering.limited_rates(FOUR, fast), fast / 2)
    np.testing.assert_array_equal(steering.limited_rates(FOUR, fast / 4), fast / 4)


@pytest.mark.parametrize("t", [0.0, 0.7, 3.1])
def test_dither_is_the_published_one(t):
    """Written out element by element at a singularity, where l = 0.01."""
    e1, e2, e3 = (0.01 * np.sin(0.5 * np.pi * t + f) for f in (0.0, np.pi / 2, np.pi))
    by_hand = 0.01 * np.array([[1, e3, e2], [e3, 1, e1], [e2, e1, 1]])
    np.testing.assert_allclose(steering.dithered_weight(FOUR, ELLIPTIC, t), by_hand, atol=1e-15)
