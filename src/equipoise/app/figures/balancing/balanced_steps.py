"""Centre of mass at every estimate of a balancing, beside its target."""

from equipoise.app.figures.balancing.balanced_com import mark_story
from equipoise.app.figures.balancing.story import Story
from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.strokes import panels, with_legend
from equipoise.app.figures.base.style import AXES, styled
from equipoise.model.units import UM

CAPTION = (
    "Centre of mass with the masses in their present positions, um in body axes: "
    "estimates of the procedure (circles, bars of two standard deviations), target "
    "with tolerance (shaded), simulated truth at each step (crosses)."
)


@styled
def draw(story: Story) -> Figure:
    """Return the figure."""
    figure, column = panels(3, height=1.1)
    for i, axes in enumerate(column):
        middle, near = story.target[i] / UM, story.tolerance[i] / UM
        axes.set_ylim(middle - 2 * near, middle + 2 * near)
        mark_story(axes, i, story, "target")
        axes.set_ylabel(f"$r_{AXES[i]}$, um")
    return with_legend(figure, column[0])
