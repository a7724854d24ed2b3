"""Recordings, estimates and runs as JSON documents: SI units, null for what is not finite."""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

from equipoise.app.text.escaping import for_json
from equipoise.app.text.json_shape import (
    COUNT,
    FLAG,
    MATRIX,
    NUMBER,
    TEXT,
    VECTOR,
    Key,
    View,
    by_name,
    document,
    fields,
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
    return for_json(json.dumps(finite(document), indent=1, ensure_ascii=False, allow_nan=False))


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


def why(at: str = "") -> tuple[Key, ...]:
    """Return a reason's keys: a code for programs, what it is about, numbers in SI, a sentence."""
    return (
        *fields("code", TEXT, at),
        *fields("parameters", TEXTS, at),
        *fields("numbers", NUMBERS, at),
        *fields("sentence", TEXT, at),
    )


REASONS = many(shape(*why()))

FINDING = shape(
    *fields("kind code", TEXT),
    *fields("reasons", REASONS),
    *fields("sentence", TEXT),
    *fields("span_s=span", maybe(VECTOR)),
)

OUTCOME = shape(
    *fields("code trust", TEXT),
    *fields("usable", FLAG),
    *fields("reasons", REASONS),
    *fields("sentence", TEXT),
)

# One move of a schedule: when masses are sent, and where to from home.
SENT = shape(
    Key("time_s", NUMBER, lambda move: move[0]),
    Key("targets_m", NUMBERS, lambda move: move[1]),
)

PARAMETER = shape(
    *fields("name unit", TEXT),
    *fields("value sd low95 high95", NUMBER),
    *fields("observable", FLAG),
)

# A jump of momentum in laboratory axes, or of com in body axes.
EVENT = shape(
    *fields("kind", TEXT),
    *fields("kind_unclear=unclear", FLAG),
    *fields("time_s=t time_sd_s=t_sd", NUMBER),
    Key("unit", TEXT, lambda e: UNITS[e.kind]),
    *fields("size", VECTOR),
    *fields("covariance", MATRIX),
    *fields("chi_square=surprise azimuth_rad=azimuth", NUMBER),
)

RESIDUAL = shape(
    *fields("attitude_rms_rad=attitude_rms rate_rms_rad_s=rate_rms", NUMBER),
    *fields("chi_square degrees_of_freedom reduced_chi_square lag_one", NUMBER),
    *fields("whiteness_p=whiteness spectral_peak steady_rms held_out_rms", NUMBER),
    *fields("held_out_span_s=held_out_span", maybe(VECTOR)),
    *fields("error_index", NUMBER),
    *fields("parameter_error_indices=error_indices", NUMBERS),
)

# Parameters along a record, a row for each time; units are those of the parameters.
COURSE = shape(
    *fields("names", TEXTS),
    *fields("t_s=t", VECTOR),
    *fields("values sd", MATRIX),
)

# What a record showed of what its plan had predicted.
PLAN_CHECK = shape(
    *fields("source", TEXT),
    *fields(
        "parameters", many(shape(*fields("name", TEXT), *fields("predicted_sd found_sd", NUMBER)))
    ),
)

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
    Key("findings", many(FINDING), lambda _: ()),  # see ``estimate_json``
    *fields("provenance", by_name(TEXT)),
    Key("plan", PLAN_CHECK, lambda _: None, optional=True),
)

RECORDING = document(
    "equipoise/recording/1",
    *fields("source sha256", TEXT),
    *fields("span_s=span", VECTOR),
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
    *fields("com_m=com sd_m=sd noise_floor_m=noise_floor", maybe(VECTOR)),
)

# What a move or a placing should leave.
PREDICTED = (
    *fields("predicted_com_m=predicted_com", VECTOR),
    *fields("predicted_covariance_m2=predicted_covariance", MATRIX),
)

MOVE = shape(
    *fields("targets_m=targets", NUMBERS),
    *fields("travel_m=travel duration_s=duration", NUMBER),
    *PREDICTED,
    *fields("reason", TEXT),
)

# The step's sentence says what goes where.
PLACING = shape(*fields("handled", COUNT), *PREDICTED)

# A platform as it is loaded by hand; the covariance is of J_P xx yy zz xy xz yz and com x y z.
KNOWN = shape(
    *fields("mass_kg=mass", NUMBER, "body"),
    *fields("com_m=com", VECTOR, "body"),
    *fields("inertia_P_kg_m2=inertia_P", MATRIX, "body"),
    *fields("covariance=body_covariance", MATRIX),
)

STEP = shape(
    *fields("kind code", TEXT),
    *fields("time_s=time", NUMBER),
    *fields("reasons", REASONS),
    *fields("sentence", TEXT),
    *fields("estimate", ESTIMATE, optional=True),
    *fields("move", MOVE, optional=True),
    *fields("placing", PLACING, optional=True),
    *fields("verdict", VERDICT, optional=True),
    *fields("known", KNOWN, optional=True),
)

TRUTH = shape(
    *fields("com_m=com", VECTOR),
    *fields("inertia_P_kg_m2=inertia_P", MATRIX),
)

# Truth only where it is simulated; a run that waits for a person has no verdict yet.
BALANCED = (
    *fields("steps", many(STEP)),
    *fields("verdict", maybe(VERDICT)),
    *fields("truth", TRUTH, optional=True),
    *fields("provenance", by_name(TEXT)),
)
BALANCE = document("equipoise/balance/2", *BALANCED)

# What a balance that is kept for hours comes to; truth only where it is simulated.
KEEP = document(
    "equipoise/keep/1",
    *fields("steps", many(STEP)),
    *fields("verdict", VERDICT),
    *fields("moves", COUNT),
    *fields("travel_m=travel", NUMBER),
    *fields("t_s=t", VECTOR, "course"),
    *fields("com_m=values sd_m=sd", MATRIX, "course"),
    *fields("truth_m=truth", maybe(MATRIX)),
    *fields("provenance", by_name(TEXT)),
)

BALANCE_SERIES = document(
    "equipoise/balance_series/1",
    *fields("verdict", VERDICT),
    *fields("runs", many(shape(*fields("seed", COUNT), *BALANCED))),
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
