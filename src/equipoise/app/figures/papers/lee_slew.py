"""What happened in a slew by gyros, one quantity a figure (Lee et al. Figs. 3-9 and 17)."""

from collections.abc import Sequence
from typing import NamedTuple

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.strokes import line_of_several, panels, with_legend
from equipoise.app.figures.base.style import GREY, styled
from equipoise.model.arrays import Series, Series1

Span = tuple[float, float] | None


class Shown(NamedTuple):
    """What a figure shows: a curve for each column."""

    t: Series1  # s
    values: Series  # (n, k)
    ylabel: str
    labels: Sequence[str]
    mark: float | None = None  # a level to draw


@styled
def draw(shown: Shown, near: Span) -> Figure:
    """Return the figure; ``near`` (s) is shaded: the gyros are near a singularity."""
    figure, (axes,) = panels(1, height=2.6)
    if near is not None:
        axes.axvspan(*near, color="#cccccc", alpha=0.45, linewidth=0, zorder=0)
    for k, (column, label) in enumerate(zip(shown.values.T, shown.labels, strict=True)):
        line_of_several(axes, k, shown.t, column, label)
    if shown.mark is not None:
        axes.axhline(shown.mark, color=GREY, linestyle="--", linewidth=0.9)
        axes.set_ylim(bottom=0.0)
    axes.set_ylabel(shown.ylabel)
    return with_legend(figure, axes) if len(shown.labels) > 1 else figure
