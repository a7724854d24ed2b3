"""Centre of mass in the process of automatic balancing (Ivanov 2021 Fig. 14)."""

from collections.abc import Sequence
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from equipoise.app.figures.base.com_panels import draw_com, include
from equipoise.app.figures.base.style import BAND, legend, panels, styled
from equipoise.model.arrays import Series1, Series3, Vector3
from equipoise.model.estimate import Course
from equipoise.model.recording import Recording
from equipoise.model.units import UM

CAPTION = (
    "Centre of mass with the masses as they stand, um in body axes, while the platform is "
    "balanced: tracker (line, band of two standard deviations), estimates of the procedure "
    "(circles, bars of two standard deviations), target with its tolerance (shaded), simulated "
    "truth at each step (crosses). Grey: masses travel."
)
Marked = tuple[float, Vector3, Vector3]  # s, m, m (one sd)


class Story(NamedTuple):
    """What stands beside the tracker's curve."""

    measurements: Sequence[Marked]
    target: Vector3  # m
    tolerance: Vector3  # m
    truth: tuple[Series1, Series3] | None  # s, m; where the simulated centre really was


@styled
def draw(course: Course, recording: Recording, story: Story) -> Figure:
    """Return the figure."""
    measurements, target, tolerance, truth = story
    figure, grid = panels(3, height=1.5)
    column = [row[0] for row in grid]
    draw_com(column, course, recording)
    for i, axes in enumerate(column):
        low, high = (target[i] - tolerance[i]) / UM, (target[i] + tolerance[i]) / UM
        axes.axhspan(low, high, color="black", alpha=0.16, linewidth=0, label="target")
        include(axes, low, high)
        mark_measurements(axes, i, measurements)
        if truth is not None:
            t, y = truth[0], truth[1][:, i] / UM
            axes.plot(t, y, "x", color="black", markersize=4.5, zorder=6, label="truth")
    legend(figure, column[0])
    figure.align_ylabels()
    return figure


def mark_measurements(axes: Axes, i: int, measurements: Sequence[Marked]) -> None:
    """Draw one component of the procedure's estimates, with bars of two sd."""
    for k, (t, com, sd) in enumerate(measurements):
        y, spread = com[i] / UM, BAND * sd[i] / UM
        axes.errorbar(
            t, y, spread, fmt="o", color="black", markersize=5, markerfacecolor="white",
            elinewidth=1, capsize=2.5, zorder=5, label=None if k else "estimate",
        )  # fmt: skip
        include(axes, y, y)  # long bars of a first estimate may run off the panel
