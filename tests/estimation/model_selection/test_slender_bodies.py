"""A rod (J 1 : 87) whose masses travel smoothly between the rows, in records by MuJoCo."""

import functools

import numpy as np
import pytest

from equipoise.estimation.model_selection.reference_fit import estimate
from equipoise.estimation.output_error.trajectory import Params, explains, fit
from equipoise.model.estimate import BODY
from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass, Testbed
from tests.oracle import mujoco_bench as oracle
from tests.support import thorough

MASS, G, SPEED = 14.0, 9.81, 0.1  # kg; m/s^2; m/s
HOMES = np.array([[0.2, 0.0, 0.05], [0.0, 0.2, 0.05], [0.05, 0.05, 0.1]])
CAMERA, GYRO = AttitudeSensor(10.0, np.radians(0.1)), Gyro(10.0, 1e-4, np.radians(0.5))
COVERED = 4.0  # sd, of nine values in some dozens of records
SLIDES = tuple(
    oracle.Slide(name, 0.0312, home, axis, 80.0)
    for name, home, axis in zip("xyz", HOMES, np.eye(3), strict=True)
)


@functools.cache
def rod(seed: int):
    """Return platform, record and testbed of 60 s with a move at half of it, rows at 10 Hz."""
    rng = np.random.default_rng([35, seed])
    R = oracle.matrix(oracle.rotation(rng.normal(0, 0.01, 3)))
    com = np.array([*rng.uniform(-6e-6, 6e-6, 2), -rng.uniform(60e-6, 120e-6)])
    q = oracle.rotation(np.array([*rng.uniform(-0.09, 0.09, 2), 0.0]))
    rate = np.array([*rng.uniform(-0.012, 0.012, 2), rng.uniform(0.008, 0.015)])
    inertia = R @ np.diag([0.5 / 87, 0.5, 0.501]) @ R.T
    platform = oracle.Platform(MASS, inertia, com, SLIDES, G, q, rate)
    targets = np.array([*rng.choice([-1.0, 1.0], 2) * [0.02, 0.03], -0.04])
    start, speed = 30.0 + 0.1 * rng.random(), SPEED * rng.uniform(0.3, 1.0)
    run = oracle.simulate(platform, (oracle.Ramp(start, targets, speed),), 60.0)
    record = oracle.sensor_log(
        run, rng, CAMERA.rate, CAMERA.noise, GYRO.rate, GYRO.noise, mass_rate=10.0
    )
    masses = tuple(
        SlidingMass(s.name, s.mass, s.home, s.axis, (-0.06, 0.06), 1e-6, 1e-5, 0.0, SPEED)
        for s in SLIDES
    )
    guess = MassProperties(MASS, com + 3e-5 * rng.normal(size=3), inertia * rng.uniform(0.9, 1.1))
    testbed = Testbed(
        "rod", guess, 0.1, np.full(3, 3e-5), np.array([0.0, 0.0, 1.0]), np.radians(45.0), G,
        masses, CAMERA, GYRO,
    )  # fmt: skip
    return platform, record, testbed


@functools.cache
def estimated(seed: int):
    """Return the estimate of a record, and its errors in sd, (9,)."""
    platform, record, testbed = rod(seed)
    found = estimate(record, testbed, Params())
    J = platform.inertia_P[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    off = found.values(BODY) - np.concatenate([J, platform.com])
    return found, off / np.sqrt(np.diag(found.covariance_of(BODY)))


SEEDS = range(thorough.count(20, 2))


@pytest.mark.parametrize("seed", SEEDS)
def test_the_motion_of_a_rod_is_found(seed):
    """Its first momentum says little of its rate; a move then shows a scale that was open."""
    _, record, testbed = rod(seed)
    assert explains(fit(record, testbed, Params()))


@pytest.mark.parametrize("seed", SEEDS)
def test_a_smooth_travel_is_no_event_and_leaves_the_scale(seed):
    """Rows every 0.1 s say where masses were; how they went between is part of the model."""
    found, errors = estimated(seed)
    assert found.outcome.usable
    assert not any(29.0 < event.t < 33.0 for event in found.events)
    assert np.abs(errors).max() < COVERED
