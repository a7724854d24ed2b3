"""What a fit leaves of a sensor's rows (Ivanov 2021 Fig. 7), their spread and their correlation."""

from typing import NamedTuple

import numpy as np

from equipoise.app.figures.base.canvas import Axes, Figure, laid_out
from equipoise.app.figures.base.strokes import around, dots, mark_travel
from equipoise.app.figures.base.style import AXES, BAND, GREY, WIDE, XYZ, styled
from equipoise.model.arrays import Series1
from equipoise.model.recording import Recording
from equipoise.model.units import DEG
from equipoise.procedure.identification.fitted_motion import ResidualSeries

HIGH = 3.5  # inches, chosen: two such figures fit on a page
WIDTHS = (3.4, 0.8, 1.5)  # of rows, distribution and correlation, chosen
TITLES = ("residuals", "density", "autocorrelation")
BARS = 25  # of a histogram at most, chosen
SPREAD = (
    " Grey band: two standard deviations of the stated noise; grey strips: masses move. Middle: "
    "distribution, and the normal distribution of the stated noise (line). Right: autocorrelation, "
    "and the 95 % limits of white noise (shaded)."
)


class Sensor(NamedTuple):
    """How the residuals of a sensor are labelled."""

    unit: str
    per_unit: str
    caption: str


CAMERA = Sensor(
    "deg",
    "1/deg",
    f"Attitude residuals (measured minus fitted) about each body axis, deg.{SPREAD}",
)
GYRO = Sensor(
    "deg/s",
    "s/deg",
    "Gyro residuals (measured minus fitted) about each gyro axis, deg/s, without the estimated "
    f"bias, scale errors and misalignment.{SPREAD}",
)


@styled
def draw(recording: Recording, left: ResidualSeries, sensor: Sensor) -> Figure:
    """Return the figure: a row of panels an axis; rows alone where they are too few for more."""
    wide = len(left.correlation) > 0
    figure = laid_out(WIDE, HIGH)
    widths = WIDTHS if wide else WIDTHS[:1]
    grid = figure.subplots(3, len(widths), sharex="col", squeeze=False, width_ratios=widths)
    values = left.rows.values / DEG
    limits = around(values, np.zeros(3))
    for i, row in enumerate(grid):
        _rows(row[0], left, i)
        row[0].set(ylabel=f"{AXES[i]}, {sensor.unit}", ylim=limits)
        mark_travel([row[0]], recording)
        if wide:
            _distribution(row[1], values[:, i], left.noise, i)
            row[1].set_ylim(limits)
            _correlation(row[2], left, i)
    grid[-1][0].set_xlabel("time, s")
    if wide:
        grid[-1][1].set_xlabel(sensor.per_unit)
        grid[-1][2].set_xlabel("lag, rows")
        for axes, title in zip(grid[0], TITLES, strict=True):
            axes.set_title(title)
    return figure


def _rows(axes: Axes, left: ResidualSeries, i: int) -> None:
    """Draw the residuals of one axis over time, and the noise that was stated."""
    if left.noise is not None:
        limit = BAND * left.noise / DEG
        axes.axhspan(-limit, limit, color=GREY, alpha=0.12, linewidth=0)
    axes.axhline(0, color=GREY, linewidth=0.7)
    dots(axes, left.rows.t, left.rows.values[:, i] / DEG, XYZ[i])


def _distribution(axes: Axes, values: Series1, noise: float | None, i: int) -> None:
    """Draw how the residuals of one axis are distributed, and as what the noise is stated."""
    bars = min(BARS, round(2.0 * len(values) ** (1 / 3)))  # the Rice rule
    axes.hist(values, bars, density=True, orientation="horizontal", color=XYZ[i], alpha=0.55)
    if noise is not None:
        sd = noise / DEG
        y = np.linspace(-4 * sd, 4 * sd, 81)
        axes.plot(np.exp(-0.5 * (y / sd) ** 2) / (sd * np.sqrt(2 * np.pi)), y, color="black",
                  linewidth=0.9)  # fmt: skip
    axes.tick_params(labelleft=False)


def _correlation(axes: Axes, left: ResidualSeries, i: int) -> None:
    """Draw the autocorrelation of one axis, and within what that of white noise lies."""
    lags = np.arange(1, len(left.correlation) + 1)
    axes.axhspan(-left.white, left.white, color=GREY, alpha=0.2, linewidth=0)
    axes.axhline(0, color=GREY, linewidth=0.7)
    axes.vlines(lags, 0.0, left.correlation[:, i], color=XYZ[i], linewidth=1.2)
    most = max(0.2, 1.15 * float(np.abs(left.correlation).max()))
    axes.set_ylim(-most, most)
