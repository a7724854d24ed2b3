"""Reference: the trajectory fit in the model that the record supports, and what it is worth.

The plain fit (``trajectory``) is surveyed (``survey``): its noise, events such as touches, process
noise, and the terms of torque and sensors that the record shows and that also predict. What is
found is part of the model of the final fit, so that the intervals count it; and it is reported.

Cannot see what ``trajectory`` cannot see; nor anything that no row of the record shows.
"""

import itertools
from dataclasses import replace

import numpy as np

from equipoise.estimation.events.event_report import reported_events
from equipoise.estimation.events.event_search import during_travels, without_sure_travel
from equipoise.estimation.events.event_time_covariance import with_moments
from equipoise.estimation.events.record_model import RecordModel, jumping, refitted
from equipoise.estimation.model_selection.decimation import condensed, with_few_bends
from equipoise.estimation.model_selection.dense_record import surveyed_densely
from equipoise.estimation.model_selection.initial_model import anchored, plainly
from equipoise.estimation.model_selection.lamp_response import with_response
from equipoise.estimation.model_selection.model_search import MOST_EVENTS, is_calm
from equipoise.estimation.model_selection.rival_models import with_rivals
from equipoise.estimation.model_selection.survey import survey
from equipoise.estimation.model_selection.survey_reasons import (
    DRIVEN,
    added,
    clock_reasons,
    driven,
    lamp_reasons,
    lean_reasons,
    log_reasons,
    noise_reasons,
    open_terms,
    pressed_stays,
    sensor_reasons,
    term_reasons,
    walk_reasons,
)
from equipoise.estimation.modes.hanging_estimate import hanging_reasons, with_hanging_numbers
from equipoise.estimation.modes.hanging_mass import with_hanging
from equipoise.estimation.modes.modal_estimate import mode_reasons, with_modal_numbers
from equipoise.estimation.modes.modal_search import settled_modes, with_modes
from equipoise.estimation.motion.unresolved_rates import without_unresolved_rates
from equipoise.estimation.output_error.fit_estimate import UNSETTLED, conclude, widening
from equipoise.estimation.output_error.growing_horizon import at_rest
from equipoise.estimation.output_error.outlier_rejection import without_outliers
from equipoise.estimation.output_error.segment_jumps import carried
from equipoise.estimation.output_error.solution import Fitted, evaluate, settle
from equipoise.estimation.output_error.toward_stated import tried
from equipoise.estimation.output_error.trajectory import METHOD, Params
from equipoise.estimation.search_budget import cut_short
from equipoise.estimation.stays_at_stop import stay_reasons
from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate, Residual
from equipoise.model.outcome import Outcome, outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording, arranged, window
from equipoise.model.testbed import Testbed

FEWEST = 4  # rows
NEARLY_WHITE = 1.5  # times an interval is as wide as by white noise, chosen
NEARLY_CALM = 3.0  # root of the median surprise over its due, chosen: a torque below the noise
HELD_OUT = 0.25  # share of the record to predict instead of fit, for the residual


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
    at, observed = evaluate(problem, ahead, jumps), problem.observed
    camera = len(at.left_q) > 0
    rows = recording.attitude if camera else recording.rate
    assert rows is not None
    sd = observed.attitude_sd if camera else observed.rate_sd
    return (at.left_q if camera else at.left_w)[rows.t > cut] * sd


def steady(model: RecordModel) -> RecordModel:
    """Return the model without process noise: what is left then must be predictable."""
    return refitted(replace(model, walk=np.zeros(3))) if model.wanders else model


def held_out(fitted_model: RecordModel, residual: Residual) -> Residual:
    """Return the residual with what a fit of the first part predicts for the rest.

    Both without process noise, whose future nobody knows.
    """
    record_model = steady(fitted_model)
    recording, fitted = record_model.recording, record_model.fitted
    first, last = recording.span
    cut = last - HELD_OUT * (last - first)
    part = window(recording, first, cut)
    problem, jumps = jumping(record_model, part, fitted.problem.jumps)
    early = settle(problem, at_rest(problem, fitted.point), jumps)
    fresh = predicted_left(recording, fitted, early, cut)
    rms = float(np.sqrt(np.mean(fresh**2))) if len(fresh) else None
    at, observed = fitted.at, fitted.problem.observed
    left = at.left_q * observed.attitude_sd if len(at.left_q) else at.left_w * observed.rate_sd
    calm = float(np.sqrt(np.mean(left**2)))
    return replace(residual, steady_rms=calm, held_out_rms=rms, held_out_span=(cut, last))


def outcome_of(model: RecordModel, requested: Params, concluded: Estimate) -> Outcome:
    """Return whether the numbers may be used, with what the survey found."""
    base, share = concluded.outcome, driven(model)
    if not base.usable:
        return base
    found = [*base.reasons, *event_reasons(concluded, model), *noise_reasons(model)]
    found += [
        *log_reasons(model, concluded),
        *clock_reasons(model, concluded),
        *lean_reasons(model, concluded),
        *sensor_reasons(model, concluded),
        *mode_reasons(model),
        *hanging_reasons(model),
        *term_reasons(added(model, requested), concluded, model.testbed),
        *lamp_reasons(model),
        *walk_reasons(model),
        *stay_reasons(model.recording, pressed_stays(model)),
    ]
    if share > DRIVEN:
        found.append(Reason(Why.UNKNOWN_TORQUE, (), {"share": share}))
    elif len(model.events) >= MOST_EVENTS:
        found.append(Reason(Why.TOO_MANY_EVENTS))
    return Outcome(tuple(found))


def event_reasons(concluded: Estimate, model: RecordModel) -> list[Reason]:
    """Return how many events the fit steps over, and which coincide with recorded travels."""
    if not concluded.events:
        return []
    times = tuple(f"{event.t:.4g}" for event in concluded.events)
    found = [Reason(Why.EVENTS_FOUND, times, {"count": len(times)})]
    travelling = during_travels(model, [event.t for event in concluded.events])
    moving = tuple(itertools.compress(times, travelling))
    return [*found, Reason(Why.EVENTS_AT_TRAVELS, moving)] if moving else found


def surveyed(recording: Recording, testbed: Testbed, params: Params) -> RecordModel:
    """Return the model that a record supports, from the plain fit."""
    few = condensed(recording, testbed)
    if few is not None:
        return settled_modes(with_modes(surveyed_densely(few, recording, testbed, params)))
    richer, fitted = plainly(recording, testbed, params)
    nearer, fitted = anchored(recording, testbed, richer, fitted)
    found = settled_modes(with_modes(survey(recording, nearer, richer, fitted)))
    return replace(found, stated=testbed)


def check_sensors(recording: Recording, testbed: Testbed) -> None:
    """Raise InputError if the recording has rows of a sensor that the testbed does not have."""
    for name, rows, sensor in (
        ("attitude", recording.attitude, testbed.attitude),
        ("gyro", recording.rate, testbed.gyro),
    ):
        if rows is not None and len(rows) and sensor is None:
            where = f"{testbed.source or testbed.name}: sensor.{name}"
            raise InputError(where, f"none, but {len(rows)} rows of it", "its noise")


def too_few(recording: Recording, testbed: Testbed) -> bool:
    """Say whether rows are too few to fit; InputError for rows of a sensor that there is not."""
    check_sensors(recording, testbed)
    return recording.rows < FEWEST


def estimate(recording: Recording, testbed: Testbed, params: Params) -> Estimate:
    """Return the estimate of a record, with its residual on a part that was held out."""
    return modelled(recording, testbed, params)[1]


def modelled(
    recording: Recording, testbed: Testbed, params: Params
) -> tuple[RecordModel | None, Estimate]:
    """Return the model that a record supports, and its estimate; too few rows have no model."""
    recording = arranged(recording, testbed.mass_names)
    if too_few(recording, testbed):
        nothing = outcome(Why.TOO_FEW_ROWS, rows=recording.rows)
        return None, Estimate(METHOD, nothing, (), np.zeros((0, 0)))
    kept, unresolved = without_unresolved_rates(recording, testbed)
    gone = {Why.RATES_UNRESOLVED: unresolved}
    if params.robust:
        kept, gone[Why.OUTLIERS_REMOVED] = without_outliers(kept, testbed, params)
    model, found = modelled_by_all_rows(with_few_bends(kept, testbed), testbed, params)
    left_out = [Reason(code, (), {"rows": rows}) for code, rows in gone.items() if rows]
    return model, replace(found, outcome=Outcome((*found.outcome.reasons, *left_out)))


def modelled_by_all_rows(
    recording: Recording, testbed: Testbed, params: Params
) -> tuple[RecordModel, Estimate]:
    """Return the model and the estimate of rows that are all to be used."""
    model = with_sure_scale(surveyed(recording, testbed, params))
    return model, as_estimate(model, recording, params)


def with_sure_scale(model: RecordModel) -> RecordModel:
    """Return the model with an open scale where that rests on travels with events alone.

    What then moved the platform was not, or not only, what is recorded of the masses.
    """
    if not without_sure_travel(model):
        return model
    return refitted(replace(model, params=replace(model.params, travels_count=False)))


def as_estimate(model: RecordModel, recording: Recording, params: Params) -> Estimate:
    """Return the estimate that a model of a record comes to."""
    found = as_if_finished(model, recording, params)
    unfinished = params.budget.unfinished or model.unfinished
    if not unfinished:
        return found
    return cut_short(found, unfinished, found.outcome.usable and is_explained(model, found))


def is_explained(model: RecordModel, found: Estimate) -> bool:
    """Say whether what is left is noise, or so nearly that intervals count the rest.

    With very many rows a test of whiteness finds what no interval would show.
    """
    residual = found.residual
    nearly = residual is not None and max(widening(residual), model.coloured) < NEARLY_WHITE
    return is_calm(model, 0.0, NEARLY_CALM) if nearly else is_calm(model)


def as_if_finished(model: RecordModel, recording: Recording, params: Params) -> Estimate:
    """Return the same by what the search found, finished or not."""
    try:
        plain = conclude(model.fitted, METHOD, recording, model.coloured)
        concluded = tried(plain, model.fitted, model.stated, params.budget)
    except np.linalg.LinAlgError:  # of a search that was cut short
        return Estimate(METHOD, UNSETTLED, (), np.zeros((0, 0)))
    if not np.isfinite(model.fitted.at.cost) or not (len(model.cuts) or concluded.outcome.usable):
        return concluded
    try:
        return with_survey(model, params, concluded)
    except np.linalg.LinAlgError:  # see ``survey``
        return replace(concluded, outcome=UNSETTLED)


def with_survey(model: RecordModel, params: Params, concluded: Estimate) -> Estimate:
    """Return the estimate with what the survey found, and what the held-out part says.

    The latter where the search was finished: it takes long, and is not needed.
    """
    concluded = with_rivals(with_response(with_moments(concluded, model), model), model)
    concluded = with_hanging_numbers(with_modal_numbers(concluded, model), model)
    concluded = with_hanging(concluded, model, params.terms)
    concluded = replace(concluded, events=reported_events(model), unexplained=open_terms(model))
    assert concluded.residual is not None
    residual = concluded.residual if model.unfinished else held_out(model, concluded.residual)
    return replace(concluded, residual=residual, outcome=outcome_of(model, params, concluded))
