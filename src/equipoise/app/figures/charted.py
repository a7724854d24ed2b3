"""The still drawing of a chart that has no figure of its own."""

import numpy as np

from equipoise.app.figures.base.canvas import Axes, Figure, laid_out
from equipoise.app.figures.base.strokes import course, dots, with_legend
from equipoise.app.figures.base.style import GREY, PURPLE, SIX, WIDE, styled
from equipoise.app.text.charts import Chart, Numbers, Panel, Rows
from equipoise.app.text.numbers import typeset
from equipoise.model.arrays import Floats

HEIGHT = 1.9  # inches of a panel, chosen
BAR = 0.27  # of a bin, chosen: three columns stand side by side
AXIS_COLOURS = {"x": 0, "y": 2, "z": 4}  # of SIX: those of axes in all figures


@styled
def draw(chart: Chart) -> Figure:
    """Return the figure, a panel below the other."""
    figure = laid_out(WIDE, HEIGHT * len(chart.panels) + 0.7)
    column = figure.subplots(len(chart.panels), 1, sharex=True, squeeze=False)[:, 0]
    for axes, panel in zip(column, chart.panels, strict=True):
        _draw_panel(axes, panel)
        for start, end in chart.shaded:
            axes.axvspan(start, end, color="#cccccc", alpha=0.35, linewidth=0, zorder=0)
    column[-1].set_xlabel(_with_unit(chart.axis, chart.axis_unit))
    return with_legend(figure, column[0])


def _with_unit(name: str, unit: str) -> str:
    return ", ".join(filter(None, (name, typeset(unit))))


def _draw_panel(axes: Axes, panel: Panel) -> None:
    axes.set(title=panel.title, ylabel=typeset(panel.unit))
    if panel.band is not None:
        axes.axhspan(-panel.band, panel.band, color=GREY, alpha=0.12, linewidth=0)
    for rows in panel.rows:
        for k, (name, values) in enumerate(zip(rows.names, rows.columns, strict=True)):
            _draw_column(axes, rows, k, name, _known(values))
    if panel.scale is not None:
        axes.set_ylim(*panel.scale)


def _draw_column(axes: Axes, rows: Rows, k: int, name: str, y: Floats) -> None:
    x = np.array(rows.x)
    axis = AXIS_COLOURS.get(name[-1])
    colour = PURPLE if len(rows.names) == 1 else SIX[(2 * k if axis is None else axis) % len(SIX)]
    if rows.mark == "line":
        course(axes, x, y, colour, name)
    elif rows.mark == "dots":
        dots(axes, x, y, colour, name)
    else:
        width = BAR * float(np.median(np.diff(x)))
        axes.bar(x + (k - 1) * width, y, width, color=colour, label=name)


def _known(values: Numbers) -> Floats:
    return np.array([np.nan if value is None else value for value in values])
