"""Angular velocity along the fitted trajectory (Ivanov 2021 Fig. 8)."""

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.strokes import dots, line, mark_travel, panels, with_legend
from equipoise.app.figures.base.style import AXES, XYZ, styled
from equipoise.model.predicted_motion import PredictedMotion
from equipoise.model.recording import Recording
from equipoise.model.units import DEG

CAPTION = (
    "Angular velocity in body axes, deg/s: estimated model (lines) and gyro, where "
    "present (dots). Grey: masses move."
)


@styled
def draw(recording: Recording, after: PredictedMotion) -> Figure:
    """Return the figure."""
    figure, (axes,) = panels(1, height=2.8)
    for i, colour in enumerate(XYZ):
        if recording.rate is not None:
            dots(axes, recording.rate.t, recording.rate.values[:, i] / DEG, colour)
        line(axes, after.t, after.rate[:, i] / DEG, colour, f"$\\omega_{AXES[i]}$")
    axes.set_ylabel("angular velocity, deg/s")
    mark_travel([axes], recording)
    return with_legend(figure, axes)
