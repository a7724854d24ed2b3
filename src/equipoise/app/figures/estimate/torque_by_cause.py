"""The torque of each cause over time, a row of panels a cause, with bands."""

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.strokes import around, band, line, panel_grid
from equipoise.app.figures.base.style import AXES, XYZ, styled
from equipoise.model.torque_by_cause import TorqueByCause
from equipoise.model.units import UN_M

CAPTION = (
    "Torque of each cause, and of all together, mean over each second, uN m in body axes. "
    "Bands: two standard deviations. Errors of causes are correlated; the band of the total counts "
    "that."
)


@styled
def draw(torque: TorqueByCause) -> Figure:
    """Return the figure."""
    figure, grid = panel_grid(len(torque.courses), 3, height=0.95)
    middle = torque.t + 0.5 * torque.interval
    for row, course in zip(grid, torque.courses, strict=True):
        for i, axes in enumerate(row):
            value, spread = course.torque[:, i] / UN_M, course.sd[:, i] / UN_M
            band(axes, middle, value, spread, XYZ[i])
            line(axes, middle, value, XYZ[i])
            axes.set_ylim(around(value, spread))
        row[0].set_ylabel(f"{course.name}, uN m")
    for i, axes in enumerate(grid[0]):
        axes.set_title(AXES[i])
    figure.align_ylabels()
    return figure
