"""What sensors see of a vector of the laboratory.

    y = M^T ( R^T v_N + w' x p + w x (w x p) ) + b    R: body to laboratory;  p: place, from P

M = exp(m) turns the sensor's axes into those of the body; m is small, and sought.

    accelerometer   v_N = g e_z      specific force: at rest g upwards; b sought
    sun sensor      v_N = s_N        unit vector to a lamp; p = 0, b = 0
    magnetometer    v_N = B_N        magnetic field, of a cage as at the start; p = 0, b sought

An accelerometer that is not at P feels how the platform turns; the others do not.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Floats, Series3, Series4, Vector3
from equipoise.model.testbed import Testbed
from equipoise.model.vector_sensors import Accelerometer, Magnetometer, SunSensor

CHANNELS = ("accelerometer", "sun", "field")


@dataclass(frozen=True, slots=True, eq=False)
class VectorSensor:
    """A sensor of the testbed and the vector that it sees."""

    channel: str  # of the recording
    rate: float  # Hz
    noise: float  # SI, one sd per axis and sample
    bias_sd: float  # SI; 0: it has no bias
    delay: float  # s
    vector_N: Floats  # (3,) SI, laboratory axes; of the simulated bench also (n, 3), row by row
    place: Vector3  # m, from P; zeros where it makes no difference
    mounting_sd: float = 0.0  # rad, of each component of m


def vector_sensors(testbed: Testbed) -> tuple[VectorSensor, ...]:
    """Return the sensors of vectors that a testbed has, in the order of ``CHANNELS``."""
    inertial, sun, magnetic = testbed.accelerometer, testbed.sun, testbed.magnetometer
    field_N, found, centre = testbed.field_N(), list[VectorSensor](), np.zeros(3)
    if inertial is not None:
        up, place = np.array([0.0, 0.0, testbed.gravity]), inertial.place
        found.append(_vector_sensor("accelerometer", inertial, inertial.bias_sd, up, place))
    direction_N = sun_direction(testbed)
    if sun is not None and direction_N is not None:
        found.append(_vector_sensor("sun", sun, 0.0, direction_N, centre))
    if magnetic is not None and field_N is not None:
        found.append(_vector_sensor("field", magnetic, magnetic.bias_sd, field_N, centre))
    return tuple(found)


def sun_direction(testbed: Testbed) -> Vector3 | None:
    """Return where the lamp of a sun sensor stands, a unit vector in laboratory axes."""
    sun, lamp = testbed.sun, testbed.lamp
    if sun is not None and sun.direction_N is not None:
        return sun.direction_N
    return None if lamp is None else lamp.direction_N


def _vector_sensor(
    channel: str,
    sensor: Accelerometer | SunSensor | Magnetometer,
    bias_sd: float,
    vector_N: Floats,
    place: Vector3,
) -> VectorSensor:
    return VectorSensor(channel, sensor.rate, sensor.noise, bias_sd, sensor.delay, vector_N, place,
                        sensor.mounting_sd)  # fmt: skip


def vectors_in_body(sensor: VectorSensor, q: Series4, w: Series3, change: Series3) -> Series3:
    """Return what a sensor without bias and noise sees, (n, 3) SI, in body axes.

    At attitudes q, rates w (rad/s) and ``change`` of the rates w' (rad/s^2).
    """
    turning = np.cross(change, sensor.place) + np.cross(w, np.cross(w, sensor.place))
    turned: Series3 = np.einsum("...i,...ij->...j", sensor.vector_N, to_matrix(q))
    return turned + turning
