"""One quiet style for every figure.

Figures are made without pyplot: no window, no state kept between them.
"""

from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar

from equipoise.app.figures.base.marker_room import make_room

# Okabe and Ito's colours, which colour-blind readers can distinguish.
BLUE, ORANGE, GREEN, PURPLE, GREY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#777777"
SKY, AMBER = "#56B4E9", "#E69F00"
XYZ = (BLUE, ORANGE, GREEN)
SIX = (BLUE, SKY, ORANGE, AMBER, GREEN, PURPLE)  # masses, mostly two along each axis
SEVERAL = (BLUE, ORANGE, GREEN, PURPLE)  # lines of one panel
# Dashes of lines of one panel, as a print in grey shows them alone.
DASHES: Any = (
    "-", (0, (5, 1.2)), (0, (5, 1.2, 1, 1.2)), (0, (1, 1)), (0, (9, 2)), (0, (3, 1, 1, 1, 1, 1)),
)  # fmt: skip
AXES = ("x", "y", "z")
BAND = 2.0  # sd on either side of a line
WIDE = 6.6  # inches
STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.labelsize": 9,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#888888",
    "axes.linewidth": 0.7,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.xmargin": 0.01,
    "axes.formatter.useoffset": False,
    "grid.color": "#e6e6e6",
    "grid.linewidth": 0.7,
    "xtick.color": "#444444",
    "ytick.color": "#444444",
    "lines.linewidth": 1.3,
    "lines.markersize": 3.2,
    "legend.frameon": False,
    "legend.fontsize": 9,
    "figure.dpi": 100,
    "figure.autolayout": False,  # nor "tight" nor "constrained" but where a figure sets it
    "figure.constrained_layout.use": False,
    "savefig.dpi": 160,
    "svg.hashsalt": "equipoise",  # the same figure, the same bytes
}
Drawing = TypeVar("Drawing", bound=Callable[..., Any])


def styled(draw: Drawing) -> Drawing:
    """Let a function draw, or save, in this style, and leave matplotlib as it was.

    A figure that is drawn has room for all its markers.
    """

    @wraps(draw)
    def in_style(*arguments: Any, **named: Any) -> Any:
        import matplotlib as mpl

        with mpl.rc_context(STYLE):
            drawn = draw(*arguments, **named)
            from matplotlib.figure import Figure  # loaded by ``canvas``, in its own way

            return make_room(drawn) if isinstance(drawn, Figure) else drawn

    return in_style  # pyright: ignore[reportReturnType]
