"""A recording on one page: what is in it over time, where it is odd, and what that is."""

from collections.abc import Sequence

from equipoise.app.figures.base.canvas import Figure, sheet
from equipoise.app.figures.base.style import GREY, styled
from equipoise.app.figures.recording.record_marks import (
    LINE,
    listed,
    number,
    numbered,
    shade,
    write_list,
)
from equipoise.app.figures.recording.record_panels import panels_of
from equipoise.app.text.escaping import for_figure
from equipoise.model.arrays import Vector3
from equipoise.model.finding import Finding
from equipoise.model.recording import Recording

SIGNS = "! impairs an estimate   ~ corrected in reading   1, 2 ... marked above"
PAGE = (8.27, 11.69)  # inches, A4
LEFT, RIGHT = 0.135, 0.895  # of the page
LABELS = -0.092  # of a panel's width: labels of the vertical axes stand under each other
HEAD = 0.9  # inches above the panels: title, numbers of the marks
FOOT = 0.4  # inches below the list: what its signs mean
BETWEEN = 0.62  # inches between panels and list: the time axis
PANEL = 0.85  # inches: panels are never lower than this; then the list is cut


@styled
def draw(recording: Recording, found: Sequence[Finding] = (), up: Vector3 | None = None) -> Figure:
    """Return the page; without ``up`` (a body axis) the most upright one is taken."""
    figure = sheet(*PAGE)
    panels, span = panels_of(recording, up), recording.span
    marked = numbered(found, span)
    lines = listed(found, marked)
    room = PAGE[1] - HEAD - BETWEEN - FOOT
    most = min(len(lines), int((room - PANEL * len(panels)) / LINE))
    bottom = (FOOT + most * LINE + BETWEEN) / PAGE[1]
    grid = figure.subplots(
        len(panels), 1, sharex=True, squeeze=False,
        gridspec_kw={"left": LEFT, "right": RIGHT, "bottom": bottom, "hspace": 0.16,
                     "top": 1 - HEAD / PAGE[1]},
    )[:, 0]  # fmt: skip
    for axes, panel in zip(grid, panels, strict=True):
        panel(axes)
        axes.yaxis.set_label_coords(LABELS, 0.5)
    air = 0.01 * (span[1] - span[0])
    grid[-1].set_xlim(span[0] - air, span[1] + air)
    grid[-1].set_xlabel("time, s")
    shade(list(grid), marked, span)
    number(grid[0], marked, span)
    figure.text(0.03, 1 - 0.25 / PAGE[1], _title(recording), fontsize=10, weight="bold", va="top")
    figure.text(0.03, 0.14 / PAGE[1], SIGNS, fontsize=7.5, color=GREY)
    write_list(figure, lines, most, 0.03, bottom - (BETWEEN - 0.02) / PAGE[1])
    return figure


def _title(recording: Recording) -> str:
    start, end = recording.span
    source = recording.source.replace("\\", "/").rsplit("/", 1)[-1] or "recording"
    return f"{for_figure(source)}: {start:.4g} to {end:.6g} s"
