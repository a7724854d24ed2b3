"""Rows of an accelerometer of the simulated bench against MuJoCo's own sensor."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import Gyro, Testbed, Truth
from equipoise.model.vector_sensors import Accelerometer, SunSensor
from equipoise.simulation.bench import SimulatedBench
from tests.oracle import cases, inertial_sensors
from tests.oracle import mujoco_bench as oracle
from tests.oracle.test_two_benches import angles

SECONDS, PLACE, LAMP = 20.0, np.array([0.21, -0.13, 0.08]), np.array([0.6, 0.0, 0.8])
LOW = -2e-3 * np.array([0.0, 0.0, 1.0])  # m: 1 rad/s of swing, so that w' p is load


def spinning():
    """Return a platform that swings fast and spins at 1 rad/s."""
    platform = replace(cases.case_s(1).case.platform, slides=())
    return replace(platform, com=platform.com + LOW, rate=np.array([0.3, -0.2, 1.0]))


def simulated(platform):
    """Return what a bench made of the same platform records, without noise."""
    body, none = MassProperties(platform.mass, platform.com, platform.inertia_P), np.zeros(3)
    truth = Truth(
        platform.com, none, none, platform.inertia_P, 0.0, angles(platform.q), 0.0, platform.rate,
        0.0, {}, 0.0, 30.0, none,
    )  # fmt: skip
    up = np.array([0.0, 0.0, 1.0])
    sensors = {
        "gyro": Gyro(50.0, 0.0, 0.0),
        "accelerometer": Accelerometer(100.0, 0.0, 0.0, PLACE),
        "sun": SunSensor(5.0, 0.0, LAMP),
    }
    bed = Testbed("twin", body, 0.1, none, up, np.pi, platform.gravity, (), truth=truth, **sensors)
    return SimulatedBench(bed, 0).read(SECONDS)


def test_both_accelerometers_give_the_same():
    """Within 1e-5 m/s^2, of 0.3 m/s^2 that turning adds to gravity."""
    platform = spinning()
    run, twin = oracle.simulate(platform, (), SECONDS), simulated(platform)
    load = inertial_sensors.accelerometer(run, 100.0, PLACE)
    np.testing.assert_allclose(twin.accelerometer.t, load.t, atol=1e-12)
    np.testing.assert_allclose(twin.accelerometer.values, load.values, atol=1e-5)
    at_centre = inertial_sensors.specific_force(run, np.zeros(3), oracle.every(run, 100.0))
    assert np.abs(load.values - at_centre).max() > 0.2


def test_both_sun_sensors_point_at_the_lamp():
    platform = spinning()
    run, twin = oracle.simulate(platform, (), SECONDS), simulated(platform)
    given = inertial_sensors.vector(run, 5.0, LAMP)
    np.testing.assert_allclose(twin.sun.t, given.t, atol=1e-12)
    np.testing.assert_allclose(twin.sun.values, given.values, atol=2e-6)
    np.testing.assert_allclose(np.linalg.norm(twin.sun.values, axis=1), 1.0, atol=1e-12)
