"""The choice of a cone: what its loop really does, what devices allow, how long it takes."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.elements import cone_plan
from equipoise.control.elements.cone_plan import cone_at, cone_for, decay, spare
from equipoise.control.plant.wheel_capacity import capacity
from equipoise.model.devices import ControlMomentGyro
from equipoise.model.errors import InputError
from tests.support.ideal_bench import platform, wheels

PERIOD = 0.1


def bed(**changes):
    return platform(**({"com_sd": 1e-4, "wheels": wheels()} | changes))


def slope(t, x, case):
    """Of e and m g x / w_a in body axes, gravity going round: e' = -K e - m [g x] x, and x'."""
    angle, speed, w, zeta = case
    n = np.array([np.sin(angle) * np.cos(speed * t), np.sin(angle) * np.sin(speed * t),
                  -np.cos(angle)])  # fmt: skip
    e, y = x[:3], x[3:]
    return np.concatenate([-2 * zeta * w * e - w * np.cross(n, y), -w * np.cross(n, e)])


def left_after(case, turns):
    """|x| after whole turns of a fifth of them settling first: runge-kutta in body axes."""
    t, x, h = 0.0, np.array([0.0, 0, 0, 0, 0, 1.0]), 2 * np.pi / case[1] / 200
    sizes = []
    for _ in range(turns * 200):
        a = slope(t, x, case)
        b = slope(t + h / 2, x + h / 2 * a, case)
        c = slope(t + h / 2, x + h / 2 * b, case)
        x = x + h / 6 * (a + 2 * b + 2 * c + slope(t + h, x + h * c, case))
        t += h
        sizes.append(np.linalg.norm(x[3:]))
    return sizes[turns * 200 // 2 - 1], sizes[-1]


@pytest.mark.parametrize("case", [(0.15, 0.3, 0.33, 0.4), (0.3, 0.2, 0.22, 0.4),
                                  (0.2, 0.3, 0.6, 1.0), (0.1, 0.5, 0.5, 0.5)])  # fmt: skip
def test_an_offset_along_up_fades_at_the_rate_of_the_slowest_mode(case):
    turns = 12
    middle, end = left_after(case, turns)
    time = turns / 2 * 2 * np.pi / case[1]
    assert np.log(middle / end) / time == pytest.approx(decay(*case), rel=0.02)


def test_small_cones_fade_by_the_printed_formula_and_fastest_at_resonance():
    """sin^2 A W / (2 zeta) at w_a = W; with w_a = 2 W and zeta = 1, 0.64 W sin^2 A, by hand."""
    square = np.sin(0.02) ** 2
    assert decay(0.02, 0.3, 0.3, 0.4) == pytest.approx(square * 0.3 / 0.8, rel=5e-3)
    assert decay(0.02, 0.3, 0.6, 1.0) == pytest.approx(square * 0.64 * 0.3, rel=5e-3)
    assert decay(0.0, 0.3, 0.3, 0.4) == pytest.approx(0.0, abs=1e-12)


def test_the_cone_is_what_momentum_torque_and_tilt_leave():
    """By hand: likely 283 um aside, 200 um high; 137.34 N, 0.29 kg m^2, 30 deg.

    w_a = sqrt(137.34 / 0.29 * 282.8e-6 / 0.2618) = 0.7153 rad/s; W of a hundredth of J and 4 um:
    sqrt(4e-6 * 137.34 / 0.0029) = 0.4352 rad/s.
    """
    rich = cone_for(bed(), PERIOD)
    assert rich.speed == pytest.approx(0.4352, rel=1e-3)
    assert rich.frequency == pytest.approx(0.7153, rel=1e-3)
    assert rich.angle == pytest.approx(0.6 * np.radians(30))
    few = bed(wheels=wheels(momentum=0.12))
    have = spare(few).momentum
    assert have == pytest.approx(0.8 * 0.12, rel=0.03)
    # Momentum: 137.34 * 282.8e-6 * 0.8 / 0.7153 = 0.04344; round the cone, at 0.3 rad/s,
    # 0.29 * 0.3 + 137.34 * 200e-6 / 0.3 = 0.1786.
    narrow = cone_at(few, 0.3, 0.7153)
    assert narrow.angle == pytest.approx((have - 0.04344) / 0.1786, rel=2e-3)
    weak = bed(com_sd=2e-5, wheels=wheels(torque=0.008))
    # 40 um high: 0.29 * 0.09 + 137.34 * 40e-6 = 0.03159
    assert cone_at(weak, 0.3, 0.4).angle == pytest.approx(spare(weak).torque / 0.03159,
                                                                  rel=2e-3)  # fmt: skip


def test_turning_wheels_have_less_to_give():
    turning = tuple(replace(w, speed=w.max_speed / 3) for w in wheels(momentum=0.12))
    with pytest.raises(InputError, match="cone of 0 deg"):
        cone_for(bed(wheels=turning), PERIOD)


def test_weak_wheels_choose_a_slower_and_wider_cone():
    """The fastest would do in more time: of its neighbours none takes less."""
    weak = bed(com_sd=1e-5, wheels=wheels(torque=0.005))
    chosen = cone_for(weak, PERIOD)
    least = cone_plan.least_frequency(weak)
    fastest = cone_at(weak, cone_plan.greatest_speed(weak), least)
    assert chosen.speed < 0.8 * fastest.speed
    assert chosen.angle > 1.2 * fastest.angle
    for share in (0.7, 1.4):
        assert cone_at(weak, share * chosen.speed, least).expected > chosen.expected


def test_the_expected_time_by_hand():
    """Opening 1.375 turns, ln(100 um / 0.8 um) fadings, 1.5 turns, ln(18 / 0.5) / (0.3 w_a)."""
    cone = cone_for(bed(), PERIOD)
    turn = 2 * np.pi / cone.speed
    by_hand = 2.875 * turn + 4.8283 / cone.decay + 3.5835 / (0.3 * cone.frequency)
    assert cone.expected == pytest.approx(by_hand, rel=1e-3)


def test_masses_that_are_slow_to_the_target_leave_a_height_to_hold_up():
    """1 mm low, 10 um/s, 31.4 s a turn: 686 um are left then, and twice 100 um are not known."""
    low = bed(com=(0.0, 0.0, -1e-3))
    slow = replace(low, masses=tuple(replace(m, speed=2.8e-5) for m in low.masses))
    assert cone_plan.unmet_height(low, 0.2) == pytest.approx(2e-4)
    assert cone_plan.unmet_height(slow, 0.2) == pytest.approx(686e-6 + 2e-4, rel=2e-3)


def test_gyros_count_for_half():
    """Four on a pyramid have momentum in every direction; singular directions take some."""
    gyros = tuple(
        ControlMomentGyro(
            f"g{k}", np.array([0.8 * c, 0.8 * s, 0.6]), np.array([-s, c, 0.0]), 0.5, 1.0
        )
        for k, (c, s) in enumerate([(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)])
    )
    have = spare(bed(wheels=(), cmgs=gyros))
    most = capacity(bed(wheels=(), cmgs=gyros))
    assert have.momentum == pytest.approx(0.4 * most.momentum)
    assert have.torque == pytest.approx(0.4 * most.torque)
    assert cone_for(bed(wheels=(), cmgs=gyros), PERIOD)


def test_a_wrong_inertia_leaves_a_height_with_the_square_of_the_speed():
    """A hundredth of 0.29 kg m^2 at 0.3 rad/s: 2.9e-3 * 0.09 / 137.34 = 1.90 um."""
    assert cone_plan.height_of_inertia(bed(), 0.3) == pytest.approx(1.900e-6, rel=1e-3)
    fastest = cone_plan.greatest_speed(bed())
    assert cone_plan.height_of_inertia(bed(), fastest) == pytest.approx(cone_plan.BIAS)
