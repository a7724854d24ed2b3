"""Masses on rails against point masses put together."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.actuators.sliding_masses import (
    com_shift,
    com_shift_covariance,
    inertia_shift,
    mass_maps,
)
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.mass_properties import parallel_axis
from tests.support.builders import MASS, SKEW, maps, rail, sliding_masses

THREE = sliding_masses()
along = st.floats(-0.05, 0.05)
displacements = arrays(np.float64, 3, elements=along)


def as_points(masses, d):
    """Return first moment and inertia about P of the masses as points at their places."""
    first_moment, inertia = np.zeros(3), np.zeros((3, 3))
    for mass, way in zip(masses, d, strict=True):
        place = mass.home + way * mass.axis
        first_moment = first_moment + mass.mass * place
        inertia = inertia + parallel_axis(mass.mass, place)
    return first_moment, inertia


def test_one_mass_by_hand():
    """1 kg from (0, 0.2, 0) by 0.1 m along z: J_xx 0.04 -> 0.05, J_yy 0 -> 0.01, J_yz -0.02."""
    one = mass_maps([rail(1.0, [0.0, 0.2, 0.0], [0.0, 0.0, 1.0])])
    d = np.array([0.1])
    np.testing.assert_allclose(inertia_shift(one, d), [0.01, 0.01, 0, 0, 0, -0.02], atol=1e-17)
    np.testing.assert_allclose(com_shift(one, 10.0, d), [0, 0, 0.01])
    np.testing.assert_allclose(one.momentum, [[0.2, 0.0, 0.0]])  # y x z = x


@pytest.mark.parametrize("masses", [THREE, SKEW])
@given(d=displacements)
def test_shifts_are_those_of_point_masses(masses, d):
    """J and com after minus before, from point masses at their places (rounding of 1e-3 kg m2)."""
    (moment_before, before), (moment_after, after) = as_points(masses, 0 * d), as_points(masses, d)
    change = unpack_symmetric(inertia_shift(mass_maps(masses), d))
    np.testing.assert_allclose(change, after - before, atol=1e-16)
    moved = com_shift(mass_maps(masses), MASS, d) * MASS
    np.testing.assert_allclose(moved, moment_after - moment_before, atol=1e-16)


@pytest.mark.parametrize("masses", [THREE, SKEW])
@given(d=displacements, speed=displacements)
def test_momentum_is_that_of_moving_points(masses, d, speed):
    """sum m r x dr/dt by central differences; r is linear in time, so only rounding is left."""
    step = 1e-3

    def place(mass, way):
        return mass.home + way * mass.axis

    by_points = np.zeros(3)
    for mass, x, v in zip(masses, d, speed, strict=True):
        velocity = (place(mass, x + v * step) - place(mass, x - v * step)) / (2 * step)
        by_points += mass.mass * np.cross(place(mass, x), velocity)
    np.testing.assert_allclose(speed @ mass_maps(masses).momentum, by_points, atol=1e-14)


def test_uncertainty_of_a_move_by_hand():
    """Only masses that move add: 15.6 g stopping within 1/3 mm spread 14.24 kg by 0.365 um."""
    accuracy, moved = np.full(3, 1e-3 / 3), np.array([1.0, 0.0, 1.0])
    found = com_shift_covariance(maps(), MASS, accuracy, moved)
    sd = 0.0156 / MASS * 1e-3 / 3
    np.testing.assert_allclose(found, np.diag([sd**2, 0.0, sd**2]), atol=1e-22)


def test_uncertainty_of_a_move_on_skew_rails():
    """The spread of 200 000 drawn stops; 4 sd of a variance are 1.3 %, of the largest entry."""
    rng, sd = np.random.default_rng(2), np.array([1e-4, 3e-4, 2e-4])
    drawn = sd * rng.normal(size=(200_000, 3))
    cloud = drawn @ mass_maps(SKEW).first_moment / MASS
    found = com_shift_covariance(mass_maps(SKEW), MASS, sd, np.ones(3))
    np.testing.assert_allclose(found, np.cov(cloud.T), rtol=0, atol=0.013 * found.max())


def test_a_mass_that_goes_further_than_reported_shifts_as_one_reported_there():
    """Gain 1.25 on 8 mm is 10 mm."""
    plain = sliding_masses()
    wide = tuple(replace(mass, gain=1.25) for mass in plain)
    d = np.array([8e-3, -4e-3, 12e-3])
    found = inertia_shift(mass_maps(wide), d)
    np.testing.assert_allclose(found, inertia_shift(mass_maps(plain), 1.25 * d), rtol=1e-12)
