"""The truth of torque by cause closes: what is left of the balance is what masses do."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from tests.oracle import mujoco_bench as oracle
from tests.oracle.mujoco_torque import (
    WatchedBench,
    down,
    gusts,
    impulses,
    inertia_at,
    read_at,
    torque_of,
)
from verification import keep
from verification.torque_on_mujoco import AIR, LASTS

CLOSE = 2e-8  # N m: a hundredth of the air
GIVING = 3e-4  # of the total: servos of the masses give way, which changes the inertia by as much


def momentum_of_masses(run):
    """Return what masses hold beside the body as it was at first, N m s: dJ w, and their travel."""
    platform, first = run.platform, inertia_at(run.platform, run.displacement[0])
    found = []
    for d, v, w in zip(run.displacement, run.velocity, run.rate, strict=True):
        travel = sum(s.mass * speed * np.cross(s.home, s.axis)
                     for s, speed in zip(platform.slides, v, strict=True))  # fmt: skip
        found.append((inertia_at(platform, d) - first) @ w + travel)
    return np.array(found)


def test_what_is_left_of_the_balance_is_weight_and_reaction_of_masses():
    rng = np.random.default_rng(3)
    platform = oracle.random_platform(rng, mass=14.0)
    t = oracle.middles(10.0, 2e-3)
    air = gusts(rng, t, AIR, LASTS)
    wanted = oracle.command(platform, oracle.random_schedule(rng, platform, 10.0, 1), t)
    run = oracle.driven(platform, wanted, air, 2e-3, in_body=True)
    edges = np.arange(11.0)
    shift = (run.displacement - run.displacement[0]) * platform.slide_mass @ platform.slide_axes
    held = momentum_of_masses(run)
    direct = impulses(run.t, np.cross(shift, down(platform, run.q)), edges)
    direct -= np.diff(read_at(run.t, held, edges), axis=0)
    direct -= impulses(run.t, np.cross(run.rate, held), edges)
    moves = torque_of(run, air, edges)["moves"]
    assert np.sqrt(np.mean(direct**2)) > 1e3 * CLOSE
    assert np.sqrt(np.mean((moves - direct) ** 2)) < CLOSE


def test_nothing_is_left_where_wheels_work_and_masses_stand():
    """Gravity, drift, a lamp and air close the balance of a body whose rotors turn."""
    testbed, platform, around = keep.drawn(3)
    bench = WatchedBench(testbed, platform, replace(around, lamp=((1.0, 3.0),)), 3)
    bench.blow(AIR, LASTS)
    bench.read(2.0)  # in which the servos of the masses take up their weight
    bench.begin()
    bench.read(5.5)
    found = bench.torque_by_cause(bench.kept_from + np.arange(6.0))
    for name in ("gravity", "drift", "warmth", "air"):
        assert np.abs(found[name]).max() > CLOSE
    assert np.abs(found["moves"]).max() < GIVING * np.abs(found["total"]).max()
