"""Whether residuals are white and as large as the stated noise: histogram and autocorrelation."""

from collections.abc import Iterator

import numpy as np

from equipoise.app.charts.of_fit import Residuals
from equipoise.app.charts.rows import rows_of
from equipoise.app.figures.base.style import AXES
from equipoise.app.text.charts import Chart, Panel
from equipoise.maths.whiteness import FEWEST
from equipoise.procedure.identification.fitted_motion import ResidualSeries

WIDEST = 5.0  # sd on either side of the histogram, chosen: beyond it is an outlier
BINS = 41  # chosen: a quarter of an sd each
HISTOGRAM = (
    "Histogram of the residuals in units of the stated noise, as a density. Line: white noise as "
    "stated. Residuals beyond 5 standard deviations are outside the axis."
)
CORRELATION = (
    "Autocorrelation of the residuals by axis. Grey band: 95 % of white noise lies inside it. A "
    "wave means that the model leaves a motion unexplained."
)


def of_residuals(left: Residuals) -> Iterator[Chart]:
    """Yield histogram and autocorrelation of both sensors; nothing for too few rows."""
    sensors = [
        (f"{name} residual", series)
        for name, series in zip(("camera", "gyro"), left, strict=True)
        if series is not None and len(series.rows) >= FEWEST
    ]
    histograms = tuple(
        histogram_panel(title, series, series.noise)
        for title, series in sensors
        if series.noise is not None
    )
    if histograms:
        yield Chart("residual_histogram", HISTOGRAM, histograms, "residual", "sd")
    if sensors:
        panels = tuple(correlation_panel(title, series) for title, series in sensors)
        yield Chart("residual_autocorrelation", CORRELATION, panels, "lag", "rows")


def histogram_panel(title: str, left: ResidualSeries, noise: float) -> Panel:
    """Return the density of residuals over ``noise`` (SI), and that of the normal distribution."""
    edges = np.linspace(-WIDEST, WIDEST, BINS + 1)
    middle, width = (edges[:-1] + edges[1:]) / 2, edges[1] - edges[0]
    counts = np.array([np.histogram(column / noise, edges)[0] for column in left.rows.values.T])
    density = counts.T / (len(left.rows) * width)
    normal = np.exp(-(middle**2) / 2) / np.sqrt(2 * np.pi)
    bars = rows_of(AXES, middle, density, 1.0, "bars")
    stated = rows_of(("stated noise",), middle, normal[:, None], 1.0)
    return Panel(title, "", (bars, stated))


def correlation_panel(title: str, left: ResidualSeries) -> Panel:
    """Return the autocorrelation of each axis, and the limits of white noise."""
    lags = np.arange(1.0, len(left.correlation) + 1.0)
    rows = rows_of(AXES, lags, left.correlation, 1.0, "stems")
    return Panel(title, "", (rows,), left.white)
