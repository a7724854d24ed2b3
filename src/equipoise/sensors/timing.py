"""When a sensor's row really looked: the middle of its averaging, before its delay."""

from equipoise.model.arrays import Series1
from equipoise.model.testbed import AttitudeSensor, Gyro


def seen_at(t: Series1, sensor: AttitudeSensor | Gyro | None) -> Series1:
    """Return the moments (s) that rows stamped ``t`` stand for."""
    return t if sensor is None else t - sensor.delay - 0.5 * sensor.averaging
