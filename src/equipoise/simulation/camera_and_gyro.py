"""What camera, gyro and sensors of vectors report, each at its own times.

Row k is stamped k / rate on the bench's clock. It is the mean over [t - delay - averaging,
t - delay], by Gauss-Legendre quadrature with five samples; without averaging there is one.

    attitude   q (x) exp(noise)      mean attitude: mean rotation vector from the middle sample
    rate       w + bias + noise
    vectors    of ``sensors.vector_sensors`` in the sensor's axes + bias + noise, no averaging

An accelerometer takes w' from the rates at its sample and 1 and 2 ms before: the parabola through
them. A mass that starts or stops thus shakes it for 2 ms.

What else is wrong with them is in ``sensor_errors``.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from equipoise.maths.attitude import difference, exponential, multiply, to_matrix
from equipoise.model.arrays import Bools, Floats, Series1, Series3, Series4, Vector3
from equipoise.model.defects import Gap
from equipoise.model.testbed import AttitudeSensor, Gyro, Truth
from equipoise.sensors.vector_sensors import VectorSensor, vectors_in_body
from equipoise.simulation.clock import samples, tick

Sensor = AttitudeSensor | Gyro | VectorSensor

NODES = 0.5 + 0.5 * np.polynomial.legendre.leggauss(5)[0]  # of the window, 0 to 1
WEIGHTS = 0.5 * np.polynomial.legendre.leggauss(5)[1]
MOMENT = 1e-3  # s, chosen: a motion of 3 rad/s bends within it by 3e-6 of w'
SLOPE = np.array([1.5, -2.0, 0.5]) / MOMENT  # of a parabola, by its values at 0, -1 and -2 moments


def lead(sensor: Sensor | None) -> float:
    """Return how long before its stamp (s) the earliest sample of a row may be."""
    if isinstance(sensor, VectorSensor):
        return sensor.delay + (2 * MOMENT if sensor.place.any() else 0.0)
    return 0.0 if sensor is None else sensor.delay + sensor.averaging


def sampled_at(sensor: Sensor, t: Series1) -> Floats:
    """Return the times of the samples of rows stamped ``t``, (n, 1), (n, 3) or (n, 5) s."""
    if isinstance(sensor, VectorSensor):
        moments = np.arange(3 if sensor.place.any() else 1)
        return tick(t[:, None] - sensor.delay - MOMENT * moments)
    if sensor.averaging == 0:
        return tick(t - sensor.delay)[:, None]
    return tick(t[:, None] - sensor.delay - sensor.averaging * (1.0 - NODES))


def samples_between(sensor: Sensor | None, after: float, until: float) -> Series1:
    """Return the times of all samples in (after, until] s, also of rows not yet stamped."""
    if sensor is None:
        return np.zeros(0)
    t = sampled_at(
        sensor, samples(sensor.rate, after, until + lead(sensor) + 1 / sensor.rate)
    ).ravel()
    return t[(t > after) & (t <= until)]


def outside(t: Series1, gaps: Sequence[Gap]) -> Bools:
    """Say which rows stamped ``t`` are not missing."""
    kept = np.ones(len(t), dtype=np.bool_)
    for gap in gaps:
        kept &= (t < gap.start) | (t > gap.end)
    return kept


def camera_rows(q: Floats, sensor: AttitudeSensor, rng: np.random.Generator) -> Series4:
    """Return measured attitudes from those at the samples, (n, 1 or 5, 4)."""
    mean = q[:, 0]
    if q.shape[1] > 1:
        middle = q[:, q.shape[1] // 2]
        turned = difference(q, middle[:, None, :])
        mean = multiply(middle, exponential(np.einsum("j,njk->nk", WEIGHTS, turned)))
    return multiply(mean, exponential(sensor.noise * rng.standard_normal((len(q), 3))))


def gyro_rows(w: Floats, sensor: Gyro, bias: Vector3, rng: np.random.Generator) -> Series3:
    """Return measured rates from those at the samples, (n, 1 or 5, 3) rad/s."""
    mean = w[:, 0] if w.shape[1] == 1 else np.einsum("j,njk->nk", WEIGHTS, w)
    return mean + bias + sensor.noise * rng.standard_normal((len(w), 3))


class VectorErrors(NamedTuple):
    """What a sensor of a vector gets wrong beside noise."""

    bias: Vector3  # SI
    mounting: Vector3  # rad, rotation vector from body axes to the sensor's


def errors_of(channel: str, truth: Truth) -> VectorErrors:
    """Return what a sensor of the bench is off by."""
    return {
        "accelerometer": VectorErrors(truth.accelerometer_bias, truth.accelerometer_mounting),
        "sun": VectorErrors(np.zeros(3), truth.sun_mounting),
        "field": VectorErrors(truth.magnetometer_bias, truth.magnetometer_mounting),
    }[channel]


def exact_vectors(q: Floats, w: Floats, sensor: VectorSensor) -> Series3:
    """Return exact vectors by attitudes (n, 1 or 3, 4) and rates (n, 1 or 3, 3) at the samples."""
    still = np.zeros_like(w[:, 0])
    change = np.einsum("j,njk->nk", SLOPE, w) if w.shape[1] == len(SLOPE) else still
    return vectors_in_body(sensor, q[:, 0], w[:, 0], change)


def vector_rows(
    q: Floats, w: Floats, sensor: VectorSensor, off: VectorErrors, rng: np.random.Generator
) -> Series3:
    """Return measured vectors from attitudes (n, 1 or 3, 4) and rates (n, 1 or 3, 3) at samples."""
    vectors = exact_vectors(q, w, sensor) @ to_matrix(exponential(off.mounting))
    return vectors + off.bias + sensor.noise * rng.standard_normal(vectors.shape)
