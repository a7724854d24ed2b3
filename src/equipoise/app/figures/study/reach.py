"""What the masses of a testbed can reach, and what has to be corrected, in three views."""

import numpy as np

from equipoise.app.figures.base.canvas import Axes, Figure, laid_out
from equipoise.app.figures.base.strokes import with_legend
from equipoise.app.figures.base.style import AXES, BLUE, GREEN, GREY, ORANGE, WIDE, styled
from equipoise.model.units import UM
from equipoise.planning.sizing.case import Case
from equipoise.planning.sizing.reachable_set import Reach, outline, tolerance

CAPTION = (
    "Reach of the masses from home, um (shaded); shifts needed by platforms as stated "
    "(one and two sd); offset that can be corrected in any direction."
)
PLANES = ((0, 1), (0, 2), (1, 2))
AIR = 1.08  # of what is shown, chosen: room beside it


@styled
def draw(reach: Reach, case: Case) -> Figure:
    """Return the figure: one panel for each plane of body axes, all of one scale."""
    figure = laid_out(WIDE, 2.6)
    every: list[Axes] = list(figure.subplots(1, 3))
    half = AIR * extent(reach, case)
    for axes, plane in zip(every, PLANES, strict=True):
        draw_reach(axes, reach, plane)
        draw_needed(axes, case, plane)
        axes.set(xlim=(-half, half), ylim=(-half, half), aspect="equal")
        axes.set_xlabel(f"{AXES[plane[0]]}, um")
        axes.set_ylabel(f"{AXES[plane[1]]}, um")
    return with_legend(figure, every[0])


def extent(reach: Reach, case: Case) -> float:
    """Return the largest coordinate that is shown, um."""
    corners = np.vstack([outline(reach, plane) for plane in PLANES])
    needed = np.abs(case.target - case.testbed.body.com) + 2 * case.testbed.com_sd
    return float(max(np.abs(corners).max(), needed.max())) / UM


def draw_reach(axes: Axes, reach: Reach, plane: tuple[int, int]) -> None:
    """Draw the outline of what can be reached, and the largest circle about home within it."""
    from matplotlib.patches import Circle

    corners = outline(reach, plane) / UM
    closed = np.vstack([corners, corners[:1]])
    axes.fill(*closed.T, color=BLUE, alpha=0.15, linewidth=0)
    axes.plot(*closed.T, color=BLUE, label="within reach")
    if reach.rank == 3:
        radius = tolerance(reach) / UM
        axes.add_patch(Circle((0, 0), radius, fill=False, color=GREEN, linestyle="--"))
        axes.plot([], [], color=GREEN, linestyle="--", label="any direction")
    axes.plot(0, 0, "+", color=GREY, markersize=8, label="home")


def draw_needed(axes: Axes, case: Case, plane: tuple[int, int]) -> None:
    """Draw the shifts that bring platforms, as stated, to the target."""
    from matplotlib.patches import Ellipse

    across = list(plane)
    x, y = (case.target - case.testbed.body.com)[across] / UM
    sd = case.testbed.com_sd[across] / UM
    for many, alpha in ((1, 0.35), (2, 0.15)):
        size = 2 * many * sd
        axes.add_patch(Ellipse((x, y), *size, color=ORANGE, alpha=alpha, linewidth=0, zorder=2))
    axes.plot(x, y, ".", color=ORANGE, markersize=7, label="needed, 1 and 2 sd")
