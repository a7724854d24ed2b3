"""Gyros by hand, against the printed Jacobian, and their inertia as coordinates."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.actuators.control_moment_gyros import (
    gimbal_coordinates,
    gimbal_maps,
    gimbal_momentum,
    gyros_span,
    jacobian,
    rotor_momentum,
    singularity_measure,
    spin_axes,
)
from equipoise.actuators.sliding_masses import com_shift, inertia_shift
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.devices import ControlMomentGyro
from tests.support.gyro_pyramid import pyramid

SKEW = np.arccos(3**-0.5)  # 54.7 deg: the momentum reaches alike in all directions
FOUR = pyramid(SKEW, 2 / 3, 1.0)
angles4 = arrays(np.float64, 4, elements=st.floats(-4.0, 4.0))


def skewed(seed=0, k=3):
    """Gyros of different momentum, any axes, as records; from a fixed draw."""
    rng = np.random.default_rng(seed)
    found = []
    for i in range(k):
        g, a = rng.normal(size=(2, 3))
        g /= np.linalg.norm(g)
        s = np.cross(g, a)
        found.append(
            ControlMomentGyro(
                f"g{i}", g, s / np.linalg.norm(s), rng.uniform(0.2, 1.0), 1.0,
                gimbal_inertia=rng.uniform(1e-3, 4e-3), asymmetry=rng.uniform(-2e-3, 2e-3),
            )
        )  # fmt: skip
    return tuple(found)


def printed(x, skew):
    """D / h0 as in Lee and in Wie 2001."""
    c, s, cB, sB = np.cos(x), np.sin(x), np.cos(skew), np.sin(skew)
    return np.array(
        [
            [-cB * c[0], s[1], cB * c[2], -s[3]],
            [-s[0], -cB * c[1], s[2], cB * c[3]],
            [sB * c[0], sB * c[1], sB * c[2], sB * c[3]],
        ]
    )


@given(angles4, st.floats(0.1, 1.4))
def test_jacobian_of_the_pyramid_is_the_printed_one(x, skew):
    found = jacobian(pyramid(skew, 2 / 3, 1.0), x)
    np.testing.assert_allclose(found, 2 / 3 * printed(x, skew), atol=1e-15)


def test_pyramid_by_hand():
    """At zero the four momenta are +y, -x, -y, +x: none is left; gimbals lean by the skew."""
    np.testing.assert_allclose(rotor_momentum(FOUR, np.zeros(4)), 0.0, atol=1e-16)
    np.testing.assert_allclose(FOUR[0].spin_axis, [0, 1, 0])
    np.testing.assert_allclose(FOUR[0].gimbal_axis, [(2 / 3) ** 0.5, 0, 3**-0.5])
    # All a quarter turn on: each h has its z part sin(skew), and the rest goes round.
    h = rotor_momentum(FOUR, np.full(4, np.pi / 2))
    np.testing.assert_allclose(h, [0, 0, 4 * 2 / 3 * (2 / 3) ** 0.5], atol=1e-15)


@given(arrays(np.float64, 3, elements=st.floats(-4.0, 4.0)))
def test_jacobian_is_the_slope_of_momentum(x):
    """Central differences of 1e-5 rad of any layout: 1e-10 of rounding and curvature."""
    cmgs, step = skewed(), 1e-5
    for i in range(3):
        ahead, behind = x + step * np.eye(3)[i], x - step * np.eye(3)[i]
        slope = (rotor_momentum(cmgs, ahead) - rotor_momentum(cmgs, behind)) / (2 * step)
        np.testing.assert_allclose(jacobian(cmgs, x)[:, i], slope, atol=1e-9)


def test_a_gimbal_turns_the_spin_axis_by_the_right_hand():
    """g = z, s0 = x: a quarter turn leads to y."""
    one = (ControlMomentGyro("g", np.array([0, 0, 1.0]), np.array([1.0, 0, 0]), 1.0, 1.0),)
    np.testing.assert_allclose(spin_axes(one, np.array([np.pi / 2])), [[0, 1, 0]], atol=1e-16)


def test_series_are_rows():
    x = np.linspace(-1, 1, 12).reshape(4, 3)
    rows = np.array([rotor_momentum(skewed(), row) for row in x])
    np.testing.assert_allclose(rotor_momentum(skewed(), x), rows, atol=1e-16)
    rows = np.array([jacobian(skewed(), row) for row in x])
    np.testing.assert_allclose(jacobian(skewed(), x), rows, atol=1e-16)


def test_measure_of_the_pyramid_at_zero_by_hand():
    """D D^T / h0^2 = diag(2/3, 2/3, 8/3) at 54.7 deg: m = sqrt(32/27), whatever the momentum."""
    assert singularity_measure(FOUR, np.zeros(4)) == pytest.approx((32 / 27) ** 0.5)
    assert singularity_measure(FOUR, np.radians([-90, 0, 90, 0])) == pytest.approx(0.0, abs=1e-7)


@given(arrays(np.float64, (2, 3), elements=st.floats(-7.0, 7.0)))
def test_coordinates_and_maps_are_the_turned_inertia(x):
    """asymmetry (s s^T - s0 s0^T), summed over the gyros; nothing at zero, nor a first moment."""
    cmgs = skewed()
    maps, d = gimbal_maps(cmgs), gimbal_coordinates(cmgs, x)
    assert d.shape == (2, 9)
    for row, turned in zip(d, x, strict=True):
        s, s0 = spin_axes(cmgs, turned), spin_axes(cmgs, np.zeros(3))
        by_hand = sum(
            c.asymmetry * (np.outer(a, a) - np.outer(b, b))
            for c, a, b in zip(cmgs, s, s0, strict=True)
        )
        np.testing.assert_allclose(unpack_symmetric(inertia_shift(maps, row)), by_hand, atol=1e-17)
        np.testing.assert_array_equal(com_shift(maps, 10.0, row), 0.0)
    np.testing.assert_array_equal(gimbal_coordinates(cmgs, np.zeros((1, 3))), 0.0)


def test_maps_give_the_momentum_of_turning_gimbals():
    """Slopes of the coordinates times the maps' momentum: gimbal_inertia rate g."""
    cmgs, rates = skewed(), np.array([0.3, -0.2, 0.5])
    t = np.array([0.0, 1e-3])
    d = gimbal_coordinates(cmgs, 0.7 + t[:, None] * rates)
    slope = (d[1] - d[0]) / 1e-3
    by_hand = sum(c.gimbal_inertia * r * c.gimbal_axis for c, r in zip(cmgs, rates, strict=True))
    np.testing.assert_allclose(slope @ gimbal_maps(cmgs).momentum, by_hand, atol=1e-15)
    np.testing.assert_allclose(gimbal_momentum(cmgs, rates), by_hand, atol=1e-18)


def test_which_gyros_span():
    """Three do; two do not; nor do four with parallel gimbals, whose momenta stay in a plane."""
    flat = tuple(
        replace(c, gimbal_axis=np.array([0, 0, 1.0]), spin_axis=np.array([1.0, 0, 0])) for c in FOUR
    )
    assert gyros_span(FOUR)
    assert gyros_span(skewed(5, 3))
    assert not gyros_span(FOUR[:2])
    assert not gyros_span(flat)
