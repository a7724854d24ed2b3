"""What mechanics promises of a platform on a table, and what MuJoCo makes of the same.

Steps of 0.05 s at 0.2 rad/s err by less than (0.01)^5 = 1e-10 of the motion each.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from equipoise.actuators.sliding_masses import com_shift, inertia_shift, mass_maps
from equipoise.dynamics.planar.friction_map import FrictionMap, friction_at, hat_functions
from equipoise.dynamics.planar.planar_motion import (
    Start,
    TableTop,
    propagate_planar,
    read_planar,
)
from equipoise.dynamics.propagation import body_of, propagate
from equipoise.dynamics.timeline import place, timeline
from equipoise.maths.attitude import difference, exponential, to_matrix
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.recording import Samples
from equipoise.model.testbed import SlidingMass
from tests.oracle import mujoco_bench as oracle
from tests.oracle import planar_bench, planar_records
from tests.support.builders import GRAVITY, INERTIA, MASS, maps, move_at

COM = np.array([2e-4, -1e-4, -3e-3])
SLED, DURATION = 5.0, 60.0
NONE = np.zeros(0)
SLIPPERY = FrictionMap(-1.0, -1.0, 2.0, 2.0, np.zeros((2, 2)))
START = Start(
    exponential(np.radians([9.0, -6.0, 40.0])),
    np.array([0.02, -0.05, 0.11]),
    np.array([-0.4, 0.1]),
    np.array([0.02, -0.01]),
)


def top(slope=(0.0, 0.0), friction=SLIPPERY, sled=SLED) -> TableTop:
    x, y = slope
    down = (GRAVITY * x, GRAVITY * y, -GRAVITY * float(np.sqrt(1 - x * x - y * y)))
    return TableTop(MASS + sled, (GRAVITY * x, GRAVITY * y), down, friction)


def line(track=None, step=0.05):
    t = np.arange(0.0, DURATION + step / 2, step)
    return timeline(t, NONE, track, 3, step)


def travel(table, track=None, start=START, com=COM):
    body = body_of(MASS, GRAVITY, INERTIA, MASS * com)
    return propagate_planar(body, table, maps(), line(track), start)


@dataclass(frozen=True)
class Sums:
    """Quantities along a motion, laboratory axes."""

    energy: np.ndarray
    kinetic: np.ndarray
    centre: np.ndarray  # of platform and sled, times their mass, in the plane
    about_vertical: np.ndarray  # angular momentum about the laboratory's origin


def sums(motion, table, displacement=None) -> Sums:
    n = len(motion.rate)
    d = np.zeros((n, 3)) if displacement is None else displacement
    R, w = to_matrix(motion.state[:, :4]), motion.rate
    mu = np.array([MASS * (COM + com_shift(maps(), MASS, each)) for each in d])
    J = np.array([unpack_symmetric(INERTIA + inertia_shift(maps(), each)) for each in d])
    v = np.column_stack([motion.velocity, np.zeros(n)])
    flow = np.einsum("nij,nj->ni", R, np.cross(w, mu))
    turning = 0.5 * np.einsum("ni,nij,nj->n", w, J, w)
    kinetic = turning + np.sum(v * flow, axis=1)
    kinetic += 0.5 * table.floating_mass * np.sum(v**2, axis=1)
    p, moment = motion.state[:, 7:9], np.einsum("nij,nj->ni", R, mu)
    potential = -moment @ np.array(table.gravity_N)
    potential -= table.floating_mass * p @ np.array(table.pull)
    L = np.einsum("nij,nj->ni", R, motion.state[:, 4:7])
    Pi = motion.state[:, 9:11]
    spun = L[:, 2] + p[:, 0] * Pi[:, 1] - p[:, 1] * Pi[:, 0]
    return Sums(kinetic + potential, kinetic, table.floating_mass * p + moment[:, :2], spun)


def test_energy_is_kept_on_a_slope_without_friction():
    table = top((2e-3, -1e-3))
    found = sums(travel(table), table)
    assert np.ptp(found.kinetic) > 1e-3  # J, it does go to and fro
    assert np.ptp(found.energy) < 1e-8 * np.ptp(found.kinetic)


@pytest.mark.parametrize("track", [None, move_at(10.0, 60.0)], ids=["fixed", "moving masses"])
def test_nothing_inside_moves_the_centre_of_all_mass_or_turns_it_about_the_vertical(track):
    """On a level table without friction there is no force in the plane: a straight line."""
    table, at = top(), line(track)
    motion = travel(table, track)
    found = sums(motion, table, at.known[:, 7:10])
    t = at.t - at.t[0]
    way = found.centre - found.centre[0]
    straight = np.outer(t / t[-1], way[-1])
    assert np.abs(way - straight).max() < 1e-7  # kg m, of some 8
    assert np.abs(motion.state[:, 7:9] - START.position).max() > 0.1  # m
    assert np.ptp(found.about_vertical) < 1e-7 * np.abs(found.about_vertical).max()


def test_a_balanced_platform_slows_down_by_friction_alone():
    """v = v0 exp(-c t / M), and p = p0 + (v0 - v) M / c."""
    c, start = 0.8, START
    table = top(friction=FrictionMap(-1.0, -1.0, 2.0, 2.0, np.full((1, 1), c)))
    motion, t = travel(table, com=np.zeros(3)), line().t
    v = np.outer(np.exp(-c * t / table.floating_mass), start.velocity)
    assert np.abs(motion.velocity - v).max() < 1e-12
    p = start.position + (start.velocity - v) * table.floating_mass / c
    assert np.abs(motion.state[:, 7:9] - p).max() < 1e-12


def test_a_balanced_platform_runs_downhill():
    """p = p0 + v0 t + g s t^2 / 2, whatever it weighs."""
    slope = np.array([3e-4, -1e-4])
    motion, t = travel(top(tuple(slope)), com=np.zeros(3)), line().t[:, None]
    p = START.position + START.velocity * t + 0.5 * GRAVITY * slope * t**2
    assert np.abs(motion.state[:, 7:9] - p).max() < 1e-12


def test_a_small_swing_is_as_quick_as_a_pendulum_on_a_cart():
    """About y: w^2 = mu g / (J - mu^2 / M), the sled giving way; 60 s hold 9 swings."""
    J, depth, M = 0.4, 5e-3, MASS + 0.5
    mu = MASS * depth
    swing = np.sqrt(mu * GRAVITY / (J - mu**2 / M))
    body = body_of(MASS, GRAVITY, np.array([J, J, J, 0, 0, 0]), np.array([0.0, 0.0, -mu]))
    small = 1e-5  # rad
    start = Start(exponential(np.array([0.0, small, 0.0])), np.zeros(3), np.zeros(2), np.zeros(2))
    still = start._replace(position=np.zeros(2))
    motion = propagate_planar(body, top(sled=0.5), maps(), line(), still)
    pitch = 2 * motion.state[:, 2]
    assert np.abs(pitch - small * np.cos(swing * line().t)).max() < 1e-4 * small


def test_on_a_sled_that_nothing_moves_it_is_a_platform_on_a_fixed_bearing():
    heavy = top(sled=1e12)
    still = START._replace(velocity=np.zeros(2))
    motion = travel(heavy, start=still)
    body = body_of(MASS, GRAVITY, INERTIA, MASS * COM)
    fixed = propagate(body, maps(), line(), START.q, START.rate)
    assert np.linalg.norm(difference(motion.state[:, :4], fixed.q), axis=1).max() < 1e-10
    assert np.abs(motion.rate - fixed.rate).max() < 1e-10


def test_states_between_nodes_are_those_of_shorter_steps():
    table, body = top((1e-4, 0.0)), body_of(MASS, GRAVITY, INERTIA, MASS * COM)
    coarse, fine = line(step=0.05), line(step=0.01)
    motion = propagate_planar(body, table, maps(), coarse, START)
    exact = propagate_planar(body, table, maps(), fine, START)
    where = place(coarse.t, fine.t)
    states, rates = read_planar(body, table, maps(), coarse, motion, *where, 0.0)
    assert np.abs(states - exact.state).max() < 1e-6  # of a swing that lasts a few seconds
    assert np.abs(rates - exact.rate).max() < 1e-6


# --- The map --------------------------------------------------------------------------------------


def test_friction_is_that_of_the_nodes_and_bilinear_between_them():
    grid = FrictionMap(-1.0, 0.0, 2.0, 1.0, np.array([[1.0, 2.0], [3.0, 8.0]]))
    assert friction_at(grid, -1.0, 0.0) == 1.0
    assert friction_at(grid, -1.0, 1.0) == 2.0
    assert friction_at(grid, 1.0, 0.0) == 3.0
    assert friction_at(grid, 0.0, 0.5) == pytest.approx(3.5)  # the mean of all four
    assert friction_at(grid, 0.0, 0.0) == pytest.approx(2.0)
    assert friction_at(grid, 5.0, 7.0) == 8.0  # goes on as at the edge


def test_hat_functions_are_the_weights_of_the_nodes_and_add_up_to_one():
    values = np.arange(9.0).reshape(3, 3) ** 2
    grid = FrictionMap(-1.0, -2.0, 1.0, 2.0, values)
    places = np.random.default_rng(1).uniform(-3, 3, (50, 2))
    weights = hat_functions(grid, places)
    assert weights.sum(axis=1) == pytest.approx(1.0)
    found = [friction_at(grid, float(x), float(y)) for x, y in places]
    assert weights @ values.ravel() == pytest.approx(np.array(found))


# --- MuJoCo ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("moves", [(), (oracle.Ramp(8.0, np.array([0.03, -0.02, 0.01])),)],
                         ids=["fixed", "moving masses"])  # fmt: skip
def test_mujoco_has_the_same_motion(moves):
    """Within 1e-6 of it after 20 s: the servos' masses are read at steps of 2 ms."""
    rng = np.random.default_rng(3)
    platform = planar_records.hanging(rng, 3e-3)
    floor = replace(planar_records.gliding(rng, platform.mass, 20.0), slope=np.array([8e-5, -5e-5]))
    run = planar_bench.simulate(platform, floor, 20.0, moves)
    true = run.run
    track = Samples(true.t, true.displacement) if moves else None
    rails = mass_maps([
        SlidingMass(s.name, s.mass, s.home, s.axis, (-0.06, 0.06), 0.0, 0.0, 0.0, 0.01)
        for s in platform.slides
    ])  # fmt: skip
    half, k = planar_records.HALF, np.arange(0, 10001, 25)
    corners = np.array([[floor.friction(x, y) for y in (-half, half)] for x in (-half, half)])
    x, y = floor.slope
    g = platform.gravity
    table = TableTop(
        platform.mass + floor.sled, (g * x, g * y), (g * x, g * y, -g * np.sqrt(1 - x * x - y * y)),
        FrictionMap(-half, -half, 2 * half, 2 * half, corners),
    )  # fmt: skip
    body = body_of(
        platform.mass, g, pack_symmetric(platform.inertia_P), platform.mass * platform.com
    )
    start = Start(platform.q, platform.rate, floor.position, floor.velocity)
    at = timeline(true.t[k], NONE, track, 3, 0.05)
    found = propagate_planar(body, table, rails, at, start)
    rows = at.attitude_node
    assert oracle.angle_between(found.state[rows, :4], true.q[k]).max() < 1e-6
    assert np.abs(found.state[rows, 7:9] - run.position[k]).max() < 1e-6
    assert np.abs(found.velocity[rows] - run.velocity[k]).max() < 2e-6
