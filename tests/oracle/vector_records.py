"""Records of platforms without a camera: gyro and sensors of vectors of an oracle run.

The accelerometer's rows are MuJoCo's own sensor; the masses move, so that the scale is known.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.model.devices import MagneticField
from equipoise.model.recording import Recording
from equipoise.model.testbed import Gyro, Testbed
from equipoise.model.vector_sensors import Accelerometer, Magnetometer, SunSensor
from tests.oracle import mujoco_bench as oracle
from tests.oracle.inertial_sensors import accelerometer, noisy, vector

RATE = 50.0  # Hz, of gyro and accelerometer
GYRO = Gyro(RATE, np.deg2rad(0.02), np.deg2rad(0.5))
PLACE, FIELD = np.array([0.08, -0.05, 0.06]), np.array([2e-5, 3e-6, -4e-5])
ACCELEROMETER = Accelerometer(RATE, 0.02, 0.1, PLACE)
SUN = SunSensor(5.0, 2e-3, np.array([0.8, 0.0, 0.6]))
MAGNETOMETER = Magnetometer(10.0, 2e-7, 1e-6)
KITS = {  # which sensors beside a gyro
    "imu": ("accelerometer",),
    "sun": ("accelerometer", "sun"),
    "compass": ("accelerometer", "field"),
}


class Case(NamedTuple):
    """A platform, what it recorded, and what a laboratory knows of it."""

    platform: oracle.Platform
    recording: Recording
    testbed: Testbed


def case(seed: int, kit: str, duration: float = 120.0) -> Case:
    """Return a random platform that swings and is moved, as seen by a kit of sensors."""
    rng = np.random.default_rng([seed, 77])
    platform = oracle.random_platform(rng)
    schedule = oracle.random_schedule(rng, platform, duration)
    run = oracle.simulate(platform, schedule, duration)
    gyro_bias = rng.normal(0.0, GYRO.bias_sd, 3)
    record = oracle.sensor_log(run, rng, 5.0, 0.0, RATE, GYRO.noise, gyro_bias)
    biases = {"accelerometer": rng.normal(0.0, ACCELEROMETER.bias_sd, 3), "sun": np.zeros(3),
              "field": rng.normal(0.0, MAGNETOMETER.bias_sd, 3)}  # fmt: skip
    exact = {
        "accelerometer": lambda: accelerometer(run, RATE, PLACE, schedule),
        "sun": lambda: vector(run, SUN.rate, SUN.direction_N),
        "field": lambda: vector(run, MAGNETOMETER.rate, FIELD),
    }
    noise = {"accelerometer": ACCELEROMETER.noise, "sun": SUN.noise, "field": MAGNETOMETER.noise}
    rows = {name: noisy(exact[name](), rng, noise[name], biases[name]) for name in KITS[kit]}
    bed = oracle.testbed_for(platform, rng, gyro=GYRO)
    bed = replace(
        bed,
        accelerometer=ACCELEROMETER,
        sun=SUN if "sun" in rows else None,
        magnetometer=MAGNETOMETER if "field" in rows else None,
        magnetic_field=MagneticField(FIELD) if "field" in rows else None,
    )
    return Case(platform, replace(record, attitude=None, **rows), bed)
