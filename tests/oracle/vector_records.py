"""Records of platforms without a camera: gyro and sensors of vectors of an oracle run.

The accelerometer's rows are MuJoCo's own sensor; the masses move, so that the scale is known. They
depart at any moment between two rows of their log, and travel at constant speed, so that what a
fit takes for unknown is.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.model.devices import MagneticField
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Gyro, Testbed
from equipoise.model.vector_sensors import Accelerometer, Magnetometer, SunSensor
from tests.oracle import mujoco_bench as oracle
from tests.oracle.defects import Array
from tests.oracle.inertial_sensors import accelerometer, noisy, vector


class Kit(NamedTuple):
    """What a platform measures with."""

    gyro: Gyro
    accelerometer: Accelerometer
    sun: SunSensor | None = None
    magnetometer: Magnetometer | None = None


PLACE, FIELD = np.array([0.08, -0.05, 0.06]), np.array([2e-5, 3e-6, -4e-5])
MASS_RATE = 50.0  # Hz
LAMP = np.array([0.8, 0.0, 0.6])
FINE = Kit(Gyro(50.0, np.deg2rad(0.02), np.deg2rad(0.5)), Accelerometer(50.0, 0.02, 0.1, PLACE))
ASKEW = np.deg2rad(0.5)  # of the axes of a sensor
# 0.05 deg/s and 400 ug/sqrt(Hz) through a filter of 44 Hz; offsets of 2 deg/s and 50 mg.
MPU6050 = Kit(Gyro(100.0, np.deg2rad(0.05), np.deg2rad(2.0)),
              Accelerometer(100.0, 0.033, 0.5, PLACE, mounting_sd=ASKEW))  # fmt: skip
# Lee et al.: rates of variance 1e-7 (rad/s)^2, directions of 0.1 deg at 10 Hz.
LEE = Kit(Gyro(100.0, np.sqrt(1e-7), np.deg2rad(0.5)),
          Accelerometer(10.0, 0.017, 0.05, PLACE, mounting_sd=ASKEW),
          SunSensor(10.0, 1.75e-3, LAMP, mounting_sd=ASKEW))  # fmt: skip
KITS = {
    "imu": FINE,
    "sun": FINE._replace(sun=SunSensor(5.0, 2e-3, LAMP)),
    "compass": FINE._replace(magnetometer=Magnetometer(10.0, 2e-7, 1e-6)),
}


class Case(NamedTuple):
    """A platform, what it recorded, and what a laboratory knows of it."""

    platform: oracle.Platform
    recording: Recording
    testbed: Testbed
    errors: dict[str, Array]  # coefficients of each sensor, by the names that a fit gives them, SI


def movable(
    rng: np.random.Generator, duration: float
) -> tuple[oracle.Platform, tuple[oracle.Ramp, ...]]:
    """Return a random platform and its moves."""
    platform, schedule = oracle.movable_platform(rng, duration)
    late = rng.uniform(0.0, 1 / MASS_RATE, len(schedule))
    moves = [replace(ramp, start=ramp.start + by, even=True)
             for ramp, by in zip(schedule, late, strict=True)]  # fmt: skip
    return platform, tuple(moves)


def true_errors(kit: Kit, rng: np.random.Generator) -> dict[str, Array]:
    """Return what each sensor of a kit is off by, drawn as stated."""
    sd = {"gyro_bias": kit.gyro.bias_sd, "accelerometer_bias": kit.accelerometer.bias_sd}
    sd["accelerometer_mounting"] = kit.accelerometer.mounting_sd
    if kit.sun is not None:
        sd["sun_mounting"] = kit.sun.mounting_sd
    if kit.magnetometer is not None:
        sd["field_bias"] = kit.magnetometer.bias_sd
    return {name: rng.normal(0.0, each, 3) for name, each in sd.items()}


def off(rows: Samples, rng: np.random.Generator, noise: float, **errors: Array) -> Samples:
    """Return rows in the axes of a sensor, with its bias and noise."""
    axes = oracle.rotation(errors.get("mounting", np.zeros(3)))
    turned = Samples(rows.t, rows.values @ oracle.matrix(axes))
    return noisy(turned, rng, noise, errors.get("bias", np.zeros(3)))


def vector_rows(
    kit: Kit,
    run: oracle.OracleRun,
    schedule: tuple[oracle.Ramp, ...],
    rng: np.random.Generator,
    errors: dict[str, Array],
) -> dict[str, Samples]:
    """Return the channels of a kit's sensors of vectors."""
    force, found = accelerometer(run, kit.accelerometer.rate, PLACE, schedule), {}
    bias, mounting = errors["accelerometer_bias"], errors["accelerometer_mounting"]
    found["accelerometer"] = off(force, rng, kit.accelerometer.noise, bias=bias, mounting=mounting)
    if kit.sun is not None:
        ideal = vector(run, kit.sun.rate, kit.sun.direction_N)
        found["sun"] = off(ideal, rng, kit.sun.noise, mounting=errors["sun_mounting"])
    if kit.magnetometer is not None:
        ideal = vector(run, kit.magnetometer.rate, FIELD)
        found["field"] = off(ideal, rng, kit.magnetometer.noise, bias=errors["field_bias"])
    return found


def case(seed: int, kit: Kit, duration: float = 120.0) -> Case:
    """Return a random platform that swings and is moved, as seen by a kit of sensors."""
    rng = np.random.default_rng([seed, 77])
    platform, schedule = movable(rng, duration)
    run = oracle.simulate(platform, schedule, duration)
    errors = true_errors(kit, rng)
    record = oracle.sensor_log(
        run, rng, 5.0, 0.0, kit.gyro.rate, kit.gyro.noise, errors["gyro_bias"], MASS_RATE
    )
    bed = replace(
        oracle.testbed_for(platform, rng, gyro=kit.gyro),
        accelerometer=kit.accelerometer,
        sun=kit.sun,
        magnetometer=kit.magnetometer,
        magnetic_field=MagneticField(FIELD) if kit.magnetometer is not None else None,
    )
    rows = vector_rows(kit, run, schedule, rng, errors)
    return Case(platform, replace(record, attitude=None, **rows), bed, errors)
