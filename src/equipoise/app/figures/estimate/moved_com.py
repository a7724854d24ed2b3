"""Centre of mass across a move, fed to the tracker and withheld (Ivanov 2021 Fig. 13)."""

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.com_panels import draw_com, draw_truth, include
from equipoise.app.figures.base.strokes import panel_grid, with_legend
from equipoise.app.figures.base.style import styled
from equipoise.model.arrays import Series1, Series3
from equipoise.model.estimate import Course
from equipoise.model.recording import Recording

CAPTION = (
    "Centre of mass with the masses in their present positions, um in body axes, "
    "across a known move: (a) with feed-forward of the move to the tracker, (b) "
    "without. Bands: two standard deviations. Dashed: simulated truth. Grey: masses "
    "move."
)


@styled
def draw(
    fed: Course,
    ignored: Course,
    recording: Recording,
    truth: tuple[Series1, Series3] | None = None,
) -> Figure:
    """Return the figure; the centres of mass are with the masses as they stand."""
    figure, grid = panel_grid(3, 2, height=1.0)
    for k, (course, title) in enumerate(((fed, "(a) with feed-forward"), (ignored, "(b) without"))):
        column = [row[k] for row in grid]
        draw_com(column, course, recording)
        column[0].set_title(title)
        if truth is not None:
            draw_truth(column, *truth)
    for left, right in grid:
        include(left, *right.get_ylim())
        right.set(ylim=left.get_ylim(), ylabel="")
        right.tick_params(labelleft=False)
    return with_legend(figure, grid[0][0])
