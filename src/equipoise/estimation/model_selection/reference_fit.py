"""Reference: the trajectory fit in the model that the record supports, and what it is worth.

The plain fit (``trajectory``) is surveyed (``survey``): its noise, events such as touches, process
noise, and the terms of torque and sensors that the record shows and that also predict. What is
found is part of the model of the final fit, so that the intervals count it; and it is told.

Cannot see what ``trajectory`` cannot see; nor anything that no row of the record shows.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.events.event_report import told
from equipoise.estimation.events.event_time_covariance import with_moments
from equipoise.estimation.events.record_model import Believed, refitted
from equipoise.estimation.model_selection.decimation import condensed
from equipoise.estimation.model_selection.dense_record import surveyed_densely
from equipoise.estimation.model_selection.initial_model import anchored, plainly
from equipoise.estimation.model_selection.survey import MOST_EVENTS, survey
from equipoise.estimation.model_selection.survey_sentences import (
    DRIVEN,
    driven,
    lean_sentences,
    noise_sentences,
    open_sentences,
    term_sentences,
    walk_sentences,
)
from equipoise.estimation.output_error.fit_estimate import UNSETTLED, conclude
from equipoise.estimation.output_error.outlier_rejection import without_far_rows
from equipoise.estimation.output_error.problem import evaluate
from equipoise.estimation.output_error.segment_jumps import carried
from equipoise.estimation.output_error.solution import Fitted, settle
from equipoise.estimation.output_error.trajectory import METHOD, Params, at_rest, problem_of
from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate, Residual
from equipoise.model.outcome import Outcome
from equipoise.model.recording import Recording, arranged, window
from equipoise.model.testbed import Testbed

FEWEST = 4  # rows


def predicted_left(recording: Recording, fitted: Fitted, left: Fitted, cut: float) -> Floats:
    """Return what a fit of the rows before ``cut`` (s) leaves of those behind it, rad or rad/s.

    Process noise behind the cut is not predicted; events there are those of the whole fit.
    """
    problem, early = fitted.problem, left.problem
    jumps = carried(early.jumps, left.jumps, problem.jumps)
    for k, jump in enumerate(problem.jumps):
        if jump.t >= cut and jump.is_event:
            jumps[k] = fitted.jumps[k]
    ahead = replace(left.point, error=fitted.point.error)
    at, seen = evaluate(problem, ahead, jumps), problem.seen
    camera = len(at.left_q) > 0
    rows = recording.attitude if camera else recording.rate
    assert rows is not None
    sd = seen.attitude_sd if camera else seen.rate_sd
    return (at.left_q if camera else at.left_w)[rows.t > cut] * sd


def steady(belief: Believed) -> Believed:
    """Return the belief without process noise: what is left then must be predictable."""
    return refitted(replace(belief, walk=np.zeros(3))) if belief.wanders else belief


def held_out(believed: Believed, share: float, residual: Residual) -> Residual:
    """Return the residual with what a fit of the first part predicts for the rest.

    Both without process noise, whose future nobody knows.
    """
    belief = steady(believed)
    recording, fitted = belief.recording, belief.fitted
    first, last = recording.span
    cut = last - share * (last - first)
    part = window(recording, first, cut)
    params = replace(belief.params, jumps=fitted.problem.jumps)
    problem = problem_of(part, belief.testbed, params)
    jumps = carried(fitted.problem.jumps, fitted.jumps, problem.jumps)
    early = settle(problem, at_rest(problem, fitted.point), jumps)
    fresh = predicted_left(recording, fitted, early, cut)
    rms = float(np.sqrt(np.mean(fresh**2))) if len(fresh) else None
    at, seen = fitted.at, fitted.problem.seen
    left = at.left_q * seen.attitude_sd if len(at.left_q) else at.left_w * seen.rate_sd
    calm = float(np.sqrt(np.mean(left**2)))
    return replace(residual, steady_rms=calm, held_out_rms=rms, held_out_span=(cut, last))


def outcome_of(belief: Believed, asked: Params, concluded: Estimate) -> Outcome:
    """Return whether the numbers may be used, with what the survey found."""
    base, share = concluded.outcome, driven(belief)
    if not base.usable:
        return base
    found = [*noise_sentences(belief), *lean_sentences(belief, concluded)]
    found += [*term_sentences(belief, asked), *walk_sentences(belief)]
    text = " ".join([base.sentence, *event_sentences(concluded), *found])
    if share > DRIVEN:
        return Outcome(
            False,
            f"{text} That torque is {share:.2g} times what gravity does: something drives the "
            "platform that the model does not know, do not trust the numbers.",
        )
    if len(belief.events) >= MOST_EVENTS:
        return Outcome(False, f"{text} So many events leave nothing to trust the numbers by.")
    return Outcome(True, text)


def event_sentences(concluded: Estimate) -> list[str]:
    """Say how many events the fit steps over."""
    if not concluded.events:
        return []
    times = ", ".join(f"{event.t:.4g}" for event in concluded.events)
    return [f"It steps over {len(concluded.events)} events, at {times} s."]


def surveyed(recording: Recording, testbed: Testbed, params: Params) -> Believed:
    """Return the model that a record supports, from the plain fit."""
    few = condensed(recording, testbed)
    if few is not None:
        return surveyed_densely(few, recording, testbed, params)
    richer, fitted = plainly(recording, testbed, params)
    testbed, fitted = anchored(recording, testbed, richer, fitted)
    return survey(recording, testbed, richer, fitted)


def check_sensors(recording: Recording, testbed: Testbed) -> None:
    """Raise InputError if the recording has rows of a sensor that the testbed does not have."""
    for name, rows, sensor in (
        ("attitude", recording.attitude, testbed.attitude),
        ("gyro", recording.rate, testbed.gyro),
    ):
        if rows is not None and len(rows) and sensor is None:
            where = f"{testbed.source or testbed.name}: sensor.{name}"
            raise InputError(where, f"none, but {len(rows)} rows of it", "its noise")


def estimate(recording: Recording, testbed: Testbed, params: Params) -> Estimate:
    """Return the estimate of a record, with its residual on a part that was held out."""
    recording = arranged(recording, testbed.mass_names)
    check_sensors(recording, testbed)
    rows = sum(len(c) for c in (recording.attitude, recording.rate) if c is not None)
    if rows < FEWEST:
        outcome = Outcome(False, f"Only {rows} rows: nothing can be estimated.")
        return Estimate(METHOD, outcome, (), np.zeros((0, 0)))
    if not params.robust:
        return estimate_of(recording, testbed, params)
    kept, gone = without_far_rows(recording, testbed, params)
    found = estimate_of(kept, testbed, params)
    word = f" {gone} rows far off the motion are left out." if gone else ""
    return replace(found, outcome=Outcome(found.outcome.usable, found.outcome.sentence + word))


def estimate_of(recording: Recording, testbed: Testbed, params: Params) -> Estimate:
    """Return the estimate of rows that are all to be used."""
    return told_by(surveyed(recording, testbed, params), recording, params)


def told_by(belief: Believed, recording: Recording, params: Params) -> Estimate:
    """Return the estimate that a belief about a record comes to."""
    concluded = conclude(belief.fitted, METHOD, recording, belief.coloured)
    if not np.isfinite(belief.fitted.at.cost) or not (len(belief.cuts) or concluded.outcome.usable):
        return concluded
    try:
        return with_survey(belief, params, concluded)
    except np.linalg.LinAlgError:  # see ``survey``
        return replace(concluded, outcome=UNSETTLED)


def with_survey(belief: Believed, params: Params, concluded: Estimate) -> Estimate:
    """Return the estimate with what the survey found, and what the held-out part says."""
    concluded = with_moments(concluded, belief)
    concluded = replace(concluded, events=told(belief), unexplained=open_sentences(belief))
    assert concluded.residual is not None
    residual = held_out(belief, params.hold_out, concluded.residual)
    return replace(concluded, residual=residual, outcome=outcome_of(belief, params, concluded))
