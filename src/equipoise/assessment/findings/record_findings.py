"""What a recording holds and what is wrong with it, as findings in the order of reading."""

from equipoise.assessment.findings.channel_content import content_findings
from equipoise.assessment.findings.mass_moves import move_findings
from equipoise.assessment.findings.motion_range import motion_findings
from equipoise.assessment.findings.stop_findings import stop_findings
from equipoise.assessment.plausibility.body import body_findings
from equipoise.assessment.plausibility.gyro_range import saturation_findings
from equipoise.assessment.plausibility.rotation import rotation_findings
from equipoise.assessment.plausibility.sampling import sampling_findings
from equipoise.assessment.plausibility.unread_inputs import unread_findings
from equipoise.assessment.plausibility.unused_channels import unused_findings
from equipoise.assessment.record_checks.attitude_noise import noise_findings
from equipoise.assessment.record_checks.clock_offset import (
    ClockOffset,
    clock_offset,
    offset_findings,
)
from equipoise.assessment.record_checks.exposure_averaging import averaging_findings
from equipoise.assessment.record_checks.flagged_rows import odd_row_findings
from equipoise.assessment.record_checks.mass_flicker import flicker_findings
from equipoise.assessment.record_checks.rate_quality import rate_findings
from equipoise.assessment.record_checks.sensor_noise import unstated_findings
from equipoise.model.errors import nearest
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed


def findings(recording: Recording, testbed: Testbed | None = None) -> tuple[Finding, ...]:
    """Return all findings; a testbed adds what only it states, such as which axis is up."""
    masses = tuple(mass.name for mass in testbed.masses) if testbed else None
    devices = testbed.device_names if testbed else None
    sensors = (None, None) if testbed is None else (testbed.attitude, testbed.gyro)
    up = None if testbed is None else testbed.up
    offset = _offset(recording)
    return (
        *content_findings(recording),
        *unused_findings(recording, testbed),
        *unread_findings(recording.unread),
        *unknown_name_findings("mass", recording.mass_names, masses),
        *move_findings(recording),
        *flicker_findings(recording, testbed),
        *unknown_name_findings("device", recording.device_names, devices),
        *lamp_findings(recording, testbed),
        *motion_findings(recording.attitude, up),
        *stop_findings(recording.attitude, testbed),
        *noise_findings(recording.attitude),
        *averaging_findings(recording, sensors[0]),
        *odd_row_findings(recording),
        *rate_findings(recording.rate),
        *sampling_findings(recording.attitude, recording.rate),
        *saturation_findings(recording.rate),
        *body_findings(testbed),
        *rotation_findings(recording.attitude, recording.rate, offset),
        *offset_findings(offset, *sensors),
        *unstated_findings(recording, testbed),
        *(Finding("mended", (reason,)) for reason in (testbed.mended if testbed else ())),
        *(Finding("mended", one_reason(Why.SET_RIGHT, note)) for note in recording.notes),
    )


def _offset(recording: Recording) -> ClockOffset | None:
    attitude, rate = recording.attitude, recording.rate
    return None if attitude is None or rate is None else clock_offset(attitude, rate)


def lamp_findings(recording: Recording, testbed: Testbed | None) -> list[Finding]:
    """Return a problem for a lamp that is switched and whose warmth nothing counts."""
    power = recording.lamp
    if testbed is None or testbed.lamp is not None or recording.temperature is not None:
        return []
    is_switched = power is not None and power.varies
    return [Finding("problem", one_reason(Why.LAMP_NOT_COUNTED))] if is_switched else []


def unknown_name_findings(
    kind: str, names: tuple[str, ...], known: tuple[str, ...] | None
) -> list[Finding]:
    """Return a problem for each mass or device that is not known; None: nothing is."""
    if known is None:
        return []
    return [
        Finding("problem", one_reason(Why.NOT_IN_TESTBED, kind, name, _meant(name, known)))
        for name in names
        if name not in known
    ]


def _meant(name: str, known: tuple[str, ...]) -> str:
    return nearest(name, list(known)) if known else "it has none"
