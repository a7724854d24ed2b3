"""Noise of the sensors as the testbed states it; of one that it lacks, what such sensors have.

Procedures take the noise of a sensor that nobody stated from its rows, before a method runs
(``procedure.sound_rows``). What stands here serves a caller who runs a method by itself.
"""

from dataclasses import replace

from equipoise.model.testbed import Testbed

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
