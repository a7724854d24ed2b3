"""Centre of mass from recording to recording, while a person balances by hand."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from equipoise.app.figures.balancing.balanced_com import Story, mark_measurements
from equipoise.app.figures.base.style import AXES, BAND, legend, panels, styled
from equipoise.model.arrays import Vector3
from equipoise.model.units import UM

CAPTION = (
    "Centre of mass off the target, um in body axes, recording by recording (circles, bars of two "
    "standard deviations), the tolerance (shaded), simulated truth (crosses). Linear within the "
    "tolerance, logarithmic beyond."
)
TICKS = [-1000.0, -100.0, -10.0, 0.0, 10.0, 100.0, 1000.0]  # um


@styled
def draw(story: Story) -> Figure:
    """Return the figure; the times of the story are numbers of recordings."""
    figure, grid = panels(3, height=1.4)
    for i, axes in enumerate(row[0] for row in grid):
        near = story.tolerance[i] / UM
        axes.set_yscale("symlog", linthresh=near)
        axes.set_yticks(TICKS, [f"{tick:g}" for tick in TICKS])
        axes.axhspan(-near, near, color="black", alpha=0.16, linewidth=0, label="tolerance")
        measurements = [(k, com - story.target, sd) for k, com, sd in story.measurements]
        mark_measurements(axes, i, measurements)
        if story.truth is not None:
            off: Vector3 = (story.truth[1][:, i] - story.target[i]) / UM
            axes.plot(story.truth[0], off, "x", color="black", markersize=4.5, zorder=6,
                      label="truth")  # fmt: skip
        most = max(float(np.abs(com[i]) + BAND * sd[i]) for _, com, sd in measurements) / UM
        axes.set_ylim(-3 * max(most, near), 3 * max(most, near))
        axes.set_ylabel(f"{AXES[i]} off target, um")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.margins(x=0.1)
    grid[-1][0].set_xlabel("recording")
    legend(figure, grid[0][0])
    figure.align_ylabels()
    return figure
