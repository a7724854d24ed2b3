"""The panels, strokes and legends that figures share."""

from collections.abc import Iterable

import numpy as np

from equipoise.app.figures.base.canvas import Axes, Figure, laid_out
from equipoise.app.figures.base.style import BAND, DASHES, SEVERAL, WIDE
from equipoise.model.arrays import Floats, Series1
from equipoise.model.recording import Recording, Samples, runs
from equipoise.model.units import UM

MOST = 4000  # points of a line; chosen: more than a page has pixels across
FEW = 250  # measurements that are drawn as larger dots; chosen: they do not touch
RINGS = 90  # measurements of a curve drawn as rings; chosen: they do not touch


def panels(rows: int, height: float) -> tuple[Figure, list[Axes]]:
    """Return a figure of panels below each other that share their time axis."""
    figure, grid = panel_grid(rows, 1, height)
    return figure, [axes for (axes,) in grid]


def panel_grid(rows: int, columns: int, height: float) -> tuple[Figure, list[list[Axes]]]:
    """Return a figure of rows of panels that share their time axis."""
    figure = laid_out(WIDE, height * rows + 0.7)
    grid = figure.subplots(rows, columns, sharex=True, squeeze=False)
    for axes in grid[-1]:
        axes.set_xlabel("time, s")
    return figure, [list(row) for row in grid]


def thinned(n: int) -> slice:
    """Return every so-manieth of n points, so that a long record is still drawn quickly."""
    return slice(None, None, max(1, n // MOST))


def line(axes: Axes, t: Series1, y: Series1, colour: str, label: str = "") -> None:
    """Draw a line through rows, broken where the record has a gap."""
    keep = thinned(len(t))
    t, y = t[keep], y[keep]
    if len(t) > 2:
        gap = np.flatnonzero(np.diff(t) > 10 * np.median(np.diff(t)))
        t, y = np.insert(t, gap + 1, t[gap]), np.insert(y, gap + 1, np.nan)
    axes.plot(t, y, color=colour, label=label or None)


def line_of_several(axes: Axes, k: int, t: Series1, y: Series1, label: str) -> None:
    """Draw the k-th of several lines of a panel, with a colour and dashes of its own."""
    line(axes, t, y, SEVERAL[k % len(SEVERAL)], label)
    dash_last(axes, k)


def dash_last(axes: Axes, k: int) -> None:
    """Give the line that was drawn last the k-th dashes."""
    axes.lines[-1].set_linestyle(DASHES[k % len(DASHES)])


def course(axes: Axes, t: Series1, y: Series1, colour: str, label: str = "") -> None:
    """Draw what is straight between its rows, however far apart they are."""
    axes.plot(t, y, color=colour, label=label or None)


def dots(axes: Axes, t: Series1, y: Series1, colour: str, label: str = "") -> None:
    """Draw measurements; in a drawing of lines, many are one picture, not an element each."""
    keep = thinned(len(t))
    few = len(t) <= FEW
    axes.plot(
        t[keep], y[keep], ".", color=colour, alpha=0.8 if few else 0.45, markeredgewidth=0,
        markersize=5.5 if few else None, label=label or None, rasterized=not few,
    )  # fmt: skip


def rings(axes: Axes, t: Series1, y: Series1, colour: str, label: str = "") -> None:
    """Draw some of the measurements so that a line of the same colour shows through."""
    keep = slice(None, None, max(1, len(t) // RINGS))
    axes.plot(
        t[keep], y[keep], "o", markersize=3, color=colour, markerfacecolor="white",
        markeredgewidth=0.8, label=label or None, zorder=3,
    )  # fmt: skip


def band(axes: Axes, t: Series1, y: Series1, sd: Series1, colour: str) -> None:
    """Shade two sd on either side of a line."""
    keep = thinned(len(t))
    low, high = (y - BAND * sd)[keep], (y + BAND * sd)[keep]
    axes.fill_between(t[keep], low, high, color=colour, alpha=0.2, linewidth=0, label="two sd")


def travel_times(masses: Samples | None) -> list[tuple[float, float]]:
    """Return when any mass travels, s."""
    if masses is None or len(masses) < 2:
        return []
    moving = np.any(np.abs(np.diff(masses.values, axis=0)) > UM, axis=1)
    return [(float(masses.t[a]), float(masses.t[b + 1])) for a, b in runs(moving)]


def mark_travel(every: Iterable[Axes], recording: Recording) -> None:
    """Shade the times at which masses travel."""
    start, end = recording.span
    for axes in every:
        for a, b in travel_times(recording.masses):
            if start <= b and a <= end:
                axes.axvspan(a, b, color="#cccccc", alpha=0.35, linewidth=0, zorder=0)


def with_legend(figure: Figure, axes: Axes) -> Figure:
    """Return a figure with its legend above the panels, each label once, and labels aligned."""
    handles, labels = axes.get_legend_handles_labels()
    first = dict(zip(reversed(labels), reversed(handles), strict=True))
    order = list(dict.fromkeys(labels))
    figure.legend([first[k] for k in order], order, loc="outside upper center", ncols=6)
    figure.align_ylabels()
    return figure


def around(values: Floats, sd: Floats, share: float = 0.12) -> tuple[float, float]:
    """Return limits that hold values with their bands, and some air."""
    low, high = float(np.min(values - BAND * sd)), float(np.max(values + BAND * sd))
    air = share * max(high - low, 1e-9)
    return low - air, high + air
