"""Errors of methods beside the Cramer-Rao bound."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from equipoise.app.figures.base.by_name import named_axes, plain_log
from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.strokes import with_legend
from equipoise.app.figures.base.style import BLUE, GREY, ORANGE, styled

CAPTION = (
    "Root mean square errors of each method in units of the Cramer-Rao bound "
    "(dashed), over all records that did not fail. Open markers: the method failed on "
    "some records, so that the easier ones remain."
)
LIMITS = (0.3, 1e4)  # chosen: beyond these the factor no longer matters


class Accuracy(NamedTuple):
    """One method."""

    name: str
    com: float  # RMSE / bound; nan: not stated
    inertia: float
    failed: bool  # on some records


@styled
def draw(methods: Sequence[Accuracy]) -> Figure:
    """Return the figure."""
    figure, axes = named_axes([m.name for m in methods], "RMSE / bound")
    lines = np.arange(len(methods))
    failed = np.array([m.failed for m in methods], dtype=bool)
    axes.axvline(1.0, color=GREY, linestyle="--", linewidth=0.9)
    for label, colour, shift in (("centre of mass", BLUE, -0.14), ("inertia", ORANGE, 0.14)):
        ratio = [m.com if colour == BLUE else m.inertia for m in methods]
        ratio = np.clip(np.array(ratio, dtype=float), *LIMITS)
        for open_ended in (False, True):
            x = np.where(failed == open_ended, ratio, np.nan)
            face = "white" if open_ended else colour
            axes.plot(x, lines + shift, "o", color=colour, markerfacecolor=face, markersize=4.5,
                      label=None if open_ended else label)  # fmt: skip
    plain_log(axes, "x")
    axes.margins(x=0.03)
    return with_legend(figure, axes)
