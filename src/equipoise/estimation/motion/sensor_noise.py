"""Noise of the sensors as the testbed states it; of one that it lacks, what such sensors have.

Procedures take the noise of a sensor that nobody stated from its rows, before a method runs
(``procedure.sound_rows``). What stands here serves a caller who runs a method by itself.
"""

from collections.abc import Mapping
from dataclasses import replace

from equipoise.model.testbed import Testbed
from equipoise.sensors.vector_sensors import vector_sensors

CAMERA, GYRO = 1e-3, 1e-4  # rad, rad/s, one sd a row, chosen: motion capture, a MEMS gyro at rest


def camera_noise(testbed: Testbed) -> float:
    """Return one sd (rad) of a row of the camera, each axis."""
    return testbed.attitude.noise if testbed.attitude else CAMERA


def gyro_noise(testbed: Testbed) -> float:
    """Return one sd (rad/s) of a row of the gyro, each axis."""
    return testbed.gyro.noise if testbed.gyro else GYRO


def with_noise(testbed: Testbed, camera: float, gyro: float) -> Testbed:
    """Return the testbed with this noise (rad, rad/s) of those sensors that it has."""
    attitude, rate = testbed.attitude, testbed.gyro
    return replace(
        testbed,
        attitude=attitude and replace(attitude, noise=camera),
        gyro=rate and replace(rate, noise=gyro),
    )


def vector_noise(testbed: Testbed) -> dict[str, float]:
    """Return one sd (SI) of a row of each sensor of a vector, each axis, by channel."""
    return {each.channel: each.noise for each in vector_sensors(testbed)}


def with_vector_noise(testbed: Testbed, noise: Mapping[str, float]) -> Testbed:
    """Return the testbed with this noise (SI) of sensors of vectors, by channel."""
    inertial, sun, magnetic = testbed.accelerometer, testbed.sun, testbed.magnetometer
    return replace(
        testbed,
        accelerometer=inertial and replace(inertial, noise=noise["accelerometer"]),
        sun=sun and replace(sun, noise=noise.get("sun", sun.noise)),
        magnetometer=magnetic and replace(magnetic, noise=noise.get("field", magnetic.noise)),
    )
