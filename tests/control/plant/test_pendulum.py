"""Tilt, shift and swing of a platform that hangs, by hand and against its true motion."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.law import Sample
from equipoise.control.plant import pendulum as h
from equipoise.control.plant.tilt_axes import SPARE
from equipoise.maths.attitude import exponential, multiply, to_matrix
from equipoise.maths.axes_across import axes_across
from equipoise.model.errors import InputError
from tests.support.simple_loop import GRAVITY, MASS, Loop, Plant, table

DEEP = table(np.array([0.0, 0.0, -400e-6]))


def observed_at(q, rate=(0.0, 0.0, 0.0)):
    gravity = to_matrix(q).T @ np.array([0.0, 0.0, -GRAVITY])
    zero = np.zeros(3)
    return Sample(0.0, q, np.array(rate), gravity, zero, zero, zero, zero, None)


@pytest.mark.parametrize("turn", [(0.01, 0.0), (0.0, 0.01), (-0.006, 0.008)])
def test_tilt_is_the_small_turn_from_level(turn):
    """To second order, whatever the heading."""
    heading = exponential(np.array([0.0, 0.0, 0.7]))
    q = multiply(heading, exponential(np.array([*turn, 0.0])))
    np.testing.assert_allclose(h.tilt_of(h.hanging(DEEP), observed_at(q)), turn, atol=1e-6)


def test_a_weight_to_the_left_turns_to_the_left():
    """Shifted along +y the platform turns about -x: v = u x s = (-s_y, s_x)."""
    plant = h.hanging(DEEP)
    np.testing.assert_allclose(h.turned(plant, np.array([2.0, 3.0, 4.0])), [-3.0, 2.0])
    np.testing.assert_allclose(h.shift_for(plant, np.array([-3.0, 2.0])), [2.0, 3.0, 0.0])


@pytest.mark.parametrize("up", [(0, 0, 1), (0, 0, -1), (1, 0, 0), (0.6, 0, 0.8)])
def test_there_and_back_for_any_up(up):
    plant = h.hanging(DEEP)._replace(up=np.array(up, float), axes=axes_across(np.array(up, float)))
    v = np.array([0.3, -0.7])
    np.testing.assert_allclose(h.turned(plant, h.shift_for(plant, v)), v, atol=1e-15)
    np.testing.assert_allclose(plant.axes @ plant.axes.T, np.eye(2), atol=1e-15)
    np.testing.assert_allclose(plant.axes @ plant.up, 0.0, atol=1e-15)


def test_the_true_platform_accelerates_as_the_pendulum_model_predicts():
    """theta'' = -w0^2 theta + a (c + v) at rest: the rate after a tenth of a second."""
    com = np.array([30e-6, -50e-6, -400e-6])
    true = Plant(table(com), [0.02, -0.01, 0.0], [0.0, 0.0, 0.0])
    plant = h.hanging(table(com))._replace(lowered=0.0, depth=400e-6)
    tilt = h.tilt_of(plant, Loop(true).sample(np.zeros(3), np.zeros(3)))
    expected = -(plant.frequency**2) * tilt + plant.gain * h.turned(plant, com)
    true.go(0.1)
    np.testing.assert_allclose(true.rate[:2] / 0.1, expected, rtol=2e-3)


def test_it_is_lowered_until_it_surely_hangs():
    """By hand: 3 sds of 50 um; sideways 2 sds of 71 um, over 0.7 of 30 degrees."""
    plant = h.hanging(table(np.array([0.0, 0.0, 50e-6])))
    assert plant.depth == pytest.approx(2 * np.sqrt(2) * 50e-6 / (0.7 * np.radians(30)))
    assert plant.lowered == pytest.approx(-50e-6 - plant.depth)


def test_a_platform_that_hangs_deep_enough_is_left_there():
    plant = h.hanging(table(np.array([0.0, 0.0, -600e-6])))
    assert (plant.lowered, plant.depth) == (0.0, 600e-6)


def test_masses_that_cannot_make_it_hang_are_refused():
    with pytest.raises(InputError, match="masses that shift it by 1"):
        h.hanging(table(np.array([0.0, 0.0, 900e-6])))


def test_a_demand_is_spared_to_what_masses_can_follow():
    """A rate demand K_d w of a swing at w0 has the slope K_d w w0."""
    plant = h.hanging(DEEP)
    d, zero = np.array([1e-3, 1e-3]), np.zeros(2)
    rate = np.array([0.05, 0.0])
    share = h.spared(plant, zero, d, zero, rate)
    slope = share * 1e-3 * 0.05 * plant.frequency[0]
    assert slope == pytest.approx(SPARE * plant.slew)
    assert h.spared(plant, zero, d, zero, rate * 1e-3) == 1.0


def test_the_spared_demand_is_the_same_all_through_a_swing():
    plant, d, p = h.hanging(DEEP), np.array([1e-3, 1e-3]), np.array([4e-4, 4e-4])
    w, angle = plant.frequency, np.linspace(0, np.pi, 9)
    first = np.array([1.0, 0.0])
    shares = [
        h.spared(plant, p, d, 0.1 * np.cos(x) * first, -0.1 * w[0] * np.sin(x) * first)
        for x in angle
    ]
    np.testing.assert_allclose(shares, shares[0], rtol=1e-12)


def test_the_finest_step_is_that_of_the_fine_masses():
    assert h.hanging(DEEP).step == pytest.approx(0.02 * 1e-5 / MASS)
    coarse = replace(DEEP, masses=DEEP.masses[:3])
    assert h.hanging(coarse).step == pytest.approx(0.2 * 1e-4 / MASS)
