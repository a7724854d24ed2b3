"""The motion of a fit beside what was measured, and what the fit leaves of it, as charts."""

from collections.abc import Iterator

import numpy as np

from equipoise.app.charts.rows import rows_of
from equipoise.app.figures.base.strokes import travel_times
from equipoise.app.figures.base.style import AXES, BAND
from equipoise.app.figures.estimate import rates
from equipoise.app.figures.estimate.attitude_fit import nearest_sign
from equipoise.app.text.charts import Chart, Panel
from equipoise.maths.attitude import continuous
from equipoise.model.arrays import Series4
from equipoise.model.recording import Recording, Samples
from equipoise.model.units import DEG
from equipoise.procedure.identification.fitted_motion import FittedMotion, ResidualSeries
from equipoise.procedure.identification.record_courses import FitMotions

QUATERNION = ("q0", "q1", "q2", "q3")
ATTITUDE = (
    "Attitude quaternion (body to laboratory, scalar first), camera (dots) and model (lines), "
    "predicted with the testbed's values and fitted. Grey: masses move."
)
RESIDUAL = (
    "{} residuals (measured minus fitted) about each {} axis. Grey band: two standard deviations "
    "of the stated noise; grey strips: masses move."
)
GYRO_COUNTS = " Bias, scale errors and misalignment are removed as estimated."
Residuals = tuple[ResidualSeries | None, ResidualSeries | None]  # of camera and gyro


def of_fit(recording: Recording, motions: FitMotions, record: str) -> Iterator[Chart]:
    """Yield attitude, rate and the residuals of both sensors along a record."""
    shaded, fitted = shaded_times(recording), motions.fitted
    if recording.attitude is not None and fitted.attitude is not None:
        panels = attitude_panels(recording.attitude, motions.before.q, fitted.attitude)
        yield Chart("figure06_attitude", ATTITUDE, panels, record=record, shaded=shaded)
    panel = rate_panel(fitted)
    yield Chart("figure08_rate", rates.caption(fitted), (panel,), record=record, shaded=shaded)
    yield from of_residual_rows(recording, residuals_of_fit(motions), record)


def residuals_of_fit(motions: FitMotions) -> Residuals:
    """Return what a fit leaves of camera and gyro."""
    return motions.fitted.camera_residual, motions.fitted.gyro_residual


def of_residual_rows(recording: Recording, left: Residuals, record: str) -> Iterator[Chart]:
    """Yield the residuals of camera and gyro along a record."""
    shaded, (camera, gyro) = shaded_times(recording), left
    if camera is not None:
        panel = residual_panel("camera residual", "deg", camera)
        yield Chart("figure07_residual", RESIDUAL.format("Attitude", "body"), (panel,),
                    record=record, shaded=shaded)  # fmt: skip
    if gyro is not None:
        panel = residual_panel("gyro residual", "deg/s", gyro)
        yield Chart("gyro_residual", RESIDUAL.format("Gyro", "gyro") + GYRO_COUNTS, (panel,),
                    record=record, shaded=shaded)  # fmt: skip


def shaded_times(recording: Recording) -> tuple[tuple[float, float], ...]:
    """Return when masses move, s, within the span of the sensors."""
    start, end = recording.span
    return tuple((a, b) for a, b in travel_times(recording.masses) if start <= b and a <= end)


def attitude_panels(measured: Samples, before: Series4, fitted: Samples) -> tuple[Panel, ...]:
    """Return the quaternion before and after the fit, each with the camera's rows."""
    q = continuous(measured.values)
    camera = rows_of([f"camera {name}" for name in QUATERNION], measured.t, q, 1.0, "dots")

    def panel(title: str, model: Samples) -> Panel:
        at = np.searchsorted(measured.t, model.t).clip(max=len(measured) - 1)
        near = nearest_sign(model.values, q[at])
        lines = rows_of([f"model {name}" for name in QUATERNION], model.t, near, 1.0)
        return Panel(title, "", (camera, lines))

    return (
        panel("attitude before estimation", Samples(measured.t, before)),
        panel("attitude after estimation", fitted),
    )


def rate_panel(fitted: FittedMotion) -> Panel:
    """Return the rate of the fit, and that of a gyro without what was found wrong with it."""
    model = rows_of([f"model {axis}" for axis in AXES], fitted.rate.t, fitted.rate.values, DEG)
    if fitted.gyro is None:
        return Panel("angular velocity", "deg/s", (model,))
    names = [f"gyro {axis}" for axis in AXES]
    gyro = rows_of(names, fitted.gyro.t, fitted.gyro.values, DEG, "dots")
    return Panel("angular velocity", "deg/s", (gyro, model))


def residual_panel(title: str, unit: str, left: ResidualSeries) -> Panel:
    """Return residuals about three axes, and the stated noise as a band."""
    band = None if left.noise is None else BAND * left.noise / DEG
    rows = rows_of(AXES, left.rows.t, left.rows.values, DEG, "dots")
    return Panel(title, unit, (rows,), band)
