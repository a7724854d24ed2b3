"""The parameter-adaptive law: its turns, its end, where it is refused, and what it leaves."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.laws import parameter_adaptive
from equipoise.control.laws.parameter_adaptive import LAW, ROUNDS
from equipoise.maths.attitude import to_matrix
from equipoise.model.errors import InputError
from tests.support import thorough
from tests.support.plain_loop import INERTIA, Truth, close, platform, wheels

LEVEL = np.zeros(3)
LOW = np.array([0, 0, -110e-6])  # m, as balanced by hand


def bed(**more):
    made = replace(platform(), com_sd=np.array([8e-6, 8e-6, 30e-6]), **more)
    return replace(made, body=replace(made.body, com=LOW))


def greatest_tilt(course):
    return max(np.degrees(np.arccos(to_matrix(q)[2, 2])) for q in course.q)


@pytest.mark.parametrize("seed", thorough.some([0, 1, 2, 3], 1))
def test_masses_end_where_the_centre_of_mass_is_at_the_target(seed):
    """A stiff platform, off by 6, 6 and 20 um of one sd; its inertia 2 to 3 % off: 0.5 um."""
    com = LOW + np.random.default_rng(200 + seed).normal(size=3) * [6e-6, 6e-6, 20e-6]
    truth = Truth(com, play=1e-6, seed=seed)
    course = close(LAW, bed(), truth, LEVEL, 600.0)
    assert course.finished[0].code == "at_place_by_turns"
    assert np.abs(course.com).max() < 0.5e-6
    assert greatest_tilt(course) < 25
    assert np.linalg.norm(course.h, axis=-1).max() < 0.04


def test_it_makes_three_turns_a_round_and_comes_back_to_level():
    _, params = LAW.begin(bed(), LEVEL)
    assert len(params.turns) == 3 * ROUNDS + 1
    np.testing.assert_array_equal(params.turns[-1], parameter_adaptive.LEVEL)
    lean = [np.degrees(np.arccos(to_matrix(q)[2, 2])) for q in params.turns[:3]]
    np.testing.assert_allclose(lean, 21.0, atol=0.1)


@pytest.mark.parametrize(
    ("more", "wanted"),
    [
        ({"wheels": ()}, "wheels or gyros along all axes"),
        ({"masses": ()}, "sliding masses"),
        ({"gyro": None}, "a gyro"),
    ],
)
def test_what_it_needs_is_named(more, wanted):
    with pytest.raises(InputError, match=wanted):
        LAW.begin(bed(**more), LEVEL)


def test_wheels_that_an_offset_fills_before_masses_meet_it_are_refused():
    """16 um of 14 kg are 2.2 mN m: for 10 s, 22 mN m s."""
    LAW.begin(bed(wheels=wheels(torque=0.005, momentum=0.04)), LEVEL)
    with pytest.raises(InputError, match="a coarse balance first"):
        LAW.begin(bed(wheels=wheels(torque=0.005, momentum=0.004)), LEVEL)
    with pytest.raises(InputError, match="a coarse balance first"):
        LAW.begin(bed(wheels=wheels(torque=0.0005, momentum=0.4)), LEVEL)


def test_the_inertia_is_adapted_to_what_the_turns_show_of_it():
    """Stated 5 % off: about up it is found to 1 %, across it within 3 of the sd that it states."""
    stated = replace(bed(), inertia_sd=0.05)
    wrong = replace(stated.body, inertia_P=INERTIA * [1.05, 0.95, 1.05])
    truth = Truth(LOW + [5e-6, -5e-6, 10e-6], inertia=INERTIA, seed=5)
    course = close(LAW, replace(stated, body=wrong), truth, LEVEL, 250.0)
    found = course.states[-1].way.adapted
    off = found.p[:3] - np.diag(INERTIA)
    sd = np.sqrt(np.diag(found.P)[:3])
    assert abs(off[2]) < 0.01 * INERTIA[2, 2]
    assert np.all(np.abs(off) < 3 * sd)
    assert np.all(sd < 0.05 * np.diag(INERTIA))
