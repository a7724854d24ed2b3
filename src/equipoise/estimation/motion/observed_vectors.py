"""The sensors of vectors of which a record has rows, and which of their errors are to be sought."""

from equipoise.model import sensor_terms
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.vector_sensors import VectorSensor, vector_sensors

EXACT = -1


def observed(recording: Recording, testbed: Testbed) -> list[tuple[VectorSensor, Samples]]:
    """Return the sensors of vectors of which there are rows, each with its rows."""
    rows = [(each, getattr(recording, each.channel)) for each in vector_sensors(testbed)]
    return [(each, channel) for each, channel in rows if channel is not None and len(channel)]


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
