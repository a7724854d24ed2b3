"""What holds of every figure: ticks, units, markers, texts, and shades that grey prints keep."""

import ast
import re
from importlib.resources import files
from itertools import combinations

import numpy as np
import pytest

from tests.support import every_figure as every
from tests.support.every_figure import every_figure, greyness, texts_of, ticks_in_view

SMALLEST = 7.0  # points, of a letter in a figure
UNITS = r"deg/s|s/deg|1/deg|deg|degC|s|min|mm|um|uN m|N m|uT|m/s2|kg m2|kg cm|ms|Hz|%|rows"
DIMENSIONLESS = {
    "quaternion", "singularity index", "RMSE / bound", "recording", "sun sensor,\nunit vector",
}  # fmt: skip
OVERLAP = 1.5  # pixels, of boxes whose letters do not touch
LIGHTNESS_STEP = 0.1  # of lightness: what an eye tells in grey


@pytest.fixture(scope="module")
def figures():
    return every_figure()


def panels_of(figures):
    """Return every flat panel that is shown, with the name of its figure."""
    return [
        (name, axes)
        for name, figure in figures.items()
        for axes in figure.axes
        if axes.name == "rectilinear" and axes.get_visible()
    ]


def test_every_module_that_draws_is_here(figures):
    """A new figure has to stand among them: no module with a ``draw`` goes unused."""
    drawn = {name.split(".")[-1] for name in vars(every)}
    root = files("equipoise.app.figures")
    for folder in ("balancing", "estimate", "papers", "recording", "study"):
        for file in (root / folder).iterdir():
            if not file.name.endswith(".py"):
                continue
            names = {
                node.name
                for node in ast.parse(file.read_text("utf-8")).body
                if isinstance(node, ast.FunctionDef)
            }
            module = file.name.removesuffix(".py")
            if "draw" in names and module not in drawn:
                assert any(module in DRAWN_BY[key] for key in DRAWN_BY), module


DRAWN_BY = {
    "catalogue": {
        "attitude_fit", "residuals", "rates", "tracked_com", "tracked_rate", "moved_com",
        "balanced_com", "displacements", "table_friction",
    },
    "design_catalogue": {"reach", "torque_budget"},
}  # fmt: skip


def test_every_axis_has_two_ticks_or_more(figures):
    few = []
    for name, axes in panels_of(figures):
        for axis in (axes.xaxis, axes.yaxis):
            labelled = [t for t in ticks_in_view(axis) if t.get_text()]
            ticks = {round(tick, 12) for tick in axis.get_majorticklocs()}
            low, high = sorted(axis.get_view_interval())
            inside = [t for t in ticks if low <= t <= high]
            named = len(labelled) > 0 and labelled[0].get_text().replace(" ", "").isidentifier()
            if len(inside) == 1 and not named:
                few.append((name, axis.axis_name, axis.get_label_text()))
    assert few == []


def test_every_axis_names_its_unit(figures):
    """Or is known to have none; ticks that are names need no label."""
    wrong = []
    for name, axes in panels_of(figures):
        for axis in (axes.xaxis, axes.yaxis):
            label = re.sub(r"[${}^]", "", axis.get_label_text())
            unit = re.search(rf"(^|,|,? )\s*({UNITS})( rms)?$", label.replace("\n", " "))
            if label and label not in DIMENSIONLESS and not unit:
                wrong.append((name, label))
    assert wrong == []


def test_no_letter_is_too_small(figures):
    small = {
        (name, text, size)
        for name, figure in figures.items()
        for text, _, size in texts_of(figure)
        if size < SMALLEST and not text.startswith("$")
    }
    assert small == set()


def test_no_texts_overlap(figures):
    over = []
    for name, figure in figures.items():
        for (a, box, _), (b, other, _) in combinations(texts_of(figure), 2):
            wide = min(box.x1, other.x1) - max(box.x0, other.x0)
            high = min(box.y1, other.y1) - max(box.y0, other.y0)
            if min(wide, high) > OVERLAP:
                over.append((name, a, b))
    assert over == []


def test_no_text_leaves_the_figure(figures):
    beyond = []
    for name, figure in figures.items():
        width, height = figure.get_size_inches() * figure.dpi
        for text, box, _ in texts_of(figure):
            if min(box.x0, box.y0, width - box.x1, height - box.y1) < -1.0:
                beyond.append((name, text))
    assert beyond == []


def test_no_marker_is_cut(figures):
    """A marker whose middle lies in the panel lies in it with all of its radius."""
    cut = []
    for name, axes in panels_of(figures):
        box = np.array(axes.get_window_extent().extents).reshape(2, 2)
        for line in axes.lines:
            if line.get_marker() in ("None", "", None) or not line.get_clip_on():
                continue
            if line.get_transform() != axes.transData:
                continue
            at = axes.transData.transform(line.get_xydata())
            at = at[np.isfinite(at).all(axis=1)]
            radius = 0.5 * line.get_markersize() * axes.figure.dpi / 72
            inside = at[((at >= box[0]) & (at <= box[1])).all(axis=1)]
            room = np.minimum(inside - box[0], box[1] - inside)
            if len(room) and room.min() < 0.95 * radius:
                cut.append((name, line.get_marker(), float(room.min() / radius)))
    assert cut == []


def test_lines_of_a_panel_differ_without_colour(figures):
    """By their dashes, by their lightness, or by markers."""
    alike = []
    for name, axes in panels_of(figures):
        lines = [
            line
            for line in axes.lines
            if not line.get_label().startswith("_") and line.get_linestyle() != "None"
        ]
        for a, b in combinations(lines, 2):
            dashes = a._unscaled_dash_pattern == b._unscaled_dash_pattern
            shades = abs(greyness(a.get_color()) - greyness(b.get_color())) < LIGHTNESS_STEP
            if dashes and shades and a.get_marker() == b.get_marker():
                alike.append((name, a.get_label(), b.get_label()))
    assert alike == []
