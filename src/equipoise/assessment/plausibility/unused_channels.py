"""Whether a testbed makes use of what was recorded: a vector's rows need a sensor that explains it.

And a magnetometer's rows a field that stays as it is, where it is no coils' torque that they tell.

Rows of a camera or a gyro that the testbed lacks are used (``record_checks.sensor_noise``), masses
and devices that it lacks are refused. What is measured of a vector says nothing without the sensor.
"""

from equipoise.actuators.stored_momentum import changes_field
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.sensors.vector_sensors import CHANNELS, vector_sensors

KEYS = {
    "accelerometer": "[sensor.accelerometer]",
    "sun": "[sensor.sun]",
    "field": "[sensor.magnetometer] and [magnetic_field] or [[coil_pair]]",
}


def unused_findings(recording: Recording, testbed: Testbed | None) -> list[Finding]:
    """Return the vectors that were recorded and that no sensor of the testbed explains.

    Without an attitude an estimate lacks what they show; beside one they are a check that is lost.
    """
    if testbed is None:
        return []
    explained = {sensor.channel for sensor in vector_sensors(testbed)}
    unused = dict.fromkeys(CHANNELS, Why.ROWS_UNUSED)
    unused |= dict.fromkeys(explained & {"field"}, Why.FIELD_CHANGED)
    used = explained - ({"field"} if changes_field(recording, testbed) else set())
    if testbed.magnetorquers:
        used.add("field")  # their torque is what they have of it
    kind = "problem" if recording.attitude is None else "content"
    return [
        Finding(kind, one_reason(unused[channel], channel, KEYS[channel], rows=len(rows)))
        for channel in CHANNELS
        if channel not in used and (rows := getattr(recording, channel)) is not None and len(rows)
    ]
