"""What the fitted model leaves of the measured attitude (Ivanov 2021 Fig. 7, as angles)."""

import numpy as np

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.strokes import around, dots, mark_travel, panels
from equipoise.app.figures.base.style import AXES, BAND, GREY, XYZ, styled
from equipoise.maths.attitude import difference
from equipoise.model.predicted_motion import PredictedMotion
from equipoise.model.recording import Recording
from equipoise.model.units import DEG

CAPTION = (
    "Attitude residuals (measured minus estimated) about each body axis, deg. Grey "
    "band: two standard deviations of the stated camera noise; grey strips: masses "
    "move."
)


@styled
def draw(recording: Recording, after: PredictedMotion, noise: float | None) -> Figure:
    """Return the figure; ``noise`` is the camera's stated sd in rad, if there is one."""
    measured = recording.attitude
    assert measured is not None
    left = difference(measured.values, after.q) / DEG
    figure, column = panels(3, height=1.15)
    column[0].set_ylim(around(left, np.zeros(3)))
    for i, axes in enumerate(column):
        if i:
            axes.sharey(column[0])
        if noise is not None:
            limit = BAND * noise / DEG
            axes.axhspan(-limit, limit, color=GREY, alpha=0.12, linewidth=0)
        axes.axhline(0, color=GREY, linewidth=0.7)
        dots(axes, measured.t, left[:, i], XYZ[i])
        axes.set_ylabel(f"{AXES[i]}, deg")
        mark_travel([axes], recording)
    column[0].set_title("measured less predicted attitude")
    figure.align_ylabels()
    return figure
