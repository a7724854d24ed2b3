"""Estimates and error indices along a slew, as printed beside corrected (Lee Figs. 10-16, 18)."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from equipoise.app.figures.base.canvas import Axes, Figure
from equipoise.app.figures.base.strokes import line_of_several, panel_grid, with_legend
from equipoise.app.figures.base.style import SEVERAL, styled
from equipoise.model.arrays import Floats, Series, Series1

TITLES = ("as printed", "corrected")


class Reported(NamedTuple):
    """One quantity along the record: a curve for each column."""

    t: Series1  # s
    values: Series  # (n, k)


@styled
def draw_estimates(
    sides: Sequence[Reported], truth: Floats, labels: Sequence[str], ylabel: str, air: float
) -> Figure:
    """Return estimates of both sides with the truth dashed; ``air`` is shown around the truth."""
    figure, grid = beside()
    for axes, side, title in zip(grid, sides, TITLES, strict=True):
        for k, label in enumerate(labels):
            line_of_several(axes, k, side.t, side.values[:, k], label)
            axes.axhline(truth[k], color=SEVERAL[k], linestyle="--", linewidth=0.9)
        axes.set(title=title, ylim=(float(truth.min()) - air, float(truth.max()) + air))
    grid[0].set_ylabel(ylabel)
    return with_legend(figure, grid[0])


@styled
def draw_indices(
    sides: Sequence[Reported], labels: Sequence[str], ylabel: str, wide: bool = True
) -> Figure:
    """Return error indices of both sides; on a logarithmic scale, if they range ``wide``."""
    figure, grid = beside()
    both = np.concatenate([side.values[np.isfinite(side.values)] for side in sides])
    low, high = float(both.min()), float(both.max())
    for axes, side, title in zip(grid, sides, TITLES, strict=True):
        for k, label in enumerate(labels):
            line_of_several(axes, k, side.t, side.values[:, k], label)
        axes.set(title=title, yscale="log" if wide else "linear")
        axes.set_ylim(0.7 * low if wide else 0.0, (1.4 if wide else 1.05) * high)
    grid[0].set_ylabel(ylabel)
    return with_legend(figure, grid[0]) if len(labels) > 1 else figure


def beside() -> tuple[Figure, list[Axes]]:
    """Return a figure with two panels side by side, of the same scale."""
    figure, ((left, right),) = panel_grid(1, 2, height=2.6)
    right.sharey(left)
    right.tick_params(which="both", labelleft=False)
    return figure, [left, right]
