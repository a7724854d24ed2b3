"""Centre of mass at every estimate of a balancing, beside its target."""

from matplotlib.figure import Figure

from equipoise.app.figures.balancing.balanced_com import Story, mark_measurements
from equipoise.app.figures.base.com_panels import include
from equipoise.app.figures.base.style import AXES, legend, panels, styled
from equipoise.model.units import UM

CAPTION = (
    "Centre of mass with the masses as they stand, um in body axes: estimates of the procedure "
    "(circles, bars of two standard deviations), target with its tolerance (shaded), simulated "
    "truth at each step (crosses)."
)


@styled
def draw(story: Story) -> Figure:
    """Return the figure."""
    figure, grid = panels(3, height=1.5)
    for i, axes in enumerate(row[0] for row in grid):
        middle, near = story.target[i] / UM, story.tolerance[i] / UM
        axes.axhspan(middle - near, middle + near, color="black", alpha=0.16, linewidth=0,
                     label="target")  # fmt: skip
        axes.set_ylim(middle - 2 * near, middle + 2 * near)
        mark_measurements(axes, i, story.measurements)
        if story.truth is not None:
            t, y = story.truth[0], story.truth[1][:, i] / UM
            axes.plot(t, y, "x", color="black", markersize=4.5, zorder=6, label="truth")
            include(axes, float(y.min()), float(y.max()))
        axes.set_ylabel(f"$r_{AXES[i]}$, um")
    legend(figure, grid[0][0])
    figure.align_ylabels()
    return figure
