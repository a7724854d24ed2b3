"""Centre of mass estimated by the tracker, masses at rest (Ivanov 2021 Fig. 12)."""

import numpy as np

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.com_panels import draw_com, draw_truth
from equipoise.app.figures.base.strokes import panels, with_legend
from equipoise.app.figures.base.style import styled
from equipoise.model.arrays import Vector3
from equipoise.model.estimate import Course
from equipoise.model.recording import Recording

CAPTION = (
    "Centre of mass with the masses at home, estimated by the tracker (Kalman "
    "filter), um in body axes. Bands: two standard deviations. Dashed, if drawn: "
    "simulated truth."
)


@styled
def draw(course: Course, recording: Recording, truth: Vector3 | None = None) -> Figure:
    """Return the figure; ``truth`` (m) is drawn when the bench is simulated."""
    figure, column = panels(3, height=1.0)
    draw_com(column, course, recording)
    if truth is not None:
        draw_truth(column, course.t[[0, -1]], np.array([truth, truth]))
    return with_legend(figure, column[0])
