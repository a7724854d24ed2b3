"""The linear guess, on a record without noise: its integrals close, so it is nearly exact."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.motion.sampled_motion import SampledMotion
from equipoise.estimation.planar.planar_layout import POSITION, SLOPE, VELOCITY
from equipoise.estimation.planar.planar_search import PlanarCase
from equipoise.estimation.planar.planar_start import (
    carried,
    first_point,
    in_plane,
    rotation_rows,
)
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.recording import Samples
from tests.oracle import mujoco_bench as oracle
from tests.oracle.planar_records import flight


def exact(made):
    """Return the record of a flight without noise and bias."""
    rows = oracle.every(made.run.run, 50.0)
    t = made.run.run.t[rows]
    return replace(
        made.recording,
        attitude=Samples(t, made.run.run.q[rows]),
        rate=Samples(t, made.run.run.rate[rows]),
        position=Samples(t, made.run.position[rows]),
    )


@pytest.fixture(scope="module")
def guess():
    """Rows are exact; what is left is that attitudes are smoothed, by some 1e-3 of a swing."""
    made = flight(5, 30.0)
    problem = PlanarCase(exact(made), made.testbed, (), (), False).problem(2)
    return made, problem.layout, first_point(problem, exact(made))


@pytest.fixture(scope="module")
def integrals():
    """The flight, its problem, its exact motion, and what positions show."""
    made = flight(5, 30.0)
    problem = PlanarCase(exact(made), made.testbed, (), (), False).problem(2)
    rows = oracle.every(made.run.run, 50.0)
    motion = SampledMotion(made.run.run.t[rows], made.run.run.q[rows], made.run.run.rate[rows])
    return made, problem, motion, in_plane(problem, exact(made), motion)


def test_the_velocity_follows_along_the_whole_record(integrals):
    made, _, _, plane = integrals
    true = made.run.velocity[oracle.every(made.run.run, 50.0)]
    assert np.ptp(true, axis=0).max() > 1e-3  # m/s
    assert np.abs(plane.velocity - true).max() < 1e-3


def test_the_momentum_about_p_closes_with_the_true_body(integrals):
    """It leaves less than half of what it leaves without the motion of the sled."""
    made, problem, motion, plane = integrals
    rows, known = rotation_rows(problem, exact(made), motion, plane)
    J, com = pack_symmetric(made.platform.inertia_P), made.platform.com

    def left(by_com):
        side = (known - rows[:, :6] @ J - by_com @ com).reshape(-1, 3)
        return np.sqrt(np.mean((side - side.mean(axis=0)) ** 2))

    v, pull = np.column_stack([plane.velocity, np.zeros(len(motion.t))]), np.zeros(3)
    pull[:2] = made.testbed.gravity * made.floor.slope
    unit = np.broadcast_to(np.eye(3), (len(motion.t), 3, 3))
    moved = made.platform.mass * carried(motion, v, pull, unit).reshape(-1, 3)
    assert left(rows[:, 6:9]) < 0.5 * left(rows[:, 6:9] - moved)


def test_first_moment_and_inertia_are_found(guess):
    made, layout, point = guess
    com = point.values[layout.of(*COM)]
    assert com == pytest.approx(made.platform.com, rel=0.02, abs=2e-5)
    J = pack_symmetric(made.platform.inertia_P)
    assert point.values[layout.of(*INERTIA)] == pytest.approx(J, rel=0.05, abs=0.02 * J[0])


def test_slope_and_motion_in_the_plane_are_found(guess):
    made, layout, point = guess
    assert point.values[layout.of(*SLOPE)] == pytest.approx(made.floor.slope, abs=2e-7)
    assert point.values[layout.of(*POSITION)] == pytest.approx(made.floor.position, abs=1e-4)
    velocity = point.values[layout.of(*VELOCITY)]
    assert velocity == pytest.approx(made.floor.velocity, abs=1e-4)


def test_friction_on_the_path_is_found(guess):
    from equipoise.dynamics.planar.friction_map import hat_functions
    from equipoise.estimation.planar.planar_problem import grid_of

    made, layout, point = guess
    path = made.run.position[::1000]
    weights = hat_functions(grid_of(made.testbed.table, np.zeros((2, 2))), path)
    true = [made.floor.friction(*place) for place in path]
    assert weights @ point.values[layout.friction] == pytest.approx(true, rel=0.1)
