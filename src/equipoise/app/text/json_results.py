"""Assessments, plans, designs and observations as JSON documents, SI units."""

from equipoise.app.text.json_document import (
    ESTIMATE,
    FINDING,
    NUMBERS,
    PARAMETER,
    REASONS,
    SENT,
    TEXTS,
    VERDICT,
    why,
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
    document,
    fields,
    many,
    maybe,
    shape,
)

# A length with its 95 % bounds, and the least that the record could have proven.
BOUNDED = shape(*fields("value low high floor", NUMBER))


def along_record(unit: str) -> Kind:
    """Return the kind of a torque or an energy along a record; com as the masses stand."""
    return shape(
        *fields(f"rms_{unit}=rms rms_sd_{unit}=rms_sd", NUMBER, "series"),
        *fields(f"greatest_{unit}=greatest noise_{unit}=noise", NUMBER, "series"),
        *fields("com_m=com", maybe(VECTOR)),
        *fields("com_covariance_m2=com_covariance", maybe(MATRIX)),
    )


SWING = shape(
    *fields("mode", TEXT),
    *fields("frequency_hz=frequency frequency_sd_hz=sd", NUMBER, "swing"),
    Key("period_s", NUMBER, lambda found: 1 / found["swing"].frequency),
    *fields("amplitude_rad=amplitude decay_1_s=decay", NUMBER, "swing"),
    *fields("distance_m=distance distance_sd_m=distance_sd", NUMBER),
)

# What a cross-check found, whether the estimate's trust hangs on it, and whether it contradicts.
CROSS_CHECK = shape(
    *fields("metric code", TEXT),
    *fields("counts disagrees", FLAG),
    *fields("distance_m=distance distance_sd_m=sd off_sd=off", NUMBER, "found"),
    *fields("reasons", REASONS),
    *fields("sentence", TEXT),
)

COM = shape(
    *fields("value_m=com", VECTOR),
    *fields("covariance_m2=com_covariance covariance_at_inertia_m2=com_unscaled", MATRIX),
    *fields("distance_from_target_m=offset", BOUNDED),
)

TORQUE_IN_RANGE = shape(
    *fields("tilt_rad=tilt", NUMBER),
    *fields("rms_N_m=rms", BOUNDED),
    *fields("greatest_N_m=worst greatest_high_N_m=worst_high", NUMBER),
)

METRICS = shape(
    *fields("duration_s=duration window_s=window", NUMBER, "done.metrics"),
    *fields("torque", maybe(along_record("N_m"))),
    *fields("energy", maybe(along_record("J"))),
    *fields("swings", many(SWING)),
    *fields("no_period=quiet", TEXT, "done.metrics"),
)

PLATFORM = (
    *fields("com=done", COM),
    *fields("torque_in_range=done.torque", TORQUE_IN_RANGE),
    *fields("inertia_sd", NUMBER, "done"),
    Key("metrics", METRICS, lambda found: found),
    *fields("cross_checks", many(CROSS_CHECK)),
)


ALLAN = shape(
    *fields("span_s=span", VECTOR),
    *fields("deviation_m=deviation", MATRIX),
    *fields("relative_sd=error", VECTOR),
    *fields("measurements_alone_m=measurements_alone", MATRIX),
)

# Drift and Allan deviation are there where measurements were enough for them.
OVER_HOURS = shape(
    *fields("t_s=t", VECTOR),
    *fields("com_m=com sd_m=sd", MATRIX),
    *fields("left_out", COUNT),
    *fields("drift_m_s=drift drift_sd_m_s=drift_sd walk_m_rts=walk", VECTOR, "wander", True),
    *fields("allan=wander", ALLAN, optional=True),
)

# The limit is in the SI unit of what is required.
REQUIRED = shape(
    *fields("quantity", TEXT, "requirement"),
    *fields("limit", NUMBER, "requirement"),
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
)

# How much a run deviates from all together: chi-square in the sd of that difference.
DEVIATION = shape(*fields("chi_square freedom probability", NUMBER))

ONE_RUN = shape(
    *fields("name", TEXT),
    *fields("sha256", TEXT, "recording"),
    *fields("used", FLAG),
    *fields("deviation", maybe(DEVIATION)),
    *fields("findings", many(FINDING)),
    *fields("estimate", ESTIMATE),
)

# One parameter over the runs that show it.
SPREAD = shape(
    *fields("name unit", TEXT),
    *fields("runs", COUNT),
    *fields("mean sd_between sd_stated", NUMBER),
)

SCATTER = shape(
    *fields("chi_square freedom probability factor", NUMBER),
    *fields("parameters=spreads", many(SPREAD)),
)

IDENTIFY_RUNS = document(
    "equipoise/identify_runs/1",
    *fields("verdict", VERDICT),
    *fields("scatter=joint.scatter", maybe(SCATTER)),
    *fields("estimate", ESTIMATE),
    *fields("runs", many(ONE_RUN)),
)

# What a manoeuvre is expected to show; sd by parameter, SI.
PROMISE = shape(
    Key("sd", NUMBERS, lambda p: dict(zip(p.names, map(float, p.sd), strict=True))),
    *fields("platforms platforms_tried_for_limits=tried within_limits=kept", COUNT),
    *fields("greatest_tilt_rad=greatest_tilt greatest_rate_rad_s=greatest_rate", NUMBER),
    *fields("peak_momentum_N_m_s=peak_momentum", NUMBER, "expected"),
    *fields("unobservable", REASONS),
)

# The amplitude is a wheel's torque (N m) or the rate of a gyro's gimbal (rad/s).
WAVE = shape(
    *fields("device", TEXT),
    *fields("amplitude period_s=period phase", NUMBER),
)

CHOSEN = "done.planned.manoeuvre"
PLAN = document(
    "equipoise/plan/2",
    *fields("testbed=testbed.name", TEXT, "done.request"),
    *fields("requested=names", TEXTS, "done.request"),
    *fields("criterion", TEXT, "done.request"),
    *fields("sizes", shape(*fields("com_m inertia_relative", NUMBER))),
    *fields("duration_s=duration tilt_rad=tilt", NUMBER, CHOSEN),
    *fields("low_side rate_rad_s=rate", VECTOR, CHOSEN),
    *fields("tilt_sd_rad=tilt_sd rate_sd_rad_s=rate_sd", NUMBER, CHOSEN),
    *fields("standing_m=standing", NUMBERS, CHOSEN),
    *fields("moves", many(SENT), CHOSEN),
    *fields("waves", many(WAVE), CHOSEN),
    *fields("usual planned", PROMISE, "done"),
)

# What the masses can reach; facets are normal . shift <= height.
REACH = shape(
    *fields("rank", COUNT, "found.reach"),
    *fields("low_m high_m", VECTOR),
    *fields("tolerance_m", NUMBER),
    *fields("weakest_direction", VECTOR),
    *fields("volume_m3", NUMBER),
    *fields("facet_normals=normals", MATRIX, "found.reach"),
    *fields("facet_heights_m=heights", VECTOR, "found.reach"),
    *fields("share_within=within", NUMBER, "found.budget"),
    *fields("sentence=reached", TEXT, "found"),
)

# The least step of a mass.
MASS_STEP = shape(
    *fields("name", TEXT, "mass"),
    *fields("mass_kg=mass step_m=resolution", NUMBER, "mass"),
    *fields("com_step_m=shift torque_N_m=torque", NUMBER),
    *fields("torque_within_tilt_N_m=within_tilt com_stop_sd_m=stop_sd", NUMBER),
)

MEASUREMENT = shape(
    *fields("com_sd_m=com_sd", VECTOR),
    *fields("com_covariance_m2=com", MATRIX),
    *fields("inertia_P_sd_kg_m2=inertia_sd", VECTOR),
    *fields("peak_tilt_rad=peak_tilt", NUMBER),
)

# What a length of record comes to.
LENGTH = shape(
    *fields("record_s=first.duration", NUMBER),
    *fields("first last", MEASUREMENT),
    *fields("torque_N_m=torque", NUMBER),
)

CONTRIBUTION = shape(
    *fields("name cause", TEXT),
    *fields("torque_N_m=torque", NUMBER),
    *fields("com_moment_m2=moment", maybe(MATRIX)),
    *fields("basis", TEXT),
)

# What would be left with one thing better.
BETTER = shape(
    *fields("change=name", TEXT),
    *fields("torque_N_m=torque share_within=within", NUMBER),
)

# A reason, and how long the records are of which it holds.
CAUTION = shape(*why("reason"), *fields("records_s", VECTOR))

DESIGN = document(
    "equipoise/design/1",
    *fields("testbed=name source", TEXT, "found.case.testbed"),
    *fields("target_m=target", VECTOR, "found.case"),
    *fields("tilt_rad=tilt", NUMBER, "found.case"),
    *fields("moves", COUNT, "found.case"),
    *fields("reach", REACH),
    *fields("masses=steps", many(MASS_STEP), "found"),
    *fields("measurements=budgets", many(LENGTH), "found"),
    *fields("budget=budget.lines", many(CONTRIBUTION), "found"),
    *fields("better together", many(BETTER), "found"),
    *fields("limit", TEXT, "found"),
    *fields("not_stated", TEXTS),
    *fields("cautions", many(CAUTION)),
    *fields("verdict", VERDICT, "found"),
)

# What each part contributes to the variances, and what each swing measured beside what all say.
INERTIA = document(
    "equipoise/inertia/1",
    *fields("name source", TEXT, "stated"),
    *fields("estimate", ESTIMATE),
    *fields("inertia_C=central", many(PARAMETER)),
    *fields("parts=shares", many(shape(
        *fields("name", TEXT),
        *fields("mass_kg=mass share_of_mass=of_mass share_of_com=of_com", NUMBER),
        *fields("share_of_inertia=of_inertia", NUMBER),
    ))),
    *fields("oscillations=checks", many(shape(
        *fields("name", TEXT),
        *fields("measured_kg_m2=measured measured_sd_kg_m2=measured_sd", NUMBER),
        *fields("expected_kg_m2=expected off_sd=off", NUMBER),
    ))),
)  # fmt: skip

# The least sd that a record allows, beside the sd that the testbed states.
BOUND = shape(
    *fields("name unit", TEXT),
    *fields("sd testbed_sd", NUMBER),
    *fields("observable held", FLAG),
)

FILTER = shape(
    *fields("name measures", TEXT),
    *fields("size possible_rank=possible", COUNT),
    *fields("rank", maybe(COUNT)),
    *fields("unobservable", REASONS),
)

OBSERVE = document(
    "equipoise/observe/1",
    *fields("source sha256", TEXT),
    *fields("parameters", many(BOUND)),
    *fields("ratios", many(PARAMETER), "found"),
    *fields("rank size", COUNT, "found"),
    *fields("condition gravity_sweep", NUMBER, "found"),
    *fields("tilt_rad=tilt", VECTOR, "found"),
    *fields("inertia_P_kg_m2=inertia_P", MATRIX, "found"),
    *fields("unobservable cautions", REASONS, "found"),
    *fields("filters", many(FILTER)),
)
