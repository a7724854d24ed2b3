"""Sensors as their rows show them: noise with rounding in it, and what a testbed leaves out.

Rounding to steps of d adds an error of d / sqrt(12) to each row, white when the noise or the motion
from row to row is half a step and more (Widrow and Kollar 2008).

Cannot show noise below a step: rows then show that of the rounding alone. Rounded roll, pitch and
yaw count as rounded about the body axes, which they are near level.
"""

import math
from dataclasses import replace

from equipoise.assessment.record_checks.attitude_noise import attitude_noise
from equipoise.assessment.record_checks.rate_quality import rate_noise, step_of
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed

ROUNDED = math.sqrt(12)  # a step over the sd of its rounding
USUAL = math.radians(0.2)  # rad, of a camera that has too few rows to show it (chosen)
EXACT = 1e-7  # rad, rad/s: least noise taken for a sensor (chosen: rows that were computed)
BIAS = math.radians(1.0)  # rad/s, sd: usual for a low-cost gyro, as in a testbed file


def shown_camera(rows: Samples | None, stated: AttitudeSensor | None) -> AttitudeSensor | None:
    """Return the camera with its rounding in its noise; as the rows show it if none is stated."""
    if rows is None or len(rows) < 2:
        return stated
    if stated is None:
        noise = attitude_noise(rows)
        return AttitudeSensor(1.0 / rows.period, max(USUAL if noise is None else noise, EXACT))
    return replace(stated, noise=math.hypot(stated.noise, stated.quantum / ROUNDED))


def shown_gyro(rows: Samples | None, stated: Gyro | None) -> Gyro | None:
    """Return the gyro with its rounding in its noise; as the rows show it if none is stated."""
    if rows is None or len(rows) < 4:
        return stated
    step = max([step_of(axis) or 0.0 for axis in rows.values.T])
    if stated is None:
        noise = max(rate_noise(rows), step / ROUNDED, EXACT)
        return Gyro(1.0 / rows.period, noise, BIAS)
    return replace(stated, noise=math.hypot(stated.noise, max(step, stated.quantum) / ROUNDED))


def unstated_findings(recording: Recording, testbed: Testbed | None) -> list[Finding]:
    """Say which sensors the testbed does not have, and what noise they are given."""
    if testbed is None:
        return []
    found: list[Finding] = []
    camera = shown_camera(recording.attitude, None)
    if testbed.attitude is None and camera is not None:
        found.append(_taken("attitude", camera.noise, "deg"))
    gyro = shown_gyro(recording.rate, None)
    if testbed.gyro is None and gyro is not None:
        found.append(_taken("gyro", gyro.noise, "deg/s"))
    return found


def _taken(name: str, noise: float, unit: str) -> Finding:
    return Finding("mended", one_reason(Why.NOISE_ASSUMED, name, unit, noise=noise))
