"""Centre of mass from recording to recording, while a person balances by hand."""

import numpy as np

from equipoise.app.figures.balancing.balanced_com import mark_story
from equipoise.app.figures.balancing.story import Story
from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.strokes import panels, with_legend
from equipoise.app.figures.base.style import AXES, BAND, styled
from equipoise.model.units import UM

CAPTION = (
    "Offset of the centre of mass from the target, um in body axes, by recording "
    "(circles, bars of two standard deviations), tolerance (shaded), simulated truth "
    "(crosses). Linear within the tolerance, logarithmic beyond."
)
TICKS = [-1000.0, -100.0, -10.0, 0.0, 10.0, 100.0, 1000.0]  # um


@styled
def draw(story: Story) -> Figure:
    """Return the figure; the times of the story are numbers of recordings."""
    from matplotlib.ticker import MaxNLocator

    off = story.off_target()
    figure, column = panels(3, height=1.1)
    for i, axes in enumerate(column):
        near = story.tolerance[i] / UM
        axes.set_yscale("symlog", linthresh=near)
        ticks = [tick for tick in TICKS if tick == 0 or abs(tick) >= near]
        axes.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
        mark_story(axes, i, off, "tolerance")
        most = max(float(np.abs(com[i]) + BAND * sd[i]) for _, com, sd in off.measurements) / UM
        axes.set_ylim(-3 * max(most, near), 3 * max(most, near))
        axes.set_ylabel(f"{AXES[i]} off target, um")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.margins(x=0.1)
    column[-1].set_xlabel("recording")
    return with_legend(figure, column[0])
