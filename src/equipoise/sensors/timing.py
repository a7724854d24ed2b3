"""When a sensor's row was measured: the middle of its averaging, before its delay."""

from equipoise.model.arrays import Series1
from equipoise.model.testbed import AttitudeSensor, Gyro


def measured_at(t: Series1, sensor: AttitudeSensor | Gyro | None) -> Series1:
    """Return the moments (s) that rows stamped ``t`` stand for."""
    return t if sensor is None else t - sensor.delay - 0.5 * sensor.averaging


def lateness(sensor: AttitudeSensor | Gyro | None) -> float:
    """Return how long (s) a row's stamp is after the moment that the row stands for."""
    return 0.0 if sensor is None else sensor.delay + 0.5 * sensor.averaging


def spread_of(sensor: AttitudeSensor | Gyro | None) -> float:
    """Return the variance (s^2) of the moments that a row is the mean of: T^2 / 12."""
    return 0.0 if sensor is None else sensor.averaging**2 / 12.0
