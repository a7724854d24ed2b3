"""Angular velocity along the fitted trajectory (Ivanov 2021 Fig. 8)."""

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.strokes import (
    dots,
    line,
    mark_travel,
    panels,
    with_legend,
)
from equipoise.app.figures.base.style import AXES, XYZ, styled
from equipoise.model.recording import Recording
from equipoise.model.units import DEG
from equipoise.procedure.identification.fitted_motion import FittedMotion


def caption(fitted: FittedMotion) -> str:
    """Return what the figure shows."""
    if fitted.gyro is None:
        return "Angular velocity of the fitted model in body axes, deg/s. Grey: masses move."
    return (
        "Angular velocity in body axes, deg/s: fitted model (lines) and gyro (dots), without its "
        "estimated bias, scale errors and misalignment. Grey: masses move."
    )


@styled
def draw(recording: Recording, fitted: FittedMotion) -> Figure:
    """Return the figure."""
    figure, column = panels(3, height=0.95)
    gyro, rate = fitted.gyro, fitted.rate
    for i, axes in enumerate(column):
        if gyro is not None:
            dots(axes, gyro.t, gyro.values[:, i] / DEG, XYZ[i], "gyro")
        colour = XYZ[i] if gyro is None else "black"
        line(axes, rate.t, rate.values[:, i] / DEG, colour, "model")
        axes.set_ylabel(f"$\\omega_{AXES[i]}$, deg/s")
    mark_travel(column, recording)
    return with_legend(figure, column[0])
