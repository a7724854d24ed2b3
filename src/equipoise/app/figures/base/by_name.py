"""One line a name: the frame of figures that compare methods or laws."""

from collections.abc import Sequence
from typing import Literal

from equipoise.app.figures.base.canvas import Axes, Figure, laid_out
from equipoise.app.figures.base.style import WIDE

LINE, AROUND = 0.19, 0.9  # inches, of a name and of what is above and below, chosen


def named_axes(names: Sequence[str], xlabel: str) -> tuple[Figure, Axes]:
    """Return a figure with a line for each name, the first one on top."""
    figure = laid_out(WIDE, LINE * len(names) + AROUND)
    axes = figure.subplots()
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.4, -0.6)
    axes.set_xlabel(xlabel)
    axes.tick_params(axis="y", length=0)
    return figure, axes


def plain_log(axes: Axes, which: Literal["x", "y"]) -> None:
    """Scale x or y logarithmically, with plain numbers at 1, 2, 5, 10 and so on."""
    from matplotlib.ticker import LogLocator, NullLocator

    axis = axes.xaxis if which == "x" else axes.yaxis
    axes.set(**{f"{which}scale": "log"})
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter("{x:g}")
