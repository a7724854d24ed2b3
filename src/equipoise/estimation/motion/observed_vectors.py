"""The sensors of vectors of which a record has rows, and which of them have a bias to be sought."""

from equipoise.model import sensor_terms
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.vector_sensors import VectorSensor, vector_sensors

NO_BIAS = -1


def observed(recording: Recording, testbed: Testbed) -> list[tuple[VectorSensor, Samples]]:
    """Return the sensors of vectors of which there are rows, each with its rows."""
    rows = [(each, getattr(recording, each.channel)) for each in vector_sensors(testbed)]
    return [(each, channel) for each, channel in rows if channel is not None and len(channel)]


def bias_terms(recording: Recording, testbed: Testbed) -> tuple[str, ...]:
    """Return the names of the biases that are sought beside a record."""
    sensors = [each for each, _ in observed(recording, testbed) if each.bias_sd > 0]
    return tuple(term for each in sensors for term in sensor_terms.BIASES[each.channel])


def bias_at(sensor: VectorSensor) -> int:
    """Return where the coefficients of all sensors have a sensor's bias."""
    terms = sensor_terms.BIASES.get(sensor.channel)
    return NO_BIAS if terms is None else sensor_terms.TERMS.index(terms[0])
