"""The motion of a fit beside what was measured, and what the fit leaves of it, as charts."""

from collections.abc import Iterator

import numpy as np

from equipoise.app.charts.rows import rows_of
from equipoise.app.figures.base.strokes import travel_times
from equipoise.app.figures.base.style import AXES, BAND
from equipoise.app.figures.estimate import attitude_fit, attitude_residual, rates
from equipoise.app.figures.estimate.attitude_fit import nearest_sign
from equipoise.app.text.charts import Chart, Panel, Rows
from equipoise.maths.attitude import continuous
from equipoise.model.arrays import Series
from equipoise.model.estimate import Residual
from equipoise.model.predicted_motion import PredictedMotion
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.model.units import DEG
from equipoise.procedure.identification.record_courses import FitMotions

QUATERNION = ("q0", "q1", "q2", "q3")
GYRO_RESIDUAL = (
    "Gyro residuals (measured minus estimated) about each gyro axis, deg/s. The estimate includes "
    "the gyro's bias and, where it was estimated, its alignment. Grey band: two standard "
    "deviations of the stated noise; grey strips: masses move."
)


def of_fit(
    recording: Recording,
    testbed: Testbed,
    residual: Residual | None,
    motions: FitMotions,
    record: str,
) -> Iterator[Chart]:
    """Yield attitude, rate and the residuals of both sensors along a record."""
    shaded = shaded_times(recording)
    if recording.attitude is not None:
        panels = attitude_panels(recording.attitude, motions)
        yield Chart("figure06_attitude", attitude_fit.CAPTION, panels, record=record, shaded=shaded)
    gyro = None if residual is None else residual.rate
    panel = rate_panel(recording.rate, gyro, motions.after)
    yield Chart("figure08_rate", rates.CAPTION, (panel,), record=record, shaded=shaded)
    yield from residuals_of(recording, testbed, residual, record)


def residuals_of(
    recording: Recording, testbed: Testbed, residual: Residual | None, record: str
) -> Iterator[Chart]:
    """Yield the residuals of camera and gyro along a record."""
    if residual is None:
        return
    shaded = shaded_times(recording)
    sensors = (
        ("figure07_residual", attitude_residual.CAPTION, "camera residual", "deg",
         residual.attitude, testbed.attitude),
        ("gyro_residual", GYRO_RESIDUAL, "gyro residual", "deg/s", residual.rate, testbed.gyro),
    )  # fmt: skip
    for name, caption, title, unit, left, sensor in sensors:
        if left is not None and len(left):
            panel = residual_panel(title, unit, left, None if sensor is None else sensor.noise)
            yield Chart(name, caption, (panel,), record=record, shaded=shaded)


def shaded_times(recording: Recording) -> tuple[tuple[float, float], ...]:
    """Return when masses move, s, within the span of the sensors."""
    start, end = recording.span
    return tuple((a, b) for a, b in travel_times(recording.masses) if start <= b and a <= end)


def attitude_panels(measured: Samples, motions: FitMotions) -> tuple[Panel, ...]:
    """Return the quaternion before and after the fit, each with the camera's rows."""
    q = continuous(measured.values)
    camera = rows_of([f"camera {name}" for name in QUATERNION], measured.t, q, 1.0, "dots")

    def panel(title: str, motion: PredictedMotion) -> Panel:
        model = nearest_sign(motion.q, q)
        lines = rows_of([f"model {name}" for name in QUATERNION], motion.t, model, 1.0)
        return Panel(title, "", (camera, lines))

    return (
        panel("attitude before estimation", motions.before),
        panel("attitude after estimation", motions.after),
    )


def rate_panel(measured: Samples | None, left: Samples | None, after: PredictedMotion) -> Panel:
    """Return the rate of the model, and with a gyro what that should have measured, and did."""
    model = rows_of([f"model {axis}" for axis in AXES], after.t, after.rate, DEG)
    if measured is None:
        return Panel("angular velocity", "deg/s", (model,))
    gyro = rows_of([f"gyro {axis}" for axis in AXES], measured.t, measured.values, DEG, "dots")
    if left is None:
        return Panel("angular velocity", "deg/s", (gyro, model))
    said = predicted_readings(measured, left)
    model = rows_of([f"model {axis}" for axis in AXES], left.t, said, DEG)
    return Panel("angular velocity as the gyro measures it, bias included", "deg/s", (gyro, model))


def predicted_readings(measured: Samples, left: Samples) -> Series:
    """Return what the model says of the rows that were fitted: measured less residual."""
    fitted = measured.values[np.searchsorted(measured.t, left.t)]
    return fitted - left.values


def residual_panel(title: str, unit: str, left: Samples, noise: float | None) -> Panel:
    """Return residuals about three axes, and the stated noise as a band."""
    band = None if noise is None else BAND * noise / DEG
    return Panel(title, unit, (residual_rows(left),), band)


def residual_rows(left: Samples) -> Rows:
    """Return residuals as dots."""
    return rows_of(AXES, left.t, left.values, DEG, "dots")
