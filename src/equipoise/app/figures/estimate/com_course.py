"""Centre of mass along a record, estimated by a recursive method."""

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.com_panels import draw_com
from equipoise.app.figures.base.strokes import panels, with_legend
from equipoise.app.figures.base.style import styled
from equipoise.model.estimate import COM, Course
from equipoise.model.recording import Recording

CAPTION = (
    "Centre of mass with the masses at home along the record, um in body axes. Bands: "
    "two standard deviations."
)


@styled
def draw(course: Course, method: str, recording: Recording) -> Figure:
    """Return the figure of a course that has the centre of mass."""
    where = [course.names.index(name) for name in COM]
    figure, column = panels(3, height=1.0)
    com = Course(COM, course.t, course.values[:, where], course.sd[:, where])
    draw_com(column, com, recording, method)
    return with_legend(figure, column[0])
