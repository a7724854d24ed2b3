"""The places of panels on a figure, and of the labels beside them, measured a few times.

Each column is as wide, and each row as high, as what is beside its panels leaves. Labels of a
column's vertical axes stand below each other, and so do those of a row. matplotlib's own way
("constrained layout") measures every text many times over, which takes longer than the drawing.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from equipoise.app.figures.base.canvas import Axes, Figure
from equipoise.model.arrays import Floats

PAD = 3 / 72  # inches around each panel and what is beside it, chosen: as matplotlib has it
POINT = 1 / 72  # inches
AGAIN = 3  # times at most, chosen: a panel of another size may have other ticks, longer or shorter


class Beside(NamedTuple):
    """How far something reaches beyond each side of a panel, inches."""

    left: float
    bottom: float
    right: float
    top: float


GUESSED = Beside(0.5, 0.2, 0.05, 0.05)  # near enough that a panel has the ticks it has when placed


def arrange(figure: Figure) -> None:
    """Place the panels of a figure, which are all of one grid, below its legends."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    renderer: Any = FigureCanvasAgg(figure).get_renderer()
    figure.set_layout_engine(None)  # it is placed by hand
    heights = [legend.get_window_extent(renderer).height for legend in figure.legends]
    head = sum(height / figure.dpi + 2 * PAD for height in heights)
    place(figure, [GUESSED] * len(figure.axes), head)
    numbers, around = _numbers(figure), _placed(figure, renderer, head)
    for _ in range(AGAIN):
        if numbers == (numbers := _numbers(figure)):
            break
        around = _placed(figure, renderer, head)
    hold_ticks(figure)
    for axes, ticks in zip(figure.axes, around, strict=True):
        axes.apply_aspect()  # as drawing does
        width, height = axes.get_position().size * figure.get_size_inches()
        axes.yaxis.set_label_coords(-(ticks.left + axes.yaxis.labelpad * POINT) / width, 0.5)
        axes.xaxis.set_label_coords(0.5, -(ticks.bottom + axes.xaxis.labelpad * POINT) / height)


def hold_ticks(figure: Figure) -> None:
    """Keep the ticks as they were measured; drawn at other dots an inch, they might be others."""
    from matplotlib.ticker import FixedLocator

    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(FixedLocator([float(tick) for tick in axis.get_majorticklocs()]))


def _placed(figure: Figure, renderer: Any, head: float) -> list[Beside]:
    """Place panels by what is beside them as they are; return what their ticks took."""
    around = aligned(figure, [_ticks(axes, renderer, figure.dpi) for axes in figure.axes])
    labels = [_labels(axes, renderer, figure.dpi) for axes in figure.axes]
    grown = [
        ticks._replace(left=ticks.left + label.left, bottom=ticks.bottom + label.bottom)
        for ticks, label in zip(around, labels, strict=True)
    ]
    place(figure, grown, head)
    return around


def _numbers(figure: Figure) -> list[str]:
    """Return the numbers at all ticks."""
    both = [axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)]
    return [label.get_text() for axis in both for label in axis.get_majorticklabels()]


def place(figure: Figure, around: Sequence[Beside], head: float) -> None:
    """Give panels the places that what is around each, and the ``head`` above, inches, leave."""
    cells = cells_of(figure)
    grid = cells[0].get_gridspec()
    left, right, bottom, top = (np.zeros(n) for n in (grid.ncols, grid.ncols, *[grid.nrows] * 2))
    for cell, beside in zip(cells, around, strict=True):
        across, down = cell.colspan, cell.rowspan
        for sides, k, size in (
            (left, across.start, beside.left), (right, across.stop - 1, beside.right),
            (top, down.start, beside.top), (bottom, down.stop - 1, beside.bottom),
        ):  # fmt: skip
            sides[k] = max(sides[k], size)
    width, height = figure.get_size_inches()
    columns = _shared(width, left + PAD, right + PAD, grid.get_width_ratios())
    rows = _shared(height - head, top + PAD, bottom + PAD, grid.get_height_ratios())
    for axes, cell in zip(figure.axes, cells, strict=True):
        across, down = cell.colspan, cell.rowspan
        x = np.array([columns[across.start, 0], columns[across.stop - 1, 1]]) / width
        y = 1 - (head + np.array([rows[down.start, 0], rows[down.stop - 1, 1]])) / height
        axes.set_position((x[0], y[1], x[1] - x[0], y[0] - y[1]))


def cells_of(figure: Figure) -> list[Any]:
    """Return which columns and rows of the grid each panel takes."""
    return [axes.get_subplotspec() for axes in figure.axes]


def aligned(figure: Figure, around: Sequence[Beside]) -> list[Beside]:
    """Return the same with as much on the left in each column, and below each row."""
    starts = [cell.colspan.start for cell in cells_of(figure)]
    ends = [cell.rowspan.stop for cell in cells_of(figure)]
    left = {c: max(a.left for a, s in zip(around, starts, strict=True) if s == c) for c in starts}
    below = {r: max(a.bottom for a, e in zip(around, ends, strict=True) if e == r) for r in ends}
    return [
        each._replace(left=left[start], bottom=below[end])
        for each, start, end in zip(around, starts, ends, strict=True)
    ]


def _shared(size: float, before: Floats, behind: Floats, ratios: Sequence[float]) -> Floats:
    """Return where each column begins and ends (n, 2), of a width that all of them share."""
    free = size - float(np.sum(before + behind))
    own = free * np.array(ratios) / sum(ratios)
    ends = np.cumsum(before + own + behind) - behind
    return np.column_stack([ends - own, ends])


def _ticks(axes: Axes, renderer: Any, dpi: float) -> Beside:
    """Return how far ticks, titles and legends reach beyond a panel."""
    axes.apply_aspect()
    both = (axes.xaxis, axes.yaxis)
    boxes: list[Any] = []
    for axis in both:
        axis.set_label_coords(0.5, 0.5)  # else each is placed by the ticks of all in its column
        axis.label.set_visible(False)
        boxes.append(axis.get_tightbbox(renderer))
        axis.label.set_visible(True)
        axis.set_visible(False)
    boxes.append(axes.get_tightbbox(renderer, for_layout_only=True))
    for axis in both:
        axis.set_visible(True)
    panel = axes.get_window_extent(renderer)
    ends = np.array([box.extents for box in boxes if box is not None])
    low, high = ends[:, :2].min(axis=0), ends[:, 2:].max(axis=0)
    left, bottom = np.maximum(panel.min - low, 0.0) / dpi
    right, top = np.maximum(high - panel.max, 0.0) / dpi
    return Beside(left, bottom, right, top)


def _labels(axes: Axes, renderer: Any, dpi: float) -> Beside:
    """Return how much further the labels of the axes reach."""
    left = below = 0.0
    if axes.get_ylabel():
        left = axes.yaxis.label.get_window_extent(renderer).width / dpi
        left += axes.yaxis.labelpad * POINT
    if axes.get_xlabel():
        below = axes.xaxis.label.get_window_extent(renderer).height / dpi
        below += axes.xaxis.labelpad * POINT
    return Beside(left, below, 0.0, 0.0)
