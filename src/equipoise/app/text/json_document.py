"""Recordings, estimates and runs as JSON documents: SI units, null for what is not finite."""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

from equipoise.app.text.json_shape import (
    COUNT,
    FLAG,
    MATRIX,
    NUMBER,
    TEXT,
    VECTOR,
    View,
    by_name,
    document,
    fields,
    key,
    many,
    maybe,
    shape,
)
from equipoise.model.estimate import Estimate
from equipoise.model.event import UNITS
from equipoise.model.finding import Finding
from equipoise.model.recording import CHANNELS, Recording


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


TEXTS, NUMBERS = many(TEXT), by_name(NUMBER)

# Why: a code for programs, what it is about, its numbers in SI, and a sentence for people.
WHY = (
    *fields("code", TEXT),
    *fields("parameters", TEXTS),
    *fields("numbers", NUMBERS),
    *fields("sentence", TEXT),
)
REASONS = many(shape(*WHY))

FINDING = shape(
    *fields("kind code", TEXT),
    *fields("reasons", REASONS),
    *fields("sentence", TEXT),
    key("span_s", maybe(VECTOR), lambda f: f.span),
)

OUTCOME = shape(
    *fields("code trust", TEXT),
    *fields("usable", FLAG),
    *fields("reasons", REASONS),
    *fields("sentence", TEXT),
)

# One move of a schedule: when masses are sent, and where to from home.
SENT = shape(
    key("time_s", NUMBER, lambda move: move[0]),
    key("targets_m", NUMBERS, lambda move: move[1]),
)

PARAMETER = shape(
    *fields("name unit", TEXT),
    *fields("value sd low95 high95", NUMBER),
    *fields("observable", FLAG),
)

# A jump of momentum in laboratory axes, or of com in body axes.
EVENT = shape(
    *fields("kind", TEXT),
    key("kind_unclear", FLAG, lambda e: e.unclear),
    key("time_s", NUMBER, lambda e: e.t),
    key("time_sd_s", NUMBER, lambda e: e.t_sd),
    key("unit", TEXT, lambda e: UNITS[e.kind]),
    key("size", VECTOR, lambda e: e.size),
    key("covariance", MATRIX, lambda e: e.covariance),
    key("chi_square", NUMBER, lambda e: e.surprise),
    key("azimuth_rad", NUMBER, lambda e: e.azimuth),
)

RESIDUAL = shape(
    key("attitude_rms_rad", NUMBER, lambda r: r.attitude_rms),
    key("rate_rms_rad_s", NUMBER, lambda r: r.rate_rms),
    *fields("chi_square degrees_of_freedom reduced_chi_square lag_one", NUMBER),
    key("whiteness_p", NUMBER, lambda r: r.whiteness),
    *fields("spectral_peak steady_rms held_out_rms", NUMBER),
    key("held_out_span_s", maybe(VECTOR), lambda r: r.held_out_span),
    *fields("error_index", NUMBER),
    key("parameter_error_indices", NUMBERS, lambda r: r.error_indices),
)

# Parameters along a record, a row for each time; units are those of the parameters.
COURSE = shape(
    *fields("names", TEXTS),
    key("t_s", VECTOR, lambda c: c.t),
    *fields("values sd", MATRIX),
)

# What a record showed of what its plan had predicted.
PLAN_CHECK = shape(
    *fields("source", TEXT),
    key("parameters", many(shape(*fields("name", TEXT), *fields("predicted_sd found_sd", NUMBER))),
        lambda check: check["parameters"]),
)  # fmt: skip

ESTIMATE = document(
    "equipoise/estimate/1",
    *fields("method", TEXT),
    *fields("outcome", OUTCOME),
    *fields("parameters", many(PARAMETER)),
    *fields("covariance", MATRIX),
    *fields("residual", maybe(RESIDUAL)),
    *fields("unobservable", REASONS),
    *fields("events", many(EVENT)),
    *fields("unexplained", REASONS),
    *fields("ratios", many(PARAMETER)),
    *fields("possible", FLAG),
    *fields("course", maybe(COURSE)),
    key("findings", many(FINDING), lambda _: ()),  # see ``estimate_json``
    *fields("provenance", by_name(TEXT)),
    key("plan", PLAN_CHECK, lambda _: None, optional=True),
)

RECORDING = document(
    "equipoise/recording/1",
    *fields("source sha256", TEXT),
    key("span_s", VECTOR, lambda found: found["span"]),
    *fields("rows", by_name(COUNT)),
    *fields("masses devices", TEXTS),
    *fields("findings", many(FINDING)),
)

VERDICT = shape(
    *fields("outcome", TEXT),
    *fields("passed", FLAG),
    *fields("code", TEXT),
    *fields("reasons", REASONS),
    *fields("sentence", TEXT),
    key("com_m", maybe(VECTOR), lambda v: v.com),
    key("sd_m", maybe(VECTOR), lambda v: v.sd),
    key("noise_floor_m", maybe(VECTOR), lambda v: v.noise_floor),
)

# What a move or a placing should leave.
PREDICTED = (
    key("predicted_com_m", VECTOR, lambda done: done.predicted_com),
    key("predicted_covariance_m2", MATRIX, lambda done: done.predicted_covariance),
)

MOVE = shape(
    key("targets_m", NUMBERS, lambda m: m.targets),
    key("travel_m", NUMBER, lambda m: m.travel),
    key("duration_s", NUMBER, lambda m: m.duration),
    *PREDICTED,
    *fields("reason", TEXT),
)

# The step's sentence says what goes where.
PLACING = shape(*fields("handled", COUNT), *PREDICTED)

STEP = shape(
    *fields("kind code", TEXT),
    key("time_s", NUMBER, lambda step: step.time),
    *fields("reasons", REASONS),
    *fields("sentence", TEXT),
    key("estimate", ESTIMATE, lambda step: step.estimate, optional=True),
    key("move", MOVE, lambda step: step.move, optional=True),
    key("placing", PLACING, lambda step: step.placing, optional=True),
    key("verdict", VERDICT, lambda step: step.verdict, optional=True),
)

TRUTH = shape(
    key("com_m", VECTOR, lambda body: body.com),
    key("inertia_P_kg_m2", MATRIX, lambda body: body.inertia_P),
)

# Truth only where it is simulated; a run that waits for a person has no verdict yet.
BALANCE = document(
    "equipoise/balance/2",
    *fields("steps", many(STEP)),
    *fields("verdict", maybe(VERDICT)),
    key("truth", TRUTH, lambda run: run["truth"], optional=True),
    *fields("provenance", by_name(TEXT)),
)


def estimate_json(
    estimate: Estimate, findings: Sequence[Finding] = (), plan: View | None = None
) -> View:
    """Return an estimate, with what was found in its record and came of its plan."""
    found = ESTIMATE.write(estimate) | {"findings": [FINDING.write(each) for each in findings]}
    return found if plan is None else found | {"plan": PLAN_CHECK.write(plan)}


def recording_json(recording: Recording, findings: Sequence[Finding]) -> View:
    """Return what a recording holds."""
    channels = {name: getattr(recording, name) for name in CHANNELS}
    return RECORDING.write({
        "source": recording.source,
        "sha256": recording.sha256,
        "span": recording.span,
        "rows": {name: 0 if c is None else len(c) for name, c in channels.items()},
        "masses": recording.mass_names,
        "devices": recording.device_names,
        "findings": findings,
    })  # fmt: skip
