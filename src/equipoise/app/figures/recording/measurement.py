"""The recording of one measurement, small enough to stand below its step in a report."""

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.strokes import panels
from equipoise.app.figures.base.style import styled
from equipoise.app.figures.recording.record_panels import panels_of_motion
from equipoise.model.arrays import Vector3
from equipoise.model.recording import Recording

CAPTION = (
    "Recorded channels: tilt and heading rate from the camera (deg, deg/s), rate from "
    "the gyro (deg/s), displacement of the masses from home (mm)."
)


@styled
def draw(recording: Recording, up: Vector3 | None) -> Figure:
    """Return the figure; ``up`` is the body axis whose tilt is shown."""
    parts = panels_of_motion(recording, up)
    figure, column = panels(max(len(parts), 1), height=0.75)
    for axes, part in zip(column, parts, strict=False):
        part(axes)
    figure.align_ylabels()
    return figure
