"""Centre of mass in the process of automatic balancing (Ivanov 2021 Fig. 14)."""

from equipoise.app.figures.balancing.story import Story
from equipoise.app.figures.base.canvas import Axes, Figure
from equipoise.app.figures.base.com_panels import draw_com, include
from equipoise.app.figures.base.strokes import panels, with_legend
from equipoise.app.figures.base.style import BAND, styled
from equipoise.model.estimate import Course
from equipoise.model.recording import Recording
from equipoise.model.units import UM

CAPTION = (
    "Centre of mass with the masses in their present positions, um in body axes, "
    "during balancing: tracker (line, band of two standard deviations), estimates of "
    "the procedure (circles, bars of two standard deviations), target with tolerance "
    "(shaded), simulated truth at each step (crosses). Grey: masses move."
)


@styled
def draw(course: Course, recording: Recording, story: Story) -> Figure:
    """Return the figure."""
    figure, column = panels(3, height=1.1)
    draw_com(column, course, recording)
    for i, axes in enumerate(column):
        mark_story(axes, i, story, "target")
    return with_legend(figure, column[0])


def mark_story(axes: Axes, i: int, story: Story, wanted: str) -> None:
    """Draw one component of the target, of the estimates with bars of two sd, and of the truth."""
    target, tolerance = story.target[i], story.tolerance[i]
    low, high = (target - tolerance) / UM, (target + tolerance) / UM
    axes.axhspan(low, high, color="black", alpha=0.16, linewidth=0, label=wanted)
    include(axes, low, high)
    for k, (t, com, sd) in enumerate(story.measurements):
        y, spread = com[i] / UM, BAND * sd[i] / UM
        axes.errorbar(
            t, y, spread, fmt="o", color="black", markersize=5, markerfacecolor="white",
            elinewidth=1, capsize=2.5, zorder=5, label=None if k else "estimate",
        )  # fmt: skip
        include(axes, y, y)  # long bars of a first estimate may run off the panel
    if story.truth is not None:
        t, y = story.truth[0], story.truth[1][:, i] / UM
        axes.plot(t, y, "x", color="black", markersize=4.5, zorder=6, label="truth")
        include(axes, float(y.min()), float(y.max()))
