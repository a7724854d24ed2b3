"""Angular velocity estimated by the tracker (Ivanov 2021 Fig. 11)."""

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.strokes import (
    band,
    line_of_several,
    mark_travel,
    panels,
    with_legend,
)
from equipoise.app.figures.base.style import AXES, XYZ, styled
from equipoise.model.estimate import Course
from equipoise.model.recording import Recording
from equipoise.model.units import DEG

CAPTION = (
    "Angular velocity in body axes, estimated by the tracker (Kalman filter), deg/s. "
    "Bands: two standard deviations."
)
SETTLED = 0.05  # share of the rows before the scale is taken; chosen: the filter starts at rest


@styled
def draw(course: Course, recording: Recording) -> Figure:
    """Return the figure of an angular velocity, rad/s."""
    figure, (axes,) = panels(1, height=2.5)
    for i, colour in enumerate(XYZ):
        rate, sd = course.values[:, i] / DEG, course.sd[:, i] / DEG
        band(axes, course.t, rate, sd, colour)
        line_of_several(axes, i, course.t, rate, f"$\\omega_{AXES[i]}$")
    settled = course.values[int(SETTLED * len(course.t)) :] / DEG
    low, high = float(settled.min()), float(settled.max())
    air = 0.15 * (high - low)
    axes.set(ylabel="angular velocity, deg/s", ylim=(low - air, high + air))
    mark_travel([axes], recording)
    return with_legend(figure, axes)
