"""Every figure that the program draws, each of records as a user has them, and what is on it."""

from collections.abc import Iterator, Mapping
from datetime import datetime, timedelta
from functools import cache

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.transforms import Bbox

import equipoise as eq
from equipoise.app.figures import catalogue, design_catalogue
from equipoise.app.figures.balancing import (
    balanced_steps,
    com_over_hours,
    residual_torque,
    rounds_com,
    torque_in_range,
)
from equipoise.app.figures.balancing.story import Story
from equipoise.app.figures.base.files import rendered
from equipoise.app.figures.estimate import (
    com_course,
    inertia_ellipsoid,
    intervals,
    run_boxes,
    step_com,
    torque_by_cause,
)
from equipoise.app.figures.estimate.run_boxes import Boxed
from equipoise.app.figures.estimate.step_com import Mark, Wanted
from equipoise.app.figures.papers import lee_course, lee_slew, moved_attitude, null_vector
from equipoise.app.figures.recording import measurement, record, swing_spectrum
from equipoise.app.figures.study import compared_accuracy, compared_coverage, compared_torque, trend
from equipoise.app.runs.demonstration import measured
from equipoise.assessment.metrics.allan import Wander
from equipoise.estimation.model_selection import reference_fit
from equipoise.estimation.output_error import trajectory
from equipoise.io.testbed.presets import read_preset
from equipoise.model.estimate import BODY, COM, INERTIA, Course, Estimate, Parameter
from equipoise.model.finding import Finding
from equipoise.model.recording import Recording, window
from equipoise.procedure.identification.drift_metrics import OverHours
from equipoise.procedure.identification.record_courses import fit_motions, tracked_courses
from equipoise.simulation.free_start import freely

MOVED, DRIVEN = read_preset("sputnix"), read_preset("aalto")
T = np.linspace(0.0, 600.0, 60)


@cache
def _moved() -> tuple[Recording, tuple, Estimate]:
    """Return a record of a camera across a move, its truth and a fit."""
    recording, truth = freely(MOVED, 1, measured)[1]
    return recording, truth, reference_fit.estimate(recording, MOVED, trajectory.Params())


@cache
def gyro_fit() -> tuple[Recording, Estimate]:
    """Return a record of camera and gyro that leaves the scale open, and a fit."""
    recording = eq.simulate("aalto", duration=30.0, seed=3)
    return recording, reference_fit.estimate(recording, DRIVEN, trajectory.Params())


@cache
def every_figure() -> Mapping[str, object]:
    """Return each figure by name, arranged as it is written to a file."""
    found = dict(_all())
    for figure in found.values():
        rendered(figure, "svg")
        figure.draw_without_rendering()  # at the figure's own dots an inch
    return found


def _all() -> Iterator[tuple[str, object]]:
    yield from _of_estimates()
    yield from _of_balancing()
    yield from _of_recordings()
    yield from _of_studies()
    yield from _of_papers()


def _of_estimates():
    recording, truth, estimate = _moved()
    with_gyro, scale_open = gyro_fit()
    for name, rec, bed, fit in (("camera", recording, MOVED, estimate),
                                ("gyro", with_gyro, DRIVEN, scale_open)):  # fmt: skip
        for picture in catalogue.of_fit(rec, fit_motions(rec, bed, fit)):
            yield f"{name} {picture.name}", picture.figure
    still = window(recording, 0.0, 60.0)
    for picture in (
        *catalogue.of_tracking(still, tracked_courses(still, MOVED, estimate), truth[1][0]),
        *catalogue.of_move(recording, tracked_courses(recording, MOVED, estimate, True), truth),
    ):
        yield picture.name, picture.figure
    values = np.outer(T / T[-1], np.ones(3)) * 1e-5
    yield "com_course", com_course.draw(Course(COM, T, values, 0 * values + 1e-6), "kf", recording)
    shown = [p for p in estimate.parameters if p.name in BODY]
    yield "intervals", intervals.draw(shown)
    yield "inertia_ellipsoid", inertia_ellipsoid.draw(MOVED.body)
    near = Wanted(np.array([0.0, 0.0, -1e-4]), np.array([2e-6, 2e-6, 3e-6]))
    marks = [
        Mark("momentum_laboratory", np.array([1.7e-5, -2.8e-5, -7.6e-5]), np.full(3, 2e-6)),
        Mark("trajectory", np.array([1.63e-5, -2.76e-5, -7.3e-5]), np.full(3, np.inf)),
    ]
    yield "step_com", step_com.draw(marks, near)
    yield "step_com alone", step_com.draw(marks[1:], None)
    rng = np.random.default_rng(1)
    size = {name: 1e-5 if name in COM else 0.3 for name in (*COM, *INERTIA)}
    boxed = {
        name: Boxed(list(s * (1 + 0.05 * rng.normal(size=8))), "m" if name in COM else "kg m2",
                    Parameter(name, "m", s, 0.01 * s), s)
        for name, s in size.items()
    }  # fmt: skip
    yield "run_boxes", run_boxes.draw(boxed)
    divided = eq.ledger(still, estimate, MOVED)
    yield "torque_by_cause", torque_by_cause.draw(divided)


def _story() -> Story:
    truth = _moved()[1]
    measurements = [(30.0, truth[1][0], np.full(3, 1e-6)), (90.0, truth[1][-1], np.full(3, 4e-6))]
    keep = np.isfinite(truth[1]).all(axis=1)
    true = (truth[0][keep], truth[1][keep])
    return Story(measurements, np.array([0, 0, -1e-4]), np.array([2e-6, 2e-6, 3e-6]), true)


def _of_balancing():
    recording, _, estimate = _moved()
    tracked = tracked_courses(recording, MOVED, estimate)
    for picture in catalogue.of_balancing(recording, MOVED, tracked, _story()):
        yield picture.name, picture.figure
    yield "balanced_steps", balanced_steps.draw(_story())
    rounds = [(float(k), np.array([4e-4, -2e-4, -1e-3]) / 8**k, np.full(3, 1e-6)) for k in range(4)]
    story = Story(rounds, np.zeros(3), np.full(3, 2e-6), None)
    yield "rounds_com", rounds_com.draw(story)
    com = np.cumsum(np.random.default_rng(2).normal(size=(60, 3)), axis=0) * 1e-7
    span = np.array([11.0, 22.0, 44.0, 88.0])
    deviation = np.outer([3e-7, 2e-7, 2.5e-7, 4e-7], [1.0, 1.3, 8.0])
    wander = Wander(span, deviation, np.full(4, 0.2), deviation / 2, *np.zeros((3, 3)))
    yield (
        "com_over_hours",
        com_over_hours.draw(OverHours(T, com, 0 * com + 1e-7, 0, wander), wander),
    )


def _of_recordings():
    recording, with_gyro = _moved()[0], gyro_fit()[0]
    yield "measurement", measurement.draw(recording, MOVED.up)
    yield "measurement with gyro", measurement.draw(with_gyro, DRIVEN.up)
    rich = eq.simulate("reference-table", duration=20.0, seed=2)
    yield "measurement with all sensors", measurement.draw(rich, None)
    yield "record with all sensors", record.draw(rich)
    report = eq.assess(recording, MOVED, require_torque=2e-4)
    yield "torque_in_range", torque_in_range.draw(report.done)
    yield "residual_torque", residual_torque.draw(report.done.metrics.torque)
    yield "swing_spectrum", swing_spectrum.draw(report.done)
    found: list[Finding] = [f for f in report.findings if f.span is not None]
    yield "record", record.draw(recording, found, MOVED.up)


def _of_studies():
    methods = [f"method_{k}" for k in range(9)]
    yield (
        "compared_accuracy",
        compared_accuracy.draw(
            [compared_accuracy.Accuracy(m, 1.1 + k, 1.3, k % 2 == 0) for k, m in enumerate(methods)]
        ),
    )
    yield (
        "compared_coverage",
        compared_coverage.draw(
            [compared_coverage.Coverage(m, 0.8 + 0.02 * k, 0.87) for k, m in enumerate(methods)]
        ),
    )
    left = [compared_torque.Left(m, 12.0 + 0.1 * k, 14.0) for k, m in enumerate(methods)]
    yield "compared_torque", compared_torque.draw(left, 13.0)
    for picture in design_catalogue.pictures_of(eq.design(MOVED, durations=(30.0,))):
        yield picture.name, picture.figure
    start = datetime(2026, 1, 5)
    times = [start + timedelta(days=9 * k) for k in range(12)]
    values = np.tile([1e-5, 2e-5, -7e-5, 0.3, 0.4, 0.8], (12, 1)) * np.linspace(1, 1.1, 12)[:, None]
    warm = np.linspace(18.0, 24.0, 12)
    yield (
        "trend",
        trend.draw(
            trend.Trend(
                "mock-up", times, values, 0.01 * np.abs(values), ["A"] * 6 + ["B"] * 6, warm
            )
        ),
    )


def _of_papers():
    recording, _, _ = _moved()
    yield "moved_attitude", moved_attitude.draw(recording, [(60.0, np.array([0.01, -0.01, 0.05]))])
    ends = null_vector.Course(
        T, *[np.outer(np.exp(-T / 90), [1e-4, -5e-5, 2e-5])] * 2, T / T[-1], ()
    )
    yield "null_vector", null_vector.draw(null_vector.NullVector(ends, ends))
    waves = np.column_stack([np.sin(0.01 * T * k) for k in (1, 2, 3, 4)])
    gyros = [f"gyro {k}" for k in range(1, 5)]
    yield "lee_slew", lee_slew.draw(lee_slew.Shown(T, waves, "gimbal rate, deg/s", gyros), (9, 40))
    mark = lee_slew.Shown(T, np.abs(waves[:, :1]), "singularity index", ("measure",), 0.3)
    yield "lee_slew with a level", lee_slew.draw(mark, None)
    side = lee_course.Reported(T, 5 + waves[:, :3])
    yield (
        "lee_course",
        lee_course.draw_estimates(
            [side, side], np.array([4.0, 5.0, 6.0]), ("a", "b", "c"), "MOI, kg m$^2$", 9.0
        ),
    )
    index = lee_course.Reported(T, np.exp(-np.outer(T / 90.0, [1.0, 1.2, 1.5])))
    yield (
        "lee_course of indices",
        lee_course.draw_indices([index, index], ("a", "b", "c"), "PEI of MOI, kg m$^2$"),
    )


def texts_of(figure) -> list[tuple[str, Bbox, float]]:
    """Return all that is written on a figure: text, place in pixels, size in points."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    every = [*figure.texts, *(t for legend in figure.legends for t in legend.get_texts())]
    for axes in (axes for axes in figure.axes if axes.get_visible()):
        every += [axes.title, axes._left_title, axes._right_title, *axes.texts]
        every += axes.get_legend().get_texts() if axes.get_legend() else []
        for axis in (axes.xaxis, axes.yaxis):
            every += [axis.label, axis.offsetText, *ticks_in_view(axis)]
    shown = [text for text in every if text.get_visible() and text.get_text().strip()]
    return [(t.get_text(), t.get_window_extent(renderer), t.get_fontsize()) for t in shown]


def ticks_in_view(axis) -> list:
    """Return the labels of the ticks within an axis' limits."""
    low, high = sorted(axis.get_view_interval())
    air = 1e-9 * (high - low)
    return [
        label
        for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks())
        if low - air <= tick.get_loc() <= high + air
        for label in (tick.label1, tick.label2)
    ]


def greyness(colour) -> float:
    """Return how light a colour is in grey, 0 to 1 (CIE lightness of sRGB)."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in to_rgb(colour)]
    return float(1.16 * np.cbrt(np.dot([0.2126, 0.7152, 0.0722], linear)) - 0.16)
