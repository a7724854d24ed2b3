"""Every figure draws what it is given, names its units, and needs no window.

Warnings (a layout that collapses, a missing glyph) are errors in this project.
"""

import os
import subprocess
import sys

import matplotlib as mpl
import numpy as np
import pytest

from equipoise.app.figures.balancing.story import Story
from equipoise.app.figures.base.files import rendered
from equipoise.app.figures.base.strokes import MOST, thinned
from equipoise.app.figures.base.style import STYLE
from equipoise.app.figures.catalogue import of_balancing, of_fit, of_move, of_tracking
from equipoise.app.figures.recording import record
from equipoise.app.runs.demonstration import measured
from equipoise.estimation.model_selection import reference_fit
from equipoise.estimation.output_error import trajectory
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Recording, Samples, window
from equipoise.procedure.identification.record_courses import fit_motions, tracked_courses
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.free_start import freely
from tests.support import thorough

BED = read_preset("sputnix")
PNG = b"\x89PNG"


@pytest.fixture(scope="module")
def pictures():
    recording, truth = freely(BED, 1, measured)[1]
    estimate = reference_fit.estimate(recording, BED, trajectory.Params())
    measurements = [(30.0, truth[1][0], np.full(3, 1e-6)), (90.0, truth[1][-1], np.full(3, np.inf))]
    story = Story(measurements, np.array([0, 0, -1e-4]), np.array([2e-6, 2e-6, 3e-6]), truth)
    motions, still = fit_motions(recording, BED, estimate), window(recording, 0.0, 60.0)
    moved = tracked_courses(recording, BED, estimate, compare=True)
    found = [
        *of_fit(recording, motions),
        *of_tracking(still, tracked_courses(still, BED, estimate), truth[1][0]),
        *of_move(recording, moved, truth),
        *of_balancing(recording, BED, moved, story),
    ]
    return {picture.name: picture for picture in found}


NAMES = {
    "figure06_attitude": "quaternion",
    "figure07_residual": "deg",
    "figure08_rate": "deg/s",
    "figure11_tracked_rate": "deg/s",
    "figure12_tracked_com": "um",
    "figure13_move": "um",
    "figure14_balancing": "um",
    "figure15_displacements": "mm",
}


@pytest.mark.parametrize(("name", "unit"), NAMES.items())
def test_a_figure_has_units_and_ink(pictures, name, unit):
    figure, caption = pictures[name].figure, pictures[name].caption
    assert all(axes.lines or axes.collections for axes in figure.axes)
    assert unit in " ".join(axes.get_ylabel() for axes in figure.axes)
    assert "s" in figure.axes[-1].get_xlabel()
    assert caption.endswith(".")
    assert rendered(figure).startswith(PNG)


def test_no_figure_is_missing(pictures):
    assert set(pictures) == set(NAMES)


def test_the_same_figure_gives_the_same_bytes(pictures):
    figure = pictures["figure08_rate"].figure
    for kind in ("png", "svg", "pdf"):
        assert rendered(figure, kind) == rendered(figure, kind)


def test_drawing_leaves_matplotlib_as_it_was(pictures):
    """The caller may be drawing, too."""
    assert pictures
    assert mpl.rcParams["axes.grid"] != STYLE["axes.grid"]


def test_no_window_is_ever_thought_of():
    code = (
        "import sys, equipoise.app.runs.demonstration; "
        "assert 'matplotlib.pyplot' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


DRAWN_FOR_FILES = """
import sys
from pathlib import Path
import equipoise as eq
from equipoise.app.cli import run
from equipoise.app.figures.base.files import write_figure
figure = eq.simulate("sputnix", duration=10.0, seed=1).plot()
for kind in ("png", "svg", "pdf"):
    write_figure(figure, Path(f"a.{kind}"))
assert run(["print-board", "--out", "board.pdf"]) == 0
sys.exit(run(["simulate", "sputnix", "--duration-s", "10", "--out", "b.csv"])
         or run(["inspect", "b.csv", "--figure", "b.png"]))
"""


BACKENDS = ["module://matplotlib_inline.backend_inline", "none_such"]


@pytest.mark.parametrize("backend", thorough.some(BACKENDS, 1))
def test_a_backend_that_cannot_be_imported_breaks_no_figure(tmp_path, backend):
    """A notebook names its own for every program that it starts."""
    done = subprocess.run(
        [sys.executable, "-c", DRAWN_FOR_FILES],
        cwd=tmp_path,
        env={**os.environ, "MPLBACKEND": backend},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    names = ("a.pdf", "a.png", "a.svg", "b.csv", "b.png", "board.pdf")
    assert {path.name for path in tmp_path.iterdir()} >= {*names}


def test_a_backend_that_can_be_used_stays_as_it_was_named():
    """The caller may draw windows of its own."""
    code = (
        "import equipoise.app.figures.base.style, matplotlib, os; "
        "print(matplotlib.rcParams['backend'], os.environ['MPLBACKEND'])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "MPLBACKEND": "svg"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.split() == ["svg", "svg"]


def test_the_model_leaves_noise_in_figure_7(pictures):
    """The prediction knows where masses really stopped: nine dots in ten lie in the 2 sd band."""
    for axes in pictures["figure07_residual"].figure.axes[::3]:  # rows, density, correlation
        dots = next(line.get_ydata() for line in axes.lines if len(line.get_ydata()) > 100)
        assert np.mean(np.abs(dots) < 0.4) > 0.9


def labels(page) -> str:
    return " ".join(axes.get_ylabel() for axes in page.axes)


def words(page) -> list[str]:
    """All that is written on a page, outside its axes and as marks above them."""
    page.draw_without_rendering()
    return [text.get_text() for text in (*page.texts, *page.axes[0].texts)]


def test_a_recording_has_a_panel_for_each_thing_that_it_holds():
    """Tilt, heading rate, masses, roughness, spacing: no gyro, no panel for one."""
    whole = SimulatedBench(BED, seed=1).read(20.0)
    assert len(record.draw(whole).axes) == 5
    t = np.arange(100) * 0.05
    gyro = Recording(rate=Samples(t, 0.1 * np.sin(np.outer(t, [1, 2, 3]))))
    assert "gyro" in labels(record.draw(gyro))
    assert "tilt" not in labels(record.draw(gyro))
    short = Recording(rate=Samples(t[:3], np.ones((3, 3))))
    assert rendered(record.draw(short)).startswith(PNG)


def said(text):
    """Return a finding's reasons with this sentence."""
    return one_reason(FindingReason.SET_RIGHT, text)


def test_findings_are_marked_where_they_are_and_listed():
    """The gap is shaded from 20 to 48 s in every panel; each has its number, its word, its line."""
    t = np.r_[0:20:0.1, 48:60:0.1]
    q = exponential(np.outer(t, [0, 0, 0.3]))
    gap = Finding("problem", said("a gap of 28 s."), (20.0, 48.0), "gap")
    touch = Finding("problem", said("a touch."), (10.0, 10.0), "touch")
    rest = Finding("content", said("a record."), (0.0, 60.0))
    page = record.draw(Recording(attitude=Samples(t, q)), (rest, gap, touch))
    for axes in page.axes:
        shades = [p.get_extents().transformed(axes.transData.inverted()) for p in axes.patches]
        assert [(round(s.x0), round(s.x1)) for s in shades] == [(10, 10), (20, 48)]
    assert {"1 touch", "2 gap", "a gap of 28 s.", "a touch.", "a record."} <= set(words(page))


def test_a_long_list_leaves_room_for_the_panels_and_says_what_it_leaves_out():
    t = np.arange(100) * 0.1
    many = [Finding("problem", said(f"problem {k}."), (0.05 * k, 0.05 * k)) for k in range(150)]
    page = record.draw(Recording(attitude=Samples(t, exponential(np.outer(t, [0, 0, 1])))), many)
    assert any("more lines" in text for text in words(page))
    assert min(axes.get_position().height for axes in page.axes) * page.get_figheight() > 0.6


@pytest.mark.parametrize("n", [1, MOST, 10 * MOST, 10**6])
def test_long_records_are_thinned(n):
    assert len(range(n)[thinned(n)]) <= 2 * MOST
