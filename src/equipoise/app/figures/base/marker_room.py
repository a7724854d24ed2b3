"""Room for markers: limits are widened until none is cut at a panel's border.

A marker is as large as its points say, whatever the scale: limits that end at the data halve it.
What lies quite beyond the limits stays there, such as the long bars of a first estimate.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from equipoise.model.arrays import Floats

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

POINTS = 72.0  # an inch
AIR = 1.5  # times a marker's radius, chosen: panels are placed anew, some of them smaller
MOST = 4  # times that limits are widened; each time panels hold more in the same room
UNMARKED = ("None", "none", "", " ")


def make_room(figure: "Figure") -> "Figure":
    """Return the figure with limits that hold all markers in view."""
    for axes in figure.axes:
        if axes.name == "rectilinear" and axes.axison:
            for _ in range(MOST):
                if not widened(axes, figure.dpi):
                    break
    return figure


def widened(axes: "Axes", dpi: float) -> bool:
    """Widen the limits of a panel by what its markers lack; say whether any lacked."""
    axes.autoscale_view()  # else limits are those of before the last line
    box = np.array(axes.get_window_extent().extents).reshape(2, 2)
    lacking = np.zeros((2, 2))  # pixels, below and above, along x and y
    for at, radius in markers(axes, dpi):
        inside = at[np.all((at > box[0] - radius) & (at < box[1] + radius), axis=1)]
        if len(inside):
            lacking[0] = np.maximum(lacking[0], radius - (inside.min(axis=0) - box[0]))
            lacking[1] = np.maximum(lacking[1], radius - (box[1] - inside.max(axis=0)))
    if lacking.max() < 0.5:
        return False
    back = axes.transData.inverted().transform
    low, high = back(box[0] - lacking[0]), back(box[1] + lacking[1])
    if lacking[:, 0].max() >= 0.5:
        axes.set_xlim(low[0], high[0])
    if lacking[:, 1].max() >= 0.5:
        axes.set_ylim(low[1], high[1])
    return True


def markers(axes: "Axes", dpi: float) -> Iterator[tuple[Floats, float]]:
    """Yield where the markers of each line are (n, 2), pixels, and their radius, pixels."""
    for line in axes.lines:
        if line.get_marker() in UNMARKED or line.get_transform() != axes.transData:
            continue
        at: Floats = np.asarray(axes.transData.transform(line.get_xydata()), dtype=np.float64)
        size = line.get_markersize() + line.get_markeredgewidth()
        yield at[np.isfinite(at).all(axis=1)], AIR * 0.5 * size * dpi / POINTS
