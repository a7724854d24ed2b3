"""Panels stand where what is beside them leaves room: nothing overlaps, nothing is cut off."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from equipoise.app.figures.base.arrangement import PAD, arrange
from equipoise.app.figures.base.canvas import laid_out
from equipoise.app.figures.base.files import rendered
from equipoise.app.figures.base.strokes import line, panel_grid, with_legend
from equipoise.app.figures.base.style import WIDE, styled

T = np.linspace(0.0, 60.0, 50)


@styled
def drawn(rows, columns):
    """Return an arranged figure whose panels have labels of different lengths."""
    figure, grid = panel_grid(rows, columns, height=1.3)
    for k, axes in enumerate(axes for row in grid for axes in row):
        line(axes, T, 10.0 ** (2 * k) * np.sin(T), "black", f"panel {k}")
        axes.set_ylabel("rate,\ndeg/s" if k else "tilt, deg")
        axes.set_title(f"({k})")
    with_legend(figure, grid[0][0])
    arrange(figure)
    return figure


def boxes_of(figure):
    """Return where each panel with all that is beside it stands, and the figure, in inches."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    every = [axes.get_tightbbox(renderer) for axes in figure.axes]
    every += [legend.get_window_extent(renderer) for legend in figure.legends]
    return np.array([box.extents for box in every]) / figure.dpi, figure.get_size_inches()


SHAPES = pytest.mark.parametrize(("rows", "columns"), [(1, 1), (3, 1), (2, 2)])


@SHAPES
def test_nothing_is_cut_off(rows, columns):
    boxes, (width, height) = boxes_of(styled(drawn)(rows, columns))
    assert boxes[:, :2].min() > 0
    assert boxes[:, 2].max() < width
    assert boxes[:, 3].max() < height + PAD


@SHAPES
def test_nothing_overlaps(rows, columns):
    boxes, _ = boxes_of(styled(drawn)(rows, columns))
    for k, (left, bottom, right, top) in enumerate(boxes):
        for a, b, c, d in boxes[:k]:
            assert right <= a or c <= left or top <= b or d <= bottom


def test_the_room_is_used():
    """To the paddings: what is beside the panels reaches the edges."""
    boxes, (width, _) = boxes_of(styled(drawn)(3, 1))
    panels = boxes[:3]
    assert panels[:, 0].min() == pytest.approx(PAD, abs=0.03)
    assert panels[:, 2].max() == pytest.approx(width - PAD, abs=0.03)
    assert panels[:, 1].min() == pytest.approx(PAD, abs=0.03)


def test_panels_of_a_column_are_alike_and_their_labels_stand_below_each_other():
    figure = drawn(3, 1)
    places = np.array([axes.get_position().bounds for axes in figure.axes])
    assert places[:, 0] == pytest.approx(places[0, 0])
    assert places[:, 2:] == pytest.approx(np.tile(places[0, 2:], (3, 1)))
    labels = [axes.yaxis.label for axes in figure.axes]
    ends = [label.get_transform().transform(label.get_position())[0] for label in labels]
    assert ends == pytest.approx([ends[0]] * 3)


def test_a_figure_is_arranged_once():
    figure = drawn(2, 1)
    assert rendered(figure, "svg") == rendered(figure, "svg")


@styled
def test_labels_stand_at_a_panel_that_is_narrower_than_its_place():
    """Of equal scales, it takes less than the grid leaves: a label keeps its distance."""
    figure = laid_out(6.0, 2.0)
    for axes in figure.subplots(1, 2):
        axes.plot([0.0, 1.0], [0.0, 1.0])
        axes.set_aspect("equal")
        axes.set_ylabel("y, um")
    arrange(figure)
    renderer = FigureCanvasAgg(figure).get_renderer()
    for axes in figure.axes:
        label = axes.yaxis.label.get_window_extent(renderer).x1
        axes.yaxis.label.set_visible(False)
        ticks = axes.yaxis.get_tightbbox(renderer).x0
        assert 0 < ticks - label < 0.15 * figure.dpi


@styled
def test_numbers_that_grow_longer_in_a_panel_of_its_place_keep_off_the_label():
    """A higher panel has more ticks: 0.0225 where 0.02 stood before."""
    figure = laid_out(WIDE, 6.4)
    for axes in figure.subplots(3, 3).flat:
        axes.plot([0.0, 1.0], [0.019, 0.0355])
        axes.set_xticks([])
        axes.set_ylabel("inertia_P_xz, kg m2")
    arrange(figure)
    renderer = FigureCanvasAgg(figure).get_renderer()
    for axes in figure.axes:
        label = axes.yaxis.label.get_window_extent(renderer).x1
        axes.yaxis.label.set_visible(False)
        assert label < axes.yaxis.get_tightbbox(renderer).x0
