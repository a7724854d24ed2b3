"""A view draws what the tracker found: no figure runs the filter again."""

import numpy as np
import pytest

from equipoise.app.runs.balancing import Balancing
from equipoise.app.runs.demonstration import GOAL, measured
from equipoise.app.runs.recordings.identification import Identification
from equipoise.app.views.balancing.balance_views import pictures_of, pictures_of_tracking
from equipoise.app.views.identify_views import record_of
from equipoise.estimation.tracker import tracker
from equipoise.io.testbed.presets import read_preset
from equipoise.model.recording import window
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.procedure.identification.record_courses import balancing_courses
from equipoise.simulation.bench import SimulatedBench

BED, TRACKER = read_preset("sputnix"), IdentifyOptions("tracker")


@pytest.fixture
def filter_runs(monkeypatch):
    """Return a list that grows by one item, the way moves are taken, whenever the filter runs."""
    runs, track = [], tracker.track

    def counted(recording, testbed, params, state):
        runs.append(params.moves)
        return track(recording, testbed, params, state)

    monkeypatch.setattr(tracker, "track", counted)
    return runs


@pytest.fixture(scope="module")
def moved():
    return measured(SimulatedBench(BED, seed=1))[0]


def reported(recording):
    """Return the report of an identification by the tracker, and its estimate."""
    done = Identification(BED, recording, (), list(identify(recording, BED, TRACKER)))
    return record_of(done, done.courses()), done.estimate


def test_identify_with_its_report_runs_the_filter_once(filter_runs, moved):
    report, _ = reported(window(moved, 0.0, 60.0))
    assert filter_runs == ["fed"]
    names = [picture.name for picture in report.figures]
    assert names == ["figure11_tracked_rate", "figure12_tracked_com"]


def test_across_a_move_one_more_run_ignores_the_move(filter_runs, moved):
    report, _ = reported(moved)
    assert filter_runs == ["fed", "ignored"]
    assert report.figures[-1].name == "figure13_move"


def test_the_figure_shows_the_course_of_the_result(moved):
    report, estimate = reported(window(moved, 0.0, 60.0))
    figure, course = report.figures[1].figure, estimate.course
    for axes, x in zip(figure.axes, course.values.T, strict=True):
        line = next(each for each in axes.lines if each.get_label() == "tracker")
        np.testing.assert_allclose(line.get_ydata()[-1], 1e6 * x[-1], rtol=1e-12)


def test_a_balancing_report_runs_the_filter_once(filter_runs, moved):
    done = Balancing(BED, GOAL, (), moved)
    courses = balancing_courses(done.recording, BED, None)
    drawn = [*pictures_of_tracking(done, courses), *pictures_of(done, courses)]
    assert len(drawn) == 4
    assert filter_runs == ["fed"]
