"""Results as JSON documents: SI units, and null for what is not a finite number."""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

from equipoise.app.text.units import MM, UM
from equipoise.model.arrays import Floats
from equipoise.model.estimate import Course, Estimate, Parameter, Residual
from equipoise.model.event import UNITS, Event
from equipoise.model.finding import Finding
from equipoise.model.mass_properties import MassProperties
from equipoise.model.move import Move
from equipoise.model.outcome import Outcome
from equipoise.model.placing import Placing
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import CHANNELS, Recording
from equipoise.model.step import Step
from equipoise.model.verdict import Verdict

ESTIMATE, BALANCE, RECORDING = (
    f"equipoise/{kind}/1" for kind in ("estimate", "balance", "recording")
)
View = dict[str, Any]


def dump(document: View) -> str:
    """Return one JSON document as text."""
    return json.dumps(finite(document), indent=1, ensure_ascii=False, allow_nan=False)


def finite(value: Any) -> Any:
    """Return a view with None in place of every number that is not finite."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {str(key): finite(item) for key, item in value.items()}  # pyright: ignore
    if isinstance(value, list | tuple):
        return [finite(item) for item in value]  # pyright: ignore
    return value


def numbers(values: Floats | None, factor: float = 1.0) -> list[Any] | None:
    """Return an array as lists."""
    return None if values is None else (values * factor).tolist()


def schedule_json(moves: Sequence[tuple[float, Mapping[str, float]]]) -> list[View]:
    """Return when masses are sent, and where to from home."""
    return [{"time_s": t, "targets_m": dict(targets)} for t, targets in moves]


def estimate_json(estimate: Estimate, findings: Sequence[Finding] = ()) -> View:
    """Return an estimate, schema equipoise/estimate/1."""
    return {
        "schema": ESTIMATE,
        "method": estimate.method,
        "outcome": outcome_json(estimate.outcome),
        "parameters": [parameter_json(p) for p in estimate.parameters],
        "covariance": numbers(estimate.covariance),
        "residual": None if estimate.residual is None else residual_json(estimate.residual),
        "unobservable": reasons_json(estimate.unobservable),
        "events": [event_json(event) for event in estimate.events],
        "unexplained": reasons_json(estimate.unexplained),
        "ratios": [parameter_json(p) for p in estimate.ratios],
        "possible": estimate.possible,
        "course": None if estimate.course is None else course_json(estimate.course),
        "findings": [finding_json(f) for f in findings],
        "provenance": dict(estimate.provenance),
    }


def outcome_json(outcome: Outcome) -> View:
    """Return what happened, how far to rely on it, and why."""
    return {
        "code": outcome.code,
        "trust": outcome.trust,
        "usable": outcome.usable,
        "reasons": reasons_json(outcome.reasons),
        "sentence": outcome.sentence,
    }


def reasons_json(reasons: Sequence[Reason]) -> list[View]:
    """Return reasons: a code, what it is about, its numbers in SI, and a sentence for people."""
    return [
        {
            "code": reason.code,
            "parameters": list(reason.parameters),
            "numbers": dict(reason.numbers),
            "sentence": reason.sentence,
        }
        for reason in reasons
    ]


def course_json(course: Course) -> View:
    """Return what was believed along a record: times, values and sd, a row each."""
    return {
        "names": list(course.names),
        "t_s": numbers(course.t),
        "values": numbers(course.values),
        "sd": numbers(course.sd),
    }


def parameter_json(parameter: Parameter) -> View:
    """Return one number with its uncertainty."""
    return {
        "name": parameter.name,
        "unit": parameter.unit,
        "value": parameter.value,
        "sd": parameter.sd,
        "low95": parameter.low95,
        "high95": parameter.high95,
        "observable": parameter.observable,
    }


def event_json(event: Event) -> View:
    """Return an event: a jump of momentum in laboratory axes, or of com in body axes."""
    return {
        "kind": event.kind,
        "kind_unclear": event.unclear,
        "time_s": event.t,
        "time_sd_s": event.t_sd,
        "unit": UNITS[event.kind],
        "size": numbers(event.size),
        "covariance": numbers(event.covariance),
        "chi_square": event.surprise,
        "azimuth_rad": event.azimuth,
    }


def residual_json(residual: Residual) -> View:
    """Return what the model leaves."""
    return {
        "attitude_rms_rad": residual.attitude_rms,
        "rate_rms_rad_s": residual.rate_rms,
        "chi_square": residual.chi_square,
        "degrees_of_freedom": residual.degrees_of_freedom,
        "reduced_chi_square": residual.reduced_chi_square,
        "lag_one": residual.lag_one,
        "whiteness_p": residual.whiteness,
        "spectral_peak": residual.spectral_peak,
        "steady_rms": residual.steady_rms,
        "held_out_rms": residual.held_out_rms,
        "held_out_span_s": residual.held_out_span,
        "error_index": residual.error_index,
        "parameter_error_indices": dict(residual.error_indices),
    }


def finding_json(finding: Finding) -> View:
    """Return a finding."""
    return {
        "kind": finding.kind,
        "code": finding.code,
        "reasons": reasons_json(finding.reasons),
        "sentence": finding.sentence,
        "span_s": finding.span,
    }


def findings_json(recording: Recording, findings: Sequence[Finding]) -> View:
    """Return what a recording holds, schema equipoise/recording/1."""
    channels = {name: getattr(recording, name) for name in CHANNELS}
    return {
        "schema": RECORDING,
        "source": recording.source,
        "sha256": recording.sha256,
        "span_s": recording.span,
        "rows": {name: 0 if c is None else len(c) for name, c in channels.items()},
        "masses": list(recording.mass_names),
        "devices": list(recording.device_names),
        "findings": [finding_json(f) for f in findings],
    }


def balance_json(
    steps: Sequence[Step], verdict: Verdict | None, truth: MassProperties | None, provenance: View
) -> View:
    """Return a balancing run, schema equipoise/balance/1; truth only when it was simulated.

    A run that waits for a person has no verdict yet.
    """
    document: View = {
        "schema": BALANCE,
        "steps": [step_json(step) for step in steps],
        "verdict": None if verdict is None else verdict_json(verdict),
    }
    if truth is not None:
        document["truth"] = {
            "com_um": numbers(truth.com, UM),
            "inertia_P_kg_m2": numbers(truth.inertia_P),
        }
    return document | {"provenance": provenance}


def verdict_json(verdict: Verdict) -> View:
    """Return a verdict."""
    return {
        "outcome": verdict.outcome,
        "passed": verdict.passed,
        "code": verdict.code,
        "reasons": reasons_json(verdict.reasons),
        "sentence": verdict.sentence,
        "com_um": numbers(verdict.com, UM),
        "sd_um": numbers(verdict.sd, UM),
        "noise_floor_um": numbers(verdict.noise_floor, UM),
    }


def step_json(step: Step) -> View:
    """Return a step, without the recording that it looked at."""
    view: View = {
        "kind": step.kind,
        "code": step.code,
        "time_s": step.time,
        "reasons": reasons_json(step.reasons),
        "sentence": step.sentence,
    }
    if step.estimate is not None:
        view["estimate"] = estimate_json(step.estimate)
    if step.move is not None:
        view["move"] = move_json(step.move)
    if step.placing is not None:
        view["placing"] = placing_json(step.placing)
    if step.verdict is not None:
        view["verdict"] = verdict_json(step.verdict)
    return view


def placing_json(placing: Placing) -> View:
    """Return a placing and what it should leave; the step's sentence says what goes where."""
    return {
        "handled": placing.handled,
        "predicted_com_um": numbers(placing.predicted_com, UM),
        "predicted_covariance_um2": numbers(placing.predicted_covariance, UM**2),
    }


def move_json(move: Move) -> View:
    """Return a move and what it should leave."""
    return {
        "targets_mm": {name: at * MM for name, at in move.targets.items()},
        "travel_mm": move.travel * MM,
        "duration_s": move.duration,
        "predicted_com_um": numbers(move.predicted_com, UM),
        "predicted_covariance_um2": numbers(move.predicted_covariance, UM**2),
        "reason": move.reason,
    }
