"""Measured attitude and the model's, before and after estimation (Ivanov 2021 Fig. 6)."""

import numpy as np

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.strokes import (
    line_of_several,
    mark_travel,
    panels,
    rings,
    with_legend,
)
from equipoise.app.figures.base.style import SEVERAL, styled
from equipoise.maths.attitude import continuous
from equipoise.model.arrays import Series4
from equipoise.model.recording import Recording, Samples
from equipoise.procedure.identification.record_courses import FitMotions

COMPONENTS = ("q0", "q1", "q2", "q3")
CAPTION = (
    "Attitude quaternion (body to laboratory, scalar first), measured (circles, a "
    "selection) and of the model (lines): (a) predicted with the testbed's values, (b) "
    "fitted. Grey: masses move."
)


@styled
def draw(recording: Recording, motions: FitMotions) -> Figure:
    """Return the figure; the recording needs a camera."""
    measured, fitted = recording.attitude, motions.fitted.attitude
    assert measured is not None
    assert fitted is not None
    q = continuous(measured.values)
    figure, column = panels(2, height=1.45)
    titles = ("(a) before estimation", "(b) after estimation")
    before = Samples(motions.before.t, motions.before.q)
    for axes, model, title in zip(column, (before, fitted), titles, strict=True):
        at = np.searchsorted(measured.t, model.t).clip(max=len(measured) - 1)
        shown = nearest_sign(model.values, q[at])
        for i, name in enumerate(COMPONENTS):
            rings(axes, measured.t, q[:, i], SEVERAL[i])
            line_of_several(axes, i, model.t, shown[:, i], name)
        axes.set(title=title, ylabel="quaternion", ylim=(-1.08, 1.08))
        mark_travel([axes], recording)
    return with_legend(figure, column[0])


def nearest_sign(q: Series4, other: Series4) -> Series4:
    """Return q with the signs that bring each row nearest to the other's."""
    return q * np.where(np.sum(q * other, axis=1) < 0, -1.0, 1.0)[:, None]
