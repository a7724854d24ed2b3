"""The attitude of a record in which loads are moved (Ivanov 2021 Figs. 4, 5 and 10)."""

from collections.abc import Sequence

import numpy as np

from equipoise.app.figures.base.canvas import Axes, Figure
from equipoise.app.figures.base.strokes import line_of_several, panels, with_legend
from equipoise.app.figures.base.style import styled
from equipoise.app.figures.estimate.attitude_fit import COMPONENTS
from equipoise.maths.attitude import continuous
from equipoise.model.arrays import Floats, Series1, Vector3
from equipoise.model.recording import Recording
from equipoise.model.units import MM

HIGH = 3.4  # inches, chosen: a panel for all four components and the brackets above them
TOP = 1.38  # of the panel, chosen: brackets stand above the quaternion's range
Marked = Sequence[tuple[float, Vector3]]  # s, m: when loads were moved, and by how much


@styled
def draw(recording: Recording, moves: Marked) -> Figure:
    """Return the figure: components, circles where loads were moved, and by how much in mm."""
    rows = recording.attitude
    assert rows is not None
    q = continuous(rows.values)
    figure, (axes,) = panels(1, height=HIGH)
    for i, name in enumerate(COMPONENTS):
        line_of_several(axes, i, rows.t, q[:, i], name)
    axes.set(ylabel="quaternion", ylim=(-1.08, TOP), yticks=np.linspace(-1, 1, 5))
    for t, change in moves:
        _mark(axes, rows.t, q, t, change)
    return with_legend(figure, axes)


def _mark(axes: Axes, t: Series1, q: Floats, at: float, change: Vector3) -> None:
    """Draw a circle on each component at a move, and write the move in brackets above."""
    here = [float(np.interp(at, t, q[:, i])) for i in range(q.shape[1])]
    axes.plot([at] * len(here), here, "o", color="black", markerfacecolor="none", markersize=9,
              linestyle="none", zorder=4)  # fmt: skip
    text = "[" + "; ".join(f"{value / MM:.0f}" for value in change) + "]"
    axes.annotate(text, (at, 1.1), ha="center", va="bottom", fontsize=8)
