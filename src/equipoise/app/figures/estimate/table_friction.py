"""A planar table from above: its friction map, its slope, and the path of the bearing."""

import numpy as np

from equipoise.app.figures.base.canvas import Figure, laid_out
from equipoise.app.figures.base.style import ORANGE, styled
from equipoise.model.units import MM, UM
from equipoise.procedure.identification.record_courses import FrictionField

CAPTION = (
    "The table from above: viscous friction of the air pads (colour) on the path of the centre "
    "of rotation (line, from the dot on), and beside it where the record determines it to half "
    "of its mean; the downhill direction (arrow)."
)
ARROW = 0.3  # of the table's shorter side, chosen


@styled
def draw(field: FrictionField) -> Figure:
    """Return the figure."""
    figure = laid_out(5.4, 4.4)
    axes, beside = figure.subplots(1, 2, width_ratios=(24, 1))
    x, y = field.x / MM, field.y / MM
    shown = np.ma.masked_where(~field.determined, field.friction).T
    low, high = float(field.along_path.min()), float(field.along_path.max())
    colours = {"cmap": "cividis", "vmin": low, "vmax": max(high, 1.01 * low)}
    drawn = axes.pcolormesh(x, y, shown, shading="nearest", **colours)
    axes.set_facecolor("#eeeeee")
    axes.grid(visible=False)
    bar = figure.colorbar(drawn, cax=beside)
    bar.set_label("friction, N s/m")
    axes.plot(*(field.path.T / MM), color="black", linewidth=4.0, label="path of P")
    axes.scatter(*(field.path.T / MM), c=field.along_path, s=5.0, zorder=3, **colours)
    axes.plot(*(field.path[0] / MM), "o", color="black", markersize=6.0)
    steep = float(np.linalg.norm(field.slope))
    middle = np.array([x.mean(), y.mean()])
    way = ARROW * min(np.ptp(x), np.ptp(y)) * field.slope / max(steep, 1e-300)
    style = {"arrowstyle": "-|>", "color": ORANGE, "linewidth": 1.8}
    axes.annotate("", xy=tuple(middle + way), xytext=tuple(middle), arrowprops=style)
    axes.plot([], [], color=ORANGE, label=f"downhill, {steep / UM:.3g} µm/m")
    axes.set(xlabel="x, mm", ylabel="y, mm", aspect="equal", xlim=(x[0], x[-1]),
             ylim=(y[0], y[-1]))  # fmt: skip
    figure.legend(loc="outside upper center", ncols=2)
    return figure
