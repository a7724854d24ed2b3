"""The centre of mass over hours, and how far it goes in how much time."""

import numpy as np

from equipoise.app.figures.base.by_name import plain_log
from equipoise.app.figures.base.canvas import Figure, laid_out
from equipoise.app.figures.base.strokes import with_legend
from equipoise.app.figures.base.style import AXES, BAND, WIDE, XYZ, styled
from equipoise.assessment.metrics.allan import Wander
from equipoise.model.units import MINUTE, UM
from equipoise.procedure.identification.drift_metrics import OverHours

CAPTION = (
    "Centre of mass in windows along the recording, um in body axes (bars: two "
    "standard deviations), and its Allan deviation. Dashed: Allan deviation of "
    "estimation errors alone."
)
MARKERS = "os^"  # of x, y and z: a print in grey shows them alone


@styled
def draw(hours: OverHours, wander: Wander) -> Figure:
    """Return the figure."""
    figure = laid_out(WIDE, 3.7)
    grid = figure.subplot_mosaic([["x", "allan"], ["y", "allan"], ["z", "allan"]])
    for i, name in enumerate(AXES):
        axes = grid[name]
        axes.errorbar(
            hours.t / MINUTE, hours.com[:, i] / UM, BAND * hours.sd[:, i] / UM, fmt="o",
            color=XYZ[i], elinewidth=0.8, markersize=2.5,
        )  # fmt: skip
        axes.set_ylabel(f"$r_{name}$, um")
    grid["z"].set_xlabel("time, min")
    axes = grid["allan"]
    for i, name in enumerate(AXES):
        error = wander.deviation[:, i] * np.minimum(wander.error, 0.9) / UM
        axes.errorbar(wander.span, wander.deviation[:, i] / UM, error, color=XYZ[i],
                      marker=MARKERS[i], capsize=2, label=name)  # fmt: skip
        axes.plot(wander.span, wander.measurements_alone[:, i] / UM, color=XYZ[i], linestyle="--")
    axes.set(xlabel="averaging time, s", ylabel="Allan deviation, um")
    plain_log(axes, "x")
    plain_log(axes, "y")
    with_legend(figure, axes)
    figure.align_ylabels([grid[name] for name in AXES])
    return figure
