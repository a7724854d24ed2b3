"""What was recorded and no sensor of the testbed explains is said, with the key that does."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.assessment.findings.record_findings import findings
from equipoise.assessment.plausibility.unused_channels import unused_findings
from equipoise.io.testbed.presets import preset_names, read_preset
from equipoise.model.devices import CoilPair, MagneticField, Magnetorquer
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.recording import Recording, Samples
from equipoise.model.vector_sensors import Accelerometer, Magnetometer, SunSensor
from tests.oracle.corpus import corpus_record

UP = np.array([0.0, 0.0, 1.0])
ROWS = Samples(np.arange(50) * 0.1, np.tile(UP, (50, 1)))
ATTITUDE = Samples(ROWS.t, np.tile([1.0, 0.0, 0.0, 0.0], (50, 1)))
SENSORS = {
    "accelerometer": {"accelerometer": Accelerometer(10.0, 0.01, 0.2)},
    "sun": {"sun": SunSensor(10.0, 0.01, UP)},
    "field": {
        "magnetometer": Magnetometer(10.0, 1e-7, 1e-6),
        "magnetic_field": MagneticField(4e-5 * UP),
    },
}


@pytest.mark.parametrize("channel", SENSORS)
def test_a_vector_without_its_sensor_is_named_with_the_key(channel) -> None:
    """A note beside an attitude, a problem without one; with the sensor it is none."""
    bed = replace(read_preset("nanosat"), magnetorquers=(), **{k: None for k in GONE})
    recording = Recording(**{"attitude": ATTITUDE, channel: ROWS})
    (note,) = unused_findings(recording, bed)
    assert (note.kind, note.code) == ("content", Why.ROWS_UNUSED)
    assert note.reasons[0].parameters[0] == channel
    assert note.reasons[0].numbers == {"rows": 50}
    (problem,) = unused_findings(replace(recording, attitude=None), bed)
    assert problem.kind == "problem"
    assert note in findings(recording, bed)
    assert not unused_findings(recording, replace(bed, **SENSORS[channel]))
    assert not unused_findings(recording, None)


GONE = ("accelerometer", "sun", "magnetometer", "magnetic_field")


def test_a_magnetometer_serves_magnetorquers() -> None:
    """Their torque is the cross product of their dipole and the field that it measures."""
    bed = replace(read_preset("nanosat"), **{k: None for k in GONE}, magnetorquers=(COIL,))
    assert not unused_findings(Recording(attitude=ATTITUDE, field=ROWS), bed)


@pytest.mark.parametrize(("rows", "code"), [(np.linspace(0.0, 1e-5, 50), Why.FIELD_CHANGED),
                                            (np.full(50, 1e-5), None)])  # fmt: skip
def test_a_field_that_its_cage_changed_is_named(rows, code) -> None:
    """Rows of a magnetometer show the attitude only in a field that stays."""
    bed = replace(read_preset("nanosat"), magnetorquers=(), **{k: None for k in GONE})
    bed = replace(bed, **SENSORS["field"], coil_pairs=(CoilPair("x", UP, 1e-4),))
    recording = Recording(attitude=ATTITUDE, field=ROWS, device_names=("cage:x",),
                          devices=Samples(ROWS.t, rows[:, None]))  # fmt: skip
    assert [found.code for found in unused_findings(recording, bed)] == [code] * (code is not None)
    coiled = replace(bed, magnetorquers=(COIL,))
    assert not unused_findings(recording, coiled)


COIL = Magnetorquer("x", np.array([1.0, 0.0, 0.0]), 1.0)


@pytest.mark.parametrize("name", preset_names())
def test_a_camera_and_a_gyro_are_always_used(name) -> None:
    """Of a sensor that a testbed lacks the noise is taken from the rows."""
    recording = corpus_record(6).recording
    assert not unused_findings(recording, read_preset(name))
