"""The torque that laws leave."""

from collections.abc import Sequence
from typing import NamedTuple

from equipoise.app.figures.base.by_name import named_axes, plain_log
from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.style import BLUE, GREY, styled

CAPTION = (
    "Residual torque of each law, uN m rms over the tilt range: median (dot) and 95th "
    "percentile (bar), with masses that follow the tilt where the law permits it. "
    "Dashed: requirement."
)


class Left(NamedTuple):
    """One law."""

    name: str
    median: float  # uN m
    most: float  # uN m


@styled
def draw(laws: Sequence[Left], required: float) -> Figure:
    """Return the figure; ``required`` is in uN m."""
    figure, axes = named_axes([law.name for law in laws], "torque left, uN m")
    axes.axvline(required, color=GREY, linestyle="--", linewidth=0.9)
    for k, law in enumerate(laws):
        axes.plot([law.median, law.most], [k, k], color=BLUE, alpha=0.6)
        axes.plot([law.most], [k], "|", color=BLUE, markersize=8)
        axes.plot([law.median], [k], "o", color=BLUE, markersize=4.5)
    plain_log(axes, "x")
    axes.margins(x=0.03)
    return figure
