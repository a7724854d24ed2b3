"""Which figure tells a step of a procedure."""

from collections.abc import Mapping, Sequence
from typing import TypeGuard

import numpy as np
from matplotlib.figure import Figure

from equipoise.app.believed import as_it_stands
from equipoise.app.figures import attitude_residual, step_com, step_look
from equipoise.app.figures.step_com import Mark, Wanted
from equipoise.app.pictures import Picture
from equipoise.estimation.prediction import ATTITUDE, RATE, predict
from equipoise.model.estimate import COM, INERTIA, Estimate
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed

MOST = 40  # figures of steps in one report; chosen: a run that holds for hours has thousands


def pictures_of_steps(
    steps: Sequence[Step], testbed: Testbed, wanted: Wanted | None = None
) -> Mapping[Step, Picture]:
    """Return a figure for each step that has something to show, the first ``MOST`` of them."""
    found: dict[Step, Picture] = {}
    before: Mark | None = None
    for number, step in enumerate(steps, 1):
        told = _told(step, testbed, before, wanted) if len(found) < MOST else None
        if told is not None:
            found[step] = Picture(f"step{number:02d}_{step.kind}", *told)
        before = _believed(step) or before
    return found


def _told(
    step: Step, testbed: Testbed, before: Mark | None, wanted: Wanted | None
) -> tuple[str, Figure] | None:
    """Return caption and figure of a step."""
    recording, believed = step.recording, _believed(step)
    if step.kind == "look" and recording is not None:
        return step_look.CAPTION, step_look.draw(recording, testbed.up)
    if step.kind == "estimate" and _is_fit(step.estimate) and _has_camera(recording):
        after = predict(recording, testbed, step.estimate)
        noise = testbed.attitude.noise if testbed.attitude else None
        return attitude_residual.CAPTION, attitude_residual.draw(recording, after, noise)
    if believed is None:
        return None
    marks = [mark for mark in (before, believed) if mark is not None]
    return step_com.CAPTION, step_com.draw(marks, wanted)


def _is_fit(estimate: Estimate | None) -> TypeGuard[Estimate]:
    """Say whether an estimate tells how its record began, so that the model can be run along it."""
    names = (*COM, *INERTIA, *RATE, *ATTITUDE)
    return estimate is not None and all(map(estimate.has, names)) and estimate.method != "tracker"


def _has_camera(recording: Recording | None) -> TypeGuard[Recording]:
    return recording is not None and recording.attitude is not None


def _believed(step: Step) -> Mark | None:
    """Return the centre of mass that a step found, or that it predicts."""
    if step.verdict is not None and step.verdict.com is not None:
        sd = step.verdict.sd
        return Mark(
            f"{step.time:.0f} s, found", step.verdict.com, np.zeros(3) if sd is None else sd
        )
    for ahead in (step.move, step.placing):
        if ahead is not None:
            sd = np.sqrt(np.diag(ahead.predicted_covariance))
            return Mark(f"{step.time:.0f} s, predicted", ahead.predicted_com, sd)
    at = None if step.estimate is None else as_it_stands(step.estimate)
    return None if at is None else Mark(f"{step.time:.0f} s, estimated", at.com, at.sd)
