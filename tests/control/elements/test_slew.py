"""Turns from rest to rest, and what wheels and gyros can give."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.elements.slew import Pace, end_of, levelled, reference_at, slew
from equipoise.control.plant.wheel_capacity import capacity
from equipoise.maths.attitude import conjugate, exponential, logarithm, multiply, tilt
from equipoise.model.devices import ControlMomentGyro
from tests.support.plain_loop import platform, wheels

START = exponential(np.array([0.1, 0.2, -0.4]))
GOAL = exponential(np.array([-0.3, 0.1, 0.5]))
PACE = Pace(0.05, 0.02)


def test_a_turn_leads_from_rest_at_its_start_to_rest_at_its_goal():
    turn = slew(START, GOAL, 3.0, PACE)
    first, last = reference_at(turn, 3.0), reference_at(turn, end_of(turn) + 1.0)
    assert first.q == pytest.approx(START)
    assert np.linalg.norm(logarithm(multiply(conjugate(last.q), GOAL))) < 1e-9
    for at in (first, last):
        assert np.all(at.rate == 0)
        assert np.all(at.acceleration == 0)


def test_rate_and_acceleration_are_the_derivatives_of_the_attitude():
    turn, dt = slew(START, GOAL, 0.0, PACE), 1e-4
    for t in (2.0, 0.4 * turn.duration, 0.9 * turn.duration):
        before, now, after = (reference_at(turn, t + s) for s in (-dt, 0.0, dt))
        rate = logarithm(multiply(conjugate(before.q), after.q)) / (2 * dt)
        assert now.rate == pytest.approx(rate, rel=1e-4, abs=1e-9)
        assert now.acceleration == pytest.approx((after.rate - before.rate) / (2 * dt), rel=1e-4)


@pytest.mark.parametrize("pace", [Pace(0.05, 1.0), Pace(1.0, 0.003)])
def test_the_tighter_limit_is_just_reached(pace):
    turn = slew(START, GOAL, 0.0, pace)
    course = [reference_at(turn, t) for t in np.linspace(0, turn.duration, 2001)]
    rate = max(np.linalg.norm(at.rate) for at in course) / pace.rate
    acceleration = max(np.linalg.norm(at.acceleration) for at in course) / pace.acceleration
    assert max(rate, acceleration) == pytest.approx(1.0, rel=1e-5)


def test_levelling_keeps_to_the_shortest_turn():
    up = np.array([0.0, 0.6, 0.8])
    q = exponential(np.array([0.3, -0.5, 1.0]))
    level = levelled(q, up)
    assert tilt(level, up) < 1e-7
    assert np.linalg.norm(logarithm(multiply(conjugate(q), level))) == pytest.approx(tilt(q, up))


def test_three_crossed_wheels_give_one_wheels_worth_in_every_direction():
    can = capacity(replace(platform(), wheels=wheels(5e-3, 0.04)))
    assert can.torque == pytest.approx(5e-3, rel=2e-3)
    assert can.momentum == pytest.approx(0.04, rel=2e-3)


def test_two_wheels_give_nothing_along_the_third_axis():
    assert capacity(replace(platform(), wheels=wheels()[:2])) == (0.0, 0.0)


def test_gyros_in_a_pyramid_push_along_all_axes():
    """Four gyros, skew 54.74 deg: along z each gives sin(skew), 4 x 0.816 = 3.27 of one."""
    skew, k = np.arccos(1 / 3**0.5), np.arange(4) * np.pi / 2
    gyros = tuple(
        ControlMomentGyro(
            f"gyro_{i}",
            np.array([np.sin(skew) * np.cos(a), np.sin(skew) * np.sin(a), np.cos(skew)]),
            np.array([-np.sin(a), np.cos(a), 0.0]), 0.5, 1.0,
        )
        for i, a in enumerate(k)
    )  # fmt: skip
    can = capacity(replace(platform(), wheels=(), cmgs=gyros))
    # along x: two of them, cos(skew) each
    assert can.torque == pytest.approx(0.5 * 2 * np.cos(skew), rel=5e-3)
    assert can.momentum > 1.5 * 0.5
