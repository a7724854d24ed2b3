"""The figure that shows a step of a procedure."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.estimate import residuals, step_com
from equipoise.app.figures.estimate.step_com import Mark, Wanted
from equipoise.app.figures.recording import measurement
from equipoise.app.text.com_estimate import as_it_stands, at_home
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.fitted_motion import residuals_of

MOST = 40  # figures of steps in one report; chosen: a run that holds for hours has thousands


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """What the figures of steps have in common."""

    testbed: Testbed
    wanted: Wanted | None = None  # where the centre of mass is to be
    at_home: bool = False  # it is shown with the masses at home; else as they stand


def pictures_of_steps(
    steps: Sequence[Step], frame: Frame, first: int = 1
) -> Mapping[Step, Picture]:
    """Return a figure for each step that has something to show, the first ``MOST`` of them.

    The figure of the first step has the number ``first``.
    """
    found: dict[Step, Picture] = {}
    before: Mark | None = None
    for number, step in enumerate(steps, first):
        reported = _reported(step, frame, before) if len(found) < MOST else None
        if reported is not None:
            found[step] = Picture(f"step{number:02d}_{step.kind}", *reported)
        before = _estimated(step, frame) or before
    return found


def _reported(step: Step, frame: Frame, before: Mark | None) -> tuple[str, Figure] | None:
    """Return caption and figure of a step."""
    recording, estimated, testbed = step.recording, _estimated(step, frame), frame.testbed
    if step.kind == "measurement" and recording is not None:
        return measurement.CAPTION, measurement.draw(recording, testbed.up)
    if step.kind == "estimate" and recording is not None and step.estimate is not None:
        found = _residuals(recording, step.estimate, testbed)
        if found is not None:
            return found
    if estimated is None:
        return None
    marks = [mark for mark in (before, estimated) if mark is not None]
    return step_com.caption(frame.at_home, marks, frame.wanted), step_com.draw(marks, frame.wanted)


def _residuals(
    recording: Recording, estimate: Estimate, testbed: Testbed
) -> tuple[str, Figure] | None:
    """Return what a fit leaves of the camera's rows, without a camera of the gyro's."""
    left = estimate.residual
    if left is None:
        return None
    every = residuals_of(testbed, left.attitude, left.rate)
    for of, sensor in zip(every, (residuals.CAMERA, residuals.GYRO), strict=True):
        if of is not None:
            return sensor.caption, residuals.draw(recording, of, sensor)
    return None


def _estimated(step: Step, frame: Frame) -> Mark | None:
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
    if step.estimate is None:
        return None
    at = at_home(step.estimate) if frame.at_home else as_it_stands(step.estimate)
    name = step.estimate.method if frame.at_home else f"{step.time:.0f} s, estimated"
    return None if at is None else Mark(name, at.com, at.sd)
