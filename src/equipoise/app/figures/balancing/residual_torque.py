"""The torque that acted on the platform, with the noise of its measurement."""

import numpy as np

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.strokes import line, panels, with_legend
from equipoise.app.figures.base.style import AXES, BAND, XYZ, styled
from equipoise.model.noise_corrected_series import NoiseCorrectedSeries
from equipoise.model.units import UN_M

CAPTION = (
    "Torque on the platform in body axes, from its motion and inertia "
    "(Savitzky-Golay). Shaded: two standard deviations of the noise without torque, "
    "averaged over the axes."
)


@styled
def draw(response: NoiseCorrectedSeries) -> Figure:
    """Return the figure."""
    figure, column = panels(3, height=1.0)
    noise = BAND * response.noise / np.sqrt(3) / UN_M
    for i, axes in enumerate(column):
        axes.axhspan(-noise, noise, color="black", alpha=0.12, linewidth=0, label="noise")
        line(axes, response.t, response.values[:, i] / UN_M, XYZ[i], "torque" if i == 0 else "")
        axes.set_ylabel(f"{AXES[i]}, uN m")
    return with_legend(figure, column[0])
