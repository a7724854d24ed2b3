"""The linear guess, on a record without noise: its integrals close, so it is nearly exact."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.planar.planar_layout import POSITION, SLOPE, VELOCITY
from equipoise.estimation.planar.planar_search import PlanarCase
from equipoise.estimation.planar.planar_start import first_point
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.recording import Samples
from tests.oracle import mujoco_bench as oracle
from tests.oracle.planar_records import flight


@pytest.fixture(scope="module")
def guess():
    """Rows are exact; what is left is that attitudes are smoothed, by some 1e-3 of a swing."""
    made = flight(5, 30.0)
    rows = oracle.every(made.run.run, 50.0)
    t = made.run.run.t[rows]
    exact = replace(
        made.recording,
        attitude=Samples(t, made.run.run.q[rows]),
        rate=Samples(t, made.run.run.rate[rows]),
        position=Samples(t, made.run.position[rows]),
    )
    problem = PlanarCase(exact, made.testbed, (), (), False).problem(2)
    return made, problem.layout, first_point(problem, exact)


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
