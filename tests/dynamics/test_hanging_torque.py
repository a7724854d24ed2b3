"""A mass that hangs: numbers worked by hand, and torque that is the slope of its energy."""

import numpy as np
import pytest
import scipy

from equipoise.dynamics.hanging_torque import hanging_torque, sides_of, swung
from equipoise.maths.attitude import exponential, multiply, to_matrix
from equipoise.model.hanging_mass import HangingMass

UP, WEIGHT = np.array([0.0, 0.0, 1.0]), 100.0


def tilted(*turn):
    """Return the attitude of a level platform turned by a vector (rad), as a series of one."""
    return exponential(np.array(turn))[None]


def test_gravity_acts_at_the_pivot_of_a_pendulum():
    """10 deg about x, swinging to y: 100 N at 10 um above com, 1e-3 N m sin(10 deg)."""
    mass = HangingMass(1e-5, np.pi / 2, 0.0)
    found = hanging_torque(tilted(np.radians(10), 0.0, 0.0), mass, UP, WEIGHT)
    assert found[0] == pytest.approx([1e-3 * np.sin(np.radians(10)), 0.0, 0.0], abs=1e-12)


def test_across_its_plane_a_pendulum_is_a_rigid_part():
    mass = HangingMass(1e-5, np.pi / 2, 0.0)
    found = hanging_torque(tilted(0.0, np.radians(10), 0.0), mass, UP, WEIGHT)
    assert found[0] == pytest.approx([0.0, 0.0, 0.0], abs=1e-15)


@pytest.mark.parametrize("spring", [0.0, 0.4, 0.9])
def test_of_small_tilts_it_is_elastic_sag(spring):
    """1 mrad about (1, -1, 0): com moves 1e-8 m to u = (1, 1, 0) / sqrt 2."""
    mass = HangingMass(1e-5, np.pi / 4, spring)
    q = tilted(*(1e-3 * np.array([1.0, -1.0, 0.0]) / 2**0.5))
    down = -to_matrix(q)[0, 2]
    side = np.array([1.0, 1.0, 0.0]) / 2**0.5
    sag = WEIGHT * np.cross(1e-5 * (down @ side) * side, down)
    found = hanging_torque(q, mass, UP, WEIGHT)[0]
    assert np.linalg.norm(sag) == pytest.approx(1e-6, rel=1e-6)
    assert found[:2] == pytest.approx(sag[:2], rel=1e-5)


@pytest.mark.parametrize("spring", [0.0, 0.3, 0.8])
def test_it_rests_where_spring_and_gravity_leave_it(spring):
    """The least of 1/2 k theta^2 - (1 - k) s cos(theta - phi), found by a search."""
    n_u, n_d = 0.4, 0.7
    size, phi = np.hypot(n_u, n_d), np.arctan2(n_u, n_d)

    def energy(theta):
        return 0.5 * spring * theta**2 - (1 - spring) * size * np.cos(theta - phi)

    least = scipy.optimize.minimize_scalar(energy, bounds=(-1.0, 1.0), method="bounded",
                                           options={"xatol": 1e-10}).x  # fmt: skip
    assert swung(np.array([n_u]), np.array([n_d]), spring)[0] == pytest.approx(least, abs=1e-6)


def energy_of(q, mass):
    """Return the potential energy of spring and mass, at its least, less that of the mass fixed."""
    down = -to_matrix(q)[0, 2]
    x, y = sides_of(UP)
    side = np.cos(mass.heading) * x + np.sin(mass.heading) * y

    def energy(theta):
        moved = np.sin(theta) * side + (1 - np.cos(theta)) * UP
        return 0.5 * mass.spring / (1 - mass.spring) * theta**2 - moved @ down

    found = scipy.optimize.minimize_scalar(energy, bounds=(-1.5, 1.5), method="bounded",
                                           options={"xatol": 1e-12})  # fmt: skip
    return WEIGHT * mass.lever * found.fun


def test_the_torque_is_the_slope_of_the_energy():
    """-dV for a turn of 1 mrad about each body axis, at 25 deg of tilt."""
    mass, q, h = HangingMass(2e-5, 0.6, 0.25), tilted(0.3, -0.25, 0.2), 1e-3
    found = hanging_torque(q, mass, UP, WEIGHT)[0]
    for axis in np.eye(3):
        ahead, behind = (multiply(q, exponential(s * h * axis)[None]) for s in (1, -1))
        slope = (energy_of(ahead, mass) - energy_of(behind, mass)) / (2 * h)
        assert found @ axis == pytest.approx(-slope, abs=1e-9)
    assert np.linalg.norm(found) > 1e-4


def test_headings_count_from_the_first_level_axis():
    x, y = sides_of(UP)
    assert x.tolist() == [1.0, 0.0, 0.0]
    assert y.tolist() == [0.0, 1.0, 0.0]
    x, y = sides_of(np.array([1.0, 0.0, 0.0]))
    assert x.tolist() == [0.0, 1.0, 0.0]
    assert y.tolist() == [0.0, 0.0, 1.0]
