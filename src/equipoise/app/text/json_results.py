"""Assessments, plans, designs, comparisons, lists and logbooks as JSON documents, SI units."""

from equipoise.app.text.json_document import (
    ESTIMATE,
    NUMBERS,
    PARAMETER,
    REASONS,
    SENT,
    TEXTS,
    VERDICT,
    WHY,
)
from equipoise.app.text.json_shape import (
    COUNT,
    FLAG,
    MATRIX,
    NUMBER,
    TEXT,
    VECTOR,
    Key,
    Kind,
    Read,
    document,
    fields,
    key,
    many,
    maybe,
    shape,
)

# A length with its 95 % bounds, and the least that the record could have proven.
BOUNDED = shape(*fields("value low high floor", NUMBER))


def along_record(unit: str) -> Kind:
    """Return the kind of a torque or an energy along a record; com as the masses stand."""
    return shape(
        key(f"rms_{unit}", NUMBER, lambda found: found["series"].rms),
        key(f"rms_sd_{unit}", NUMBER, lambda found: found["series"].rms_sd),
        key(f"greatest_{unit}", NUMBER, lambda found: found["series"].greatest),
        key(f"noise_{unit}", NUMBER, lambda found: found["series"].noise),
        key("com_m", maybe(VECTOR), lambda found: found["com"]),
        key("com_covariance_m2", maybe(MATRIX), lambda found: found["com_covariance"]),
    )


SWING = shape(
    *fields("mode", TEXT),
    key("frequency_hz", NUMBER, lambda found: found["swing"].frequency),
    key("frequency_sd_hz", NUMBER, lambda found: found["swing"].sd),
    key("period_s", NUMBER, lambda found: 1 / found["swing"].frequency),
    key("amplitude_rad", NUMBER, lambda found: found["swing"].amplitude),
    key("decay_1_s", NUMBER, lambda found: found["swing"].decay),
    key("distance_m", NUMBER, lambda found: found["distance"]),
    key("distance_sd_m", NUMBER, lambda found: found["distance_sd"]),
)

PLATFORM = (
    key("com", shape(
        key("value_m", VECTOR, lambda done: done.com),
        key("covariance_m2", MATRIX, lambda done: done.com_covariance),
        key("covariance_at_inertia_m2", MATRIX, lambda done: done.com_unscaled),
        key("distance_from_target_m", BOUNDED, lambda done: done.offset),
    ), lambda found: found["done"]),
    key("torque_in_range", shape(
        key("tilt_rad", NUMBER, lambda torque: torque.tilt),
        key("rms_N_m", BOUNDED, lambda torque: torque.rms),
        key("greatest_N_m", NUMBER, lambda torque: torque.worst),
        key("greatest_high_N_m", NUMBER, lambda torque: torque.worst_high),
    ), lambda found: found["done"].torque),
    key("inertia_sd", NUMBER, lambda found: found["done"].inertia_sd),
    key("metrics", shape(
        key("duration_s", NUMBER, lambda found: found["done"].metrics.duration),
        key("window_s", NUMBER, lambda found: found["done"].metrics.window),
        *fields("torque", maybe(along_record("N_m"))),
        *fields("energy", maybe(along_record("J"))),
        *fields("swings", many(SWING)),
        key("no_period", TEXT, lambda found: found["done"].metrics.quiet),
    ), lambda found: found),
)  # fmt: skip


def of_wander(name: str, kind: Kind, read: Read) -> Key:
    """Return a key that is there where measurements were enough for drift and Allan deviation."""
    return key(name, kind, lambda hours: hours.wander and read(hours.wander), optional=True)


OVER_HOURS = shape(
    key("t_s", VECTOR, lambda hours: hours.t),
    key("com_m", MATRIX, lambda hours: hours.com),
    key("sd_m", MATRIX, lambda hours: hours.sd),
    *fields("left_out", COUNT),
    of_wander("drift_m_s", VECTOR, lambda wander: wander.drift),
    of_wander("drift_sd_m_s", VECTOR, lambda wander: wander.drift_sd),
    of_wander("walk_m_rts", VECTOR, lambda wander: wander.walk),
    of_wander("allan", shape(
        key("span_s", VECTOR, lambda wander: wander.span),
        key("deviation_m", MATRIX, lambda wander: wander.deviation),
        key("relative_sd", VECTOR, lambda wander: wander.error),
        key("measurements_alone_m", MATRIX, lambda wander: wander.measurements_alone),
    ), lambda wander: wander),
)  # fmt: skip

# The limit is in the SI unit of what is required.
REQUIRED = shape(
    key("quantity", TEXT, lambda judged: judged.requirement.quantity),
    key("limit", NUMBER, lambda judged: judged.requirement.limit),
    *fields("outcome", TEXT),
    *fields("reasons", REASONS),
    *fields("sentence", TEXT),
)

ASSESS = document(
    "equipoise/assess/2",
    *fields("verdict", maybe(VERDICT)),
    *fields("required", many(REQUIRED)),
    *PLATFORM,
    *fields("before", maybe(shape(*PLATFORM))),
    *fields("over_hours", maybe(OVER_HOURS)),
    *fields("estimate", ESTIMATE),
)  # fmt: skip

# What a manoeuvre is expected to show; sd by parameter, SI.
PROMISE = shape(
    key("sd", NUMBERS, lambda p: dict(zip(p.names, map(float, p.sd), strict=True))),
    *fields("platforms", COUNT),
    key("platforms_tried_for_limits", COUNT, lambda p: p.tried),
    key("within_limits", COUNT, lambda p: p.kept),
    key("greatest_tilt_rad", NUMBER, lambda p: p.greatest_tilt),
    key("greatest_rate_rad_s", NUMBER, lambda p: p.greatest_rate),
    key("peak_momentum_N_m_s", NUMBER, lambda p: p.expected.peak_momentum),
    *fields("unobservable", REASONS),
)

# The amplitude is a wheel's torque (N m) or the rate of a gyro's gimbal (rad/s).
WAVE = shape(
    *fields("device", TEXT),
    *fields("amplitude", NUMBER),
    key("period_s", NUMBER, lambda wave: wave.period),
    *fields("phase", NUMBER),
)

PLAN = document(
    "equipoise/plan/2",
    key("testbed", TEXT, lambda made: made["done"].request.testbed.name),
    key("requested", TEXTS, lambda made: made["done"].request.names),
    key("criterion", TEXT, lambda made: made["done"].request.criterion),
    *fields("sizes", shape(*fields("com_m inertia_relative", NUMBER))),
    key("duration_s", NUMBER, lambda made: made["done"].planned.manoeuvre.duration),
    key("tilt_rad", NUMBER, lambda made: made["done"].planned.manoeuvre.tilt),
    key("low_side", VECTOR, lambda made: made["done"].planned.manoeuvre.low_side),
    key("rate_rad_s", VECTOR, lambda made: made["done"].planned.manoeuvre.rate),
    key("tilt_sd_rad", NUMBER, lambda made: made["done"].planned.manoeuvre.tilt_sd),
    key("rate_sd_rad_s", NUMBER, lambda made: made["done"].planned.manoeuvre.rate_sd),
    key("standing_m", NUMBERS, lambda made: made["done"].planned.manoeuvre.standing),
    key("moves", many(SENT), lambda made: made["done"].planned.manoeuvre.moves),
    key("waves", many(WAVE), lambda made: made["done"].planned.manoeuvre.waves),
    key("usual", PROMISE, lambda made: made["done"].usual),
    key("planned", PROMISE, lambda made: made["done"].planned),
)

# What the masses can reach; facets are normal . shift <= height.
REACH = shape(
    *fields("rank", COUNT),
    *fields("low_m high_m", VECTOR),
    *fields("tolerance_m", NUMBER),
    *fields("weakest_direction", VECTOR),
    *fields("volume_m3", NUMBER),
    *fields("facet_normals", MATRIX),
    *fields("facet_heights_m", VECTOR),
    *fields("share_within", NUMBER),
    *fields("sentence", TEXT),
)

# The least step of a mass.
MASS_STEP = shape(
    key("name", TEXT, lambda step: step.mass.name),
    key("mass_kg", NUMBER, lambda step: step.mass.mass),
    key("step_m", NUMBER, lambda step: step.mass.resolution),
    key("com_step_m", NUMBER, lambda step: step.shift),
    key("torque_N_m", NUMBER, lambda step: step.torque),
    key("torque_within_tilt_N_m", NUMBER, lambda step: step.within_tilt),
    key("com_stop_sd_m", NUMBER, lambda step: step.stop_sd),
)

MEASUREMENT = shape(
    key("com_sd_m", VECTOR, lambda measurement: measurement.com_sd),
    key("com_covariance_m2", MATRIX, lambda measurement: measurement.com),
    key("inertia_P_sd_kg_m2", VECTOR, lambda measurement: measurement.inertia_sd),
    key("peak_tilt_rad", NUMBER, lambda measurement: measurement.peak_tilt),
)

# What a length of record comes to.
LENGTH = shape(
    key("record_s", NUMBER, lambda budget: budget.first.duration),
    *fields("first last", MEASUREMENT),
    key("torque_N_m", NUMBER, lambda budget: budget.torque),
)

CONTRIBUTION = shape(
    *fields("name cause", TEXT),
    key("torque_N_m", NUMBER, lambda line: line.torque),
    key("com_moment_m2", maybe(MATRIX), lambda line: line.moment),
    *fields("basis", TEXT),
)

# What would be left with one thing better.
BETTER = shape(
    key("change", TEXT, lambda better: better.name),
    key("torque_N_m", NUMBER, lambda better: better.torque),
    key("share_within", NUMBER, lambda better: better.within),
)


def of_reason(each: Key) -> Key:
    """Return a key of a reason as one of a caution: a reason and lengths of records."""
    return key(each.name, each.kind, lambda caution: each.read(caution[0]))


CAUTION = shape(*map(of_reason, WHY), key("records_s", VECTOR, lambda caution: caution[1]))

DESIGN = document(
    "equipoise/design/1",
    key("testbed", TEXT, lambda made: made["found"].case.testbed.name),
    key("source", TEXT, lambda made: made["found"].case.testbed.source),
    key("target_m", VECTOR, lambda made: made["found"].case.target),
    key("tilt_rad", NUMBER, lambda made: made["found"].case.tilt),
    key("moves", COUNT, lambda made: made["found"].case.moves),
    *fields("reach", REACH),
    key("masses", many(MASS_STEP), lambda made: made["found"].steps),
    key("measurements", many(LENGTH), lambda made: made["found"].budgets),
    key("budget", many(CONTRIBUTION), lambda made: made["found"].budget.lines),
    key("better", many(BETTER), lambda made: made["found"].better),
    key("limit", TEXT, lambda made: made["found"].limit),
    *fields("not_stated", TEXTS),
    *fields("cautions", many(CAUTION)),
    key("verdict", VERDICT, lambda made: made["found"].verdict),
)  # fmt: skip

# The least sd that a record allows, beside the sd that the testbed states.
BOUND = shape(
    *fields("name unit", TEXT),
    *fields("sd testbed_sd", NUMBER),
    *fields("observable held", FLAG),
)

FILTER = shape(
    *fields("name measures", TEXT),
    *fields("size", COUNT),
    key("possible_rank", COUNT, lambda view: view.possible),
    *fields("rank", maybe(COUNT)),
    *fields("unobservable", REASONS),
)

OBSERVE = document(
    "equipoise/observe/1",
    *fields("source sha256", TEXT),
    *fields("parameters", many(BOUND)),
    key("ratios", many(PARAMETER), lambda made: made["found"].ratios),
    key("rank", COUNT, lambda made: made["found"].rank),
    key("size", COUNT, lambda made: made["found"].size),
    key("condition", NUMBER, lambda made: made["found"].condition),
    key("gravity_sweep", NUMBER, lambda made: made["found"].gravity_sweep),
    key("tilt_rad", VECTOR, lambda made: made["found"].tilt),
    key("inertia_P_kg_m2", MATRIX, lambda made: made["found"].inertia_P),
    key("unobservable", REASONS, lambda made: made["found"].unobservable),
    key("cautions", REASONS, lambda made: made["found"].cautions),
    *fields("filters", many(FILTER)),
)
