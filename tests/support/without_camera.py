"""Platforms without a camera: a gyro, and sensors of vectors instead."""

from dataclasses import replace

import numpy as np

from equipoise.io.testbed.presets import read_preset
from equipoise.model.devices import MagneticField
from equipoise.model.testbed import Gyro, Testbed
from equipoise.model.vector_sensors import Accelerometer, Magnetometer, SunSensor

GYRO = Gyro(50.0, np.radians(0.02), np.radians(0.3))
ACCELEROMETER = Accelerometer(50.0, 0.02, 0.1, np.array([0.08, -0.05, 0.06]))
SUN = SunSensor(5.0, 2e-3, np.array([0.8, 0.0, 0.6]))
MAGNETOMETER = Magnetometer(10.0, 2e-7, 1e-6)
FIELD = MagneticField(np.array([20e-6, 3e-6, -40e-6]))
KITS = {
    "imu": {"accelerometer": ACCELEROMETER},
    "sun": {"accelerometer": ACCELEROMETER, "sun": SUN},
    "compass": {"magnetometer": MAGNETOMETER, "magnetic_field": FIELD},
}


def without_camera(kit: str) -> Testbed:
    """Return the Sputnix mock-up with a gyro and a kit of sensors instead of its camera."""
    return replace(read_preset("sputnix"), attitude=None, gyro=GYRO, hardware=None, **KITS[kit])
