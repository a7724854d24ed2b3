"""The sensors of vectors of which a record has rows, and which of their errors are to be sought."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from equipoise.actuators.stored_momentum import cage_at, changes_field
from equipoise.model import sensor_terms
from equipoise.model.arrays import Floats
from equipoise.model.devices import CoilPair
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.vector_sensors import VectorSensor, vector_sensors

EXACT = -1


def observed(recording: Recording, testbed: Testbed) -> list[tuple[VectorSensor, Samples]]:
    """Return the sensors of vectors of which there are rows, each with its rows."""
    sensors = [each for each in vector_sensors(testbed)
               if each.channel != "field" or not changes_field(recording, testbed)]  # fmt: skip
    rows = [(in_field(each, recording, testbed), getattr(recording, each.channel))
            for each in sensors]  # fmt: skip
    return [(each, channel) for each, channel in rows if channel is not None and len(channel)]


def in_field(sensor: VectorSensor, recording: Recording, testbed: Testbed) -> VectorSensor:
    """Return a sensor of a vector, a magnetometer in the field that the cage reported.

    What the cage is off by is the same in all n rows: as noise of a row it counts sqrt(n) times,
    so that their mean is no better than the field is known.
    """
    rows, measured = recording.devices, recording.field
    cage = None if rows is None else cage_at(rows.t, recording, testbed)
    if sensor.channel != "field" or cage is None or measured is None:
        return sensor
    fields = cage.mean(axis=0)
    common = doubt_of_field(testbed.coil_pairs, fields) * len(measured) ** 0.5
    field_N = testbed.field_N(fields)
    assert field_N is not None
    return replace(sensor, vector_N=field_N, noise=float(np.hypot(sensor.noise, common)))


def doubt_of_field(pairs: Sequence[CoilPair], fields: Floats) -> float:
    """Return one sd (T, each axis) of a cage's field at fields (k,) T of its pairs.

    Gain, two directions across, and a uniform deviation within the working volume, over three axes.
    """
    shares = [p.gain_sd**2 + 2 * p.mounting_sd**2 + p.nonuniformity**2 / 3 for p in pairs]
    return float(np.sqrt(np.sum(np.array(shares) * fields**2) / 3))


def errors_of_vectors(recording: Recording, testbed: Testbed) -> tuple[str, ...]:
    """Return the names of the biases and mountings that are sought beside a record."""
    sought = [(each.channel, each.bias_sd, each.mounting_sd)
              for each, _ in observed(recording, testbed)]  # fmt: skip
    biases = [sensor_terms.BIASES[channel] for channel, sd, _ in sought if sd > 0]
    mountings = [sensor_terms.MOUNTINGS[channel] for channel, _, sd in sought if sd > 0]
    return tuple(term for terms in (*biases, *mountings) for term in terms)


def bias_at(sensor: VectorSensor) -> int:
    """Return where the coefficients of all sensors have a sensor's bias; -1: it has none."""
    terms = sensor_terms.BIASES[sensor.channel] if sensor.bias_sd > 0 else ()
    return sensor_terms.TERMS.index(terms[0]) if terms else EXACT


def mounting_at(sensor: VectorSensor) -> int:
    """Return where the coefficients of all sensors have a sensor's mounting; -1: it is exact."""
    terms = sensor_terms.MOUNTINGS[sensor.channel] if sensor.mounting_sd > 0 else ()
    return sensor_terms.TERMS.index(terms[0]) if terms else EXACT
