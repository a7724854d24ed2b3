"""How often 95 % intervals of methods hold the truth."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from equipoise.app.figures.base.by_name import named_axes
from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.style import BLUE, GREY, ORANGE, styled

CAPTION = (
    "Coverage of the 95 % intervals, over runs without a warning. Shaded: lower limit "
    "of what chance allows for valid intervals, for this number of runs. Orange: "
    "below it."
)


class Coverage(NamedTuple):
    """One method that states some of its intervals without a warning."""

    name: str
    share: float
    least: float  # share that may be chance


@styled
def draw(methods: Sequence[Coverage]) -> Figure:
    """Return the figure."""
    figure, axes = named_axes([m.name for m in methods], "coverage, %")
    axes.axvline(95.0, color=GREY, linestyle="--", linewidth=0.9)
    for k, method in enumerate(methods):
        low, share = 100 * method.least, 100 * method.share
        axes.plot([low, 100.0], [k, k], color=GREY, alpha=0.3, linewidth=6, solid_capstyle="butt")
        colour = BLUE if method.share >= method.least else ORANGE
        axes.plot([share], [k], "o", color=colour, markersize=4.5)
    lowest = min((min(m.share, m.least) for m in methods), default=0.0)
    axes.set_xlim(100 * np.floor(10 * lowest) / 10 - 2, 102)
    return figure
