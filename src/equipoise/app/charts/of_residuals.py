"""Whether residuals are white and as large as the stated noise: histogram and autocorrelation."""

from collections.abc import Iterator

import numpy as np

from equipoise.app.charts.rows import rows_of
from equipoise.app.figures.base.style import AXES
from equipoise.app.text.charts import Chart, Panel
from equipoise.maths.sampled.long_run import correlations
from equipoise.maths.whiteness import FEWEST
from equipoise.model.estimate import NORMAL_95, Residual
from equipoise.model.recording import Samples
from equipoise.model.testbed import Testbed

WIDEST = 5.0  # sd on either side of the histogram, chosen: beyond it is an outlier
BINS = 41  # chosen: a quarter of an sd each
LAGS = 50  # rows, chosen: enough for the swing of a platform to show
HISTOGRAM = (
    "Histogram of the residuals in units of the stated noise, as a density. Line: white noise as "
    "stated. Residuals beyond 5 standard deviations are outside the axis."
)
CORRELATION = (
    "Autocorrelation of the residuals by axis. Grey band: 95 % of white noise lies inside it. A "
    "wave means that the model leaves a motion unexplained."
)


def of_residuals(residual: Residual | None, testbed: Testbed) -> Iterator[Chart]:
    """Yield histogram and autocorrelation of both sensors; nothing for too few rows."""
    sensors = list(_sensors(residual, testbed))
    if not sensors:
        return
    histograms = tuple(histogram_panel(name, left, noise) for name, left, noise in sensors if noise)
    if histograms:
        yield Chart("residual_histogram", HISTOGRAM, histograms, "residual", "sd")
    panels = tuple(correlation_panel(name, left) for name, left, _ in sensors)
    yield Chart("residual_autocorrelation", CORRELATION, panels, "lag", "rows")


def _sensors(
    residual: Residual | None, testbed: Testbed
) -> Iterator[tuple[str, Samples, float | None]]:
    if residual is None:
        return
    both = (("camera", residual.attitude, testbed.attitude), ("gyro", residual.rate, testbed.gyro))
    for name, left, sensor in both:
        if left is not None and len(left) >= FEWEST:
            yield name, left, None if sensor is None else sensor.noise


def histogram_panel(name: str, left: Samples, noise: float) -> Panel:
    """Return the density of residuals over ``noise`` (SI), and that of the normal distribution."""
    edges = np.linspace(-WIDEST, WIDEST, BINS + 1)
    middle, width = (edges[:-1] + edges[1:]) / 2, edges[1] - edges[0]
    counts = np.array([np.histogram(column / noise, edges)[0] for column in left.values.T])
    density = counts.T / (len(left) * width)
    normal = np.exp(-(middle**2) / 2) / np.sqrt(2 * np.pi)
    bars = rows_of(AXES, middle, density, 1.0, "bars")
    stated = rows_of(("stated noise",), middle, normal[:, None], 1.0)
    return Panel(f"{name} residual", "", (bars, stated))


def correlation_panel(name: str, left: Samples) -> Panel:
    """Return the autocorrelation of each axis at lags 1 ... ``LAGS``."""
    most = min(LAGS, len(left) - 2)
    columns = [correlations(column[:, None], most)[1:] for column in left.values.T]
    lags = np.arange(1.0, most + 1.0)
    rows = rows_of(AXES, lags, np.array(columns).T, 1.0, "stems")
    return Panel(f"{name} residual", "", (rows,), NORMAL_95 / float(np.sqrt(len(left))))
