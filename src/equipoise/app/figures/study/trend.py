"""Mass properties of one platform over months, and against temperature."""

from collections.abc import Sequence
from datetime import datetime
from typing import Any, NamedTuple

import numpy as np

from equipoise.app.figures.base.canvas import Axes, Figure, laid_out
from equipoise.app.figures.base.style import BAND, GREY, WIDE, XYZ, styled
from equipoise.app.text.escaping import for_figure
from equipoise.model.arrays import Series, Series1
from equipoise.model.units import UM

CAPTION = (
    "Centre of mass (um) and moments of inertia (kg m2) with the masses at home, by "
    "run, with bars of two standard deviations; dashed: the testbed file changed. "
    "Right, where recorded: over temperature. Many runs are drawn in groups: median "
    "(line) and central 95 % (shade)."
)
LABELS = (
    "$r_x$, um", "$r_y$, um", "$r_z$, um", "$J_{xx}$, kg m2", "$J_{yy}$, kg m2", "$J_{zz}$, kg m2",
)  # fmt: skip
SIZES = np.array([UM, UM, UM, 1.0, 1.0, 1.0])


class Band(NamedTuple):
    """What groups of runs found: a row for each group."""

    at: Any  # numpy datetime64, or degC
    low: Series1  # m, kg m^2
    middle: Series1
    high: Series1


class Trend(NamedTuple):
    """What is drawn: a row for each run."""

    platform: str
    times: Sequence[datetime]
    values: Series  # (n, 6) m, kg m^2; NaN: not known
    sd: Series  # (n, 6)
    builds: Sequence[str]  # a letter for the testbed file of each
    temperature: Series1  # degC; NaN: not recorded
    over_time: Sequence[Band] = ()  # of the six values, in place of single runs; empty: these
    over_temperature: Sequence[Band] = ()


@styled
def draw(trend: Trend) -> Figure:
    """Return the figure."""
    from matplotlib.dates import AutoDateLocator, ConciseDateFormatter

    warm = bool(np.isfinite(trend.temperature).sum() > 1)
    figure = laid_out(WIDE * (1.35 if warm else 1.0), 8.6)
    ratios = [2.2, 1.0] if warm else [1.0]
    grid = figure.subplots(6, len(ratios), squeeze=False, sharey="row", sharex="col",
                           width_ratios=ratios)  # fmt: skip
    for i, row in enumerate(grid):
        _runs(row[0], np.array(trend.times), trend, trend.over_time, i)
        row[0].set_ylabel(LABELS[i])
        _mark_builds(row[0], trend, named=i == 0)
        if warm:
            _runs(row[1], trend.temperature, trend, trend.over_temperature, i)
    locator = AutoDateLocator()
    grid[-1][0].xaxis.set_major_locator(locator)
    grid[-1][0].xaxis.set_major_formatter(ConciseDateFormatter(locator))
    if warm:
        grid[-1][1].set_xlabel("temperature, degC")
    figure.suptitle(f"{for_figure(trend.platform)}, masses at home", x=0.01, ha="left", fontsize=10)
    figure.align_ylabels(grid[:, 0])
    return figure


def _groups(axes: Axes, band: Band, i: int) -> None:
    low, middle, high = (each / SIZES[i] for each in (band.low, band.middle, band.high))
    axes.fill_between(band.at, low, high, color=XYZ[i % 3], alpha=0.2, linewidth=0)
    axes.plot(band.at, middle, color=XYZ[i % 3])


def _runs(axes: Axes, x: Series1, trend: Trend, bands: Sequence[Band], i: int) -> None:
    if bands:
        _groups(axes, bands[i], i)
        return
    y, spread = trend.values[:, i] / SIZES[i], BAND * trend.sd[:, i] / SIZES[i]
    axes.errorbar(
        x, y, spread, fmt="o", color=XYZ[i % 3], markersize=4, markerfacecolor="white",
        elinewidth=1, capsize=2,
    )  # fmt: skip


def _mark_builds(axes: Axes, trend: Trend, named: bool) -> None:
    """Mark where the testbed file became another one."""
    for k, build in enumerate(trend.builds):
        if k and build == trend.builds[k - 1]:
            continue
        if k:
            axes.axvline(
                trend.times[k],  # pyright: ignore[reportArgumentType]: takes dates too
                color=GREY,
                linestyle="--",
                linewidth=0.8,
            )
        if named:
            axes.annotate(
                f" build {build}", (trend.times[k], 1.0), xycoords=("data", "axes fraction"),
                fontsize=8, color=GREY, va="bottom",
            )  # fmt: skip
