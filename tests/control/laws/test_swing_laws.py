"""Laws that measure swings and turns, each on a few platforms of 14 kg, judged by the truth."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.laws import coarse_fine, planar_magnetic, slew_and_measure
from equipoise.maths.attitude import to_matrix
from equipoise.model.devices import MagneticField, Magnetorquer
from equipoise.model.errors import InputError
from tests.support import thorough
from tests.support.plain_loop import Truth, close, platform, wheels

FIELD = np.array([2e-5, 0, -4.5e-5])
LOW = np.array([0, 0, -110e-6])  # m, a platform that hangs, as balanced by hand
LEVEL = np.zeros(3)


def hand_balanced(**more):
    bed = replace(platform(), wheels=(), com_sd=np.array([8e-6, 8e-6, 30e-6]), **more)
    return replace(bed, body=replace(bed.body, com=LOW))


def with_coils(dipole=5.0):
    coils = tuple(
        Magnetorquer(f"coil_{n}", a, dipole) for n, a in zip("xyz", np.eye(3), strict=True)
    )
    return hand_balanced(magnetorquers=coils, magnetic_field=MagneticField(FIELD))


def truth_of(seed, **more):
    com = LOW + np.random.default_rng(100 + seed).normal(size=3) * [6e-6, 6e-6, 20e-6]
    return Truth(com, play=2e-6, seed=seed, **more)


def greatest_tilt(course):
    return max(np.degrees(np.arccos(to_matrix(q)[2, 2])) for q in course.q)


@pytest.mark.parametrize("seed", thorough.some([0, 1, 2], 1))
def test_coarse_and_fine_leaves_it_hanging_ten_micrometres_low(seed):
    course = close(coarse_fine.LAW, hand_balanced(), truth_of(seed), LEVEL, 700.0)
    assert course.finished[0].code in ("at_place", "at_place_by_turns")
    assert np.abs(course.com - [0, 0, -coarse_fine.SAFE]).max() < 0.25e-6
    assert greatest_tilt(course) < 30


def test_coarse_and_fine_needs_masses():
    with pytest.raises(InputError, match="sliding masses"):
        coarse_fine.LAW.begin(replace(hand_balanced(), masses=()), LEVEL)


def test_a_target_that_hangs_lower_is_kept():
    """Its height to 4 %: the shift from a first, short measurement determines the scale to that."""
    target = np.array([1e-6, 0, -40e-6])
    course = close(coarse_fine.LAW, hand_balanced(), truth_of(3), target, 700.0)
    assert course.com[:2] == pytest.approx(target[:2], abs=0.2e-6)
    assert course.com[2] == pytest.approx(target[2], rel=0.04)


@pytest.mark.parametrize("seed", thorough.some([0, 1], 1))
def test_planar_feedback_and_swings_reach_the_target(seed):
    """Sideways by feedback: LEVEL times FLOOR; the height by a measurement, known to ENOUGH."""
    truth = truth_of(seed, field_N=FIELD)
    course = close(planar_magnetic.LAW, with_coils(), truth, LEVEL, 1500.0)
    assert course.finished[0].code == "level_at_height"
    assert np.abs(course.com[:2]).max() < planar_magnetic.LEVEL * planar_magnetic.FLOOR
    assert abs(course.com[2]) < 3 * planar_magnetic.ENOUGH
    assert greatest_tilt(course) < 30


@pytest.mark.parametrize("seed", thorough.some([0, 1], 1))
def test_turns_to_widely_separated_attitudes_determine_all_of_r(seed):
    """Two rounds; the truth's inertia is 2 to 3 % off the nominal one."""
    com = np.random.default_rng(100 + seed).normal(size=3) * 10e-6
    bed = replace(platform(com_sd=10e-6), wheels=wheels(torque=0.02, momentum=0.4))
    course = close(slew_and_measure.LAW, bed, Truth(com, play=2e-6, seed=seed), LEVEL, 400.0)
    assert course.finished[0].code in ("at_place", "at_place_by_turns")
    assert np.abs(course.com).max() < 0.1e-6
    assert greatest_tilt(course) < 30


@pytest.mark.parametrize("seed", thorough.some([0, 1], 1))
def test_where_wheels_cannot_hold_it_the_platform_swings_first(seed):
    """40 mN m s and an offset known to 30 um: two or three swings, then the turns."""
    bed = replace(hand_balanced(), wheels=wheels(torque=0.005, momentum=0.04))
    state, params = slew_and_measure.LAW.begin(bed, LEVEL)
    assert state.round == 0
    assert params.bearable < 10e-6
    course = close(slew_and_measure.LAW, bed, truth_of(seed), LEVEL, 700.0)
    assert course.finished[0].code in ("at_place", "at_place_by_turns")
    assert np.abs(course.com).max() < 0.3e-6
    assert greatest_tilt(course) < 30


def test_turns_are_not_begun_with_wheels_that_gravity_would_fill():
    bed = replace(platform(com_sd=10e-6), wheels=wheels(torque=0.005, momentum=0.004))
    with pytest.raises(InputError, match=r"store 0\.004"):
        slew_and_measure.LAW.begin(bed, LEVEL)


def test_missing_coils_or_field_are_refused():
    for lacks in ({"magnetorquers": ()}, {"magnetic_field": None}):
        with pytest.raises(InputError, match="coils"):
            planar_magnetic.LAW.begin(replace(with_coils(), **lacks), LEVEL)


def test_masses_too_slow_for_the_feedback_are_refused():
    bed = with_coils()
    bed = replace(bed, masses=tuple(replace(m, speed=1e-5) for m in bed.masses))
    with pytest.raises(InputError, match="um/s"):
        planar_magnetic.LAW.begin(bed, LEVEL)
