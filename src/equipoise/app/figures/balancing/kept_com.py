"""The centre of mass while a platform is kept balanced."""

import numpy as np

from equipoise.app.figures.base.canvas import Figure, laid_out
from equipoise.app.figures.base.strokes import with_legend
from equipoise.app.figures.base.style import AXES, BAND, WIDE, XYZ, styled
from equipoise.model.arrays import Series3, Vector3
from equipoise.model.estimate import Course
from equipoise.model.units import MINUTE, UM

CAPTION = (
    "Centre of mass while the platform was kept balanced, um from the target, body axes (band: two "
    "standard deviations; dashed: tolerance; dotted: truth, where simulated)."
)


@styled
def draw(course: Course, truth: Series3 | None, target: Vector3, tolerance: Vector3) -> Figure:
    """Return the figure."""
    figure = laid_out(WIDE, 3.6)
    panels = figure.subplots(3, 1, sharex=True)
    t = course.t / MINUTE
    for i, (name, axes) in enumerate(zip(AXES, panels, strict=True)):
        off, band = (course.values[:, i] - target[i]) / UM, BAND * course.sd[:, i] / UM
        axes.fill_between(t, off - band, off + band, color=XYZ[i], alpha=0.25, linewidth=0)
        axes.plot(t, off, color=XYZ[i], label="estimate")
        if truth is not None:
            true = (truth[:, i] - target[i]) / UM
            axes.plot(t, true, color="0.2", linestyle=":", label="truth")
        limit = tolerance[i] / UM
        for edge in (-limit, limit):
            axes.axhline(edge, color="0.5", linestyle="--", linewidth=0.8)
        most = max(1.5 * limit, float(np.abs(off).max(initial=0.0)) * 1.1)
        axes.set_ylim(-most, most)
        axes.set_ylabel(f"$r_{name}$, um")
    panels[-1].set_xlabel("bench time, min")
    if truth is not None:
        with_legend(figure, panels[0])
    figure.align_ylabels(panels)
    return figure
