"""The null state vector and the way out of it (da Silva et al. 2021, Fig. 3 and Eq. 42)."""

from collections.abc import Iterator, Sequence

import numpy as np

from equipoise.app.figures.base.canvas import Axes, Figure
from equipoise.app.figures.base.strokes import line, line_of_several, panel_grid, with_legend
from equipoise.app.figures.base.style import GREY, PURPLE, styled
from equipoise.app.figures.catalogue import Picture
from equipoise.model.units import DEG, UM
from equipoise.study.papers.null_vector import Course, NullVector

TITLES = ("plain Lyapunov function", "with a momentum trajectory (Eq. 42)")
LABELS = ("momentum $|J\\omega|$, N m s", "centre of mass $r$, um", "angle of $r$ and $g_B$, deg")
CAPTION = (
    "da Silva Fig. 3. One platform balanced twice by masses and gyros. Left: momentum is to "
    "vanish, and does; r comes to rest along gravity, and the platform is not balanced. Right: "
    "momentum leads gravity round a cone, and r vanishes. Ideal devices; body axes."
)


def pictures_of(found: NullVector) -> Iterator[Picture]:
    """Yield the figure."""
    yield Picture("dasilva_figure03_null_vector", CAPTION, draw(found))


@styled
def draw(found: NullVector) -> Figure:
    """Return momentum, offset and its angle to gravity, of both balancings beside each other."""
    figure, grid = panel_grid(3, 2, height=1.9)
    for (left, right), label in zip(grid, LABELS, strict=True):
        right.sharey(left)
        right.tick_params(which="both", labelleft=False)
        left.set_ylabel(label)
    for column, (course, title) in enumerate(zip((found.plain, found.led), TITLES, strict=True)):
        panels = [row[column] for row in grid]
        fill(panels, course)
        panels[0].set_title(title)
    return with_legend(figure, grid[1][0])


def fill(panels: Sequence[Axes], course: Course) -> None:
    """Draw one balancing."""
    momentum, offset, angle = panels
    line(momentum, course.t, np.linalg.norm(course.momentum, axis=1), PURPLE)
    for k, (values, axis) in enumerate(zip(course.offset.T, "xyz", strict=True)):
        line_of_several(offset, k, course.t, values / UM, f"${axis}$")
    for panel in panels:
        panel.axhline(0.0, color=GREY, linewidth=0.6)
    line(angle, course.t, course.angle / DEG, PURPLE)
