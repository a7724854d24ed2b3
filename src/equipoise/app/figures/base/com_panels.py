"""Three panels of a centre of mass over time, with bands."""

from collections.abc import Sequence

from equipoise.app.figures.base.canvas import Axes
from equipoise.app.figures.base.strokes import around, band, line, mark_travel
from equipoise.app.figures.base.style import AXES, XYZ
from equipoise.model.arrays import Series1, Series3
from equipoise.model.estimate import Course
from equipoise.model.recording import Recording
from equipoise.model.units import UM

SETTLED = 0.15  # share of the rows before a panel's scale is taken; chosen: past the first guess


def draw_com(
    every: Sequence[Axes], course: Course, recording: Recording, label: str = "tracker"
) -> None:
    """Draw x, y and z of a centre of mass in um, scaled to its course after the first moments."""
    t, com, sd = course.t, course.values, course.sd
    late = slice(int(SETTLED * len(t)), None)
    for i, axes in enumerate(every):
        value, spread = com[:, i] / UM, sd[:, i] / UM
        band(axes, t, value, spread, XYZ[i])
        line(axes, t, value, XYZ[i], label)
        axes.set_ylim(around(value[late], spread[late]))
        axes.set_ylabel(f"$r_{AXES[i]}$, um")
    mark_travel(every, recording)


def include(axes: Axes, low: float, high: float) -> None:
    """Widen a panel's scale until it shows from ``low`` to ``high``, with some air."""
    now = axes.get_ylim()
    low, high = min(now[0], low), max(now[1], high)
    air = 0.04 * (high - low)
    axes.set_ylim(low - air * (low < now[0]), high + air * (high > now[1]))


def draw_truth(every: Sequence[Axes], t: Series1, com: Series3) -> None:
    """Draw the simulated truth (m), dashed; rows of NaN break it."""
    for i, axes in enumerate(every):
        axes.plot(t, com[:, i] / UM, color="black", linestyle="--", linewidth=0.9, label="truth")
