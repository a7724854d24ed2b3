"""Comparisons, cards, devices, logbooks, bodies and channels as JSON documents, SI units."""

from equipoise.app.text.json_document import ESTIMATE, NUMBERS, PARAMETER, SENT, TEXTS
from equipoise.app.text.json_shape import (
    COUNT,
    FLAG,
    MATRIX,
    NUMBER,
    TEXT,
    VECTOR,
    Key,
    by_name,
    document,
    fields,
    many,
    maybe,
    shape,
)
from equipoise.model.mass_properties import is_possible

METHODS = document(
    "equipoise/methods/1",
    *fields("methods", many(shape(
        *fields("name formulation solver source needs cannot_see regime", TEXT),
        *fields("heeds", TEXTS),
    ))),
)  # fmt: skip

LAWS = document(
    "equipoise/laws/2",
    *fields("laws", many(shape(
        *fields("name idea source", TEXT),
        *fields("needs", TEXTS),
        *fields("leaves stable", TEXT),
        *fields("period_s=period", NUMBER),
        *fields("follows", FLAG),
    ))),
    # On a testbed, where one is named.
    *fields("prospects", many(shape(
        *fields("law", TEXT),
        *fields("missing", TEXTS),
        *fields("refused", maybe(TEXT)),
        *fields("expected_s=expected", maybe(NUMBER)),
    )), optional=True),
)  # fmt: skip

# What is recommended, null where nothing is, and why.
ADVICE = shape(*fields("name", maybe(TEXT)), *fields("sentence", TEXT))
SHARE = shape(*fields("part of", COUNT))

# Errors of a group of parameters in units of the least sd that the records allow.
RATIOS = shape(*fields("rmse bias", NUMBER), *fields("stated", SHARE))

# Arrays are in the order of ``parameters``.
METHOD_SUMMARY = shape(
    *fields("method family", TEXT),
    *fields("runs refused unusable broke", COUNT),
    *fields("why", TEXT),
    *fields("warned", COUNT),
    *fields("bias sd rmse", VECTOR),
    *fields("com inertia", RATIOS),
    *fields("coverage", SHARE),
    *fields("trusted", COUNT),
    *fields("nees", NUMBER),
    *fields("confident_wrong", COUNT),
    *fields("time_s=time", NUMBER),
    *fields("memory_bytes=memory", maybe(COUNT)),
    *fields("settled_s=settled", NUMBER),
)

OPTIONS = shape(*fields("terms hold", TEXTS), *fields("use_prior robust", FLAG))

COMPARE_METHODS = document(
    "equipoise/compare_methods/2",
    *fields("testbed=testbed.name", TEXT, "found.scene"),
    *fields("seeds", many(COUNT), "found"),
    *fields("duration_s=duration", NUMBER, "found.scene"),
    *fields("moves", many(SENT), "found.scene"),
    *fields("options", OPTIONS, "found.scene"),
    *fields("parameters", TEXTS),
    *fields("bound", VECTOR, "found"),
    *fields("methods", many(METHOD_SUMMARY), "found"),
    *fields("recommended", shape(*fields("com inertia", ADVICE))),
)

# The middle of many runs, and what 95 % of them stay below.
MIDDLE = shape(*fields("median most", NUMBER))

LAW_SUMMARY = shape(
    *fields("law", TEXT),
    *fields("runs halted late within false_passes", COUNT),
    *fields("aside_m=aside height_m=height torque_N_m=torque", MIDDLE),
    *fields("followed_N_m=followed", maybe(MIDDLE)),
    *fields("time_s=time travel_m=travel", MIDDLE),
)

COMPARE_LAWS = document(
    "equipoise/compare_laws/2",
    *fields("testbed=testbed.name", TEXT, "found"),
    *fields("seeds", many(COUNT), "found"),
    *fields("tilt_rad=tilt required_torque_N_m=required", NUMBER, "found"),
    *fields("torque_before_N_m=before", MIDDLE, "found"),
    *fields("laws", many(LAW_SUMMARY), "found"),
    *fields("refused=refusals", many(shape(*fields("law why", TEXT))), "found"),
    *fields("recommended", ADVICE),
)

COMPARE = document(
    "equipoise/compare/2",
    *fields("methods", COMPARE_METHODS),
    *fields("laws", COMPARE_LAWS),
)

MANOEUVRE = shape(
    *fields("start_rad=start", VECTOR),
    *fields("singular_s=singular", maybe(VECTOR)),
    *fields("truth", NUMBERS),
    *fields("estimates", by_name(ESTIMATE)),
    *fields("warns", by_name(FLAG)),
    *fields("least_sd least_sd_of_preset_sensors", NUMBERS),
)

# A quantity of a paper in ``unit``: as printed, as found here, and what they are to each other.
PAPER_ROW = shape(
    *fields("place quantity unit", TEXT),
    *fields("printed ours", VECTOR),
    *fields("agreement why", TEXT),
)

REPRODUCE = document(
    "equipoise/reproduce/1",
    *fields("paper", TEXT),
    *fields("seeds", many(COUNT)),
    *fields("rows", many(PAPER_ROW)),
)

REPRODUCE_ITEMS = document(
    "equipoise/reproduce-items/1",
    *fields("papers", by_name(TEXT)),
    *fields("items", many(shape(*fields("name place what shown_by", TEXT),
                                *fields("works", FLAG)))),
)  # fmt: skip

REPRODUCE_LEE = document(
    "equipoise/reproduce-lee/3",
    *fields("seed", COUNT),
    *fields("rows", many(PAPER_ROW)),
    *fields("loop", shape(*fields("frequency_rad_s damping integral_rad_s", NUMBER))),
    *fields("manoeuvres", many(MANOEUVRE)),
)

DEVICES = document(
    "equipoise/devices/1", *fields("serial", many(shape(*fields("path what", TEXT))))
)

LOGGED_RUN = shape(
    *fields("name kind made_at platform configuration method bench outcome sentence", TEXT, "run"),
    *fields("temperature_degC=temperature", NUMBER, "run"),
    *fields("parameters com_as_judged", many(PARAMETER)),
    *fields("provenance", by_name(TEXT), "run"),
)

LOGBOOK = document("equipoise/logbook/1", *fields("runs", many(LOGGED_RUN)))

# How many sd each number is from that of the first run.
RUNS_COMPARED = document(
    "equipoise/runs-compared/1",
    *fields("runs", many(LOGGED_RUN)),
    *fields("sd_from_first", by_name(NUMBERS)),
)

BUILDS = document(
    "equipoise/builds/1",
    *fields("builds", many(shape(
        *fields("platform build configuration first_run last_run", TEXT),
        *fields("runs", COUNT),
        *fields("changed", TEXTS),
        *fields("text", TEXT),
    ))),
)  # fmt: skip

# A body's mass, centre of mass and inertia about P, body axes.
MASS_PROPERTIES = document(
    "equipoise/mass_properties/1",
    *fields("mass_kg=mass", NUMBER),
    *fields("com_m=com", VECTOR),
    *fields("inertia_P_kg_m2=inertia_P", MATRIX),
    Key("possible", FLAG, is_possible),
)

WAYS = ("body to laboratory", "laboratory to body")
# Columns of a quaternion are w, x, y, z, those of angles about x, y, z.
TABLE_ATTITUDE = shape(
    Key("columns", TEXTS, lambda a: a.columns if a.sequence else a.ordered),
    Key("turns", TEXT, lambda a: WAYS[1] if a.inverse else WAYS[0]),
    *fields("sequence", TEXT),
    Key("unit", TEXT, lambda a: ("deg" if a.degrees else "rad") if a.sequence else "1"),
    *fields("signs", many(COUNT)),
)

# Columns are those of x, y, z of the attitude's body; misfit is the share of turning that is left.
TABLE_GYRO = shape(
    *fields("columns", TEXTS, "gyro"),
    *fields("signs", many(COUNT), "gyro"),
    *fields("unit", TEXT, "gyro"),
    *fields("factor_rad_s=factor misfit", NUMBER, "gyro"),
    *fields("spans", COUNT, "gyro"),
    *fields("zero_rad_s=zero.rate zero_sd_rad_s=zero.sd", maybe(VECTOR)),
)

# What the columns of an unknown table are in one reading.
TABLE_READING = shape(
    *fields("clock", shape(*fields("column unit", TEXT), *fields("step_s=step", NUMBER))),
    *fields("attitude", TABLE_ATTITUDE),
    Key("gyro", maybe(TABLE_GYRO), lambda reading: reading if reading.gyro else None),
    *fields("up=frame", shape(*fields("lab_up body_up", TEXT), *fields("tilt_rad=tilt", NUMBER))),
)

TRIAD = shape(*fields("columns", TEXTS), *fields("signs", many(COUNT)), *fields("unit", TEXT),
              *fields("factor", NUMBER))  # fmt: skip

# A gyro beside an accelerometer, axes of this; factors are of SI for one of the column's unit.
INERTIAL_UNIT = shape(
    *fields("clock", shape(*fields("column unit", TEXT), *fields("step_s=step", NUMBER))),
    *fields("accelerometer gyro", TRIAD),
    *fields("misfit", NUMBER),
    *fields("spans", COUNT),
    *fields("up", TEXT),
)

IMPORT = document(
    "equipoise/import/1",
    *fields("source outcome", TEXT),
    *fields("taken", maybe(TABLE_READING)),
    *fields("inertial_unit", maybe(INERTIAL_UNIT)),
    *fields("alike", many(TABLE_READING)),
    *fields("next", maybe(TABLE_READING)),
    *fields("left_aside sentences", TEXTS),
)

# Rows of one channel; values are in SI, a column for each of ``columns``.
CHANNEL = shape(
    *fields("columns", TEXTS),
    *fields("t_s=rows.t", VECTOR),
    *fields("values=rows.values", MATRIX),
)

CHANNELS = document(
    "equipoise/channels/1",
    *fields("source sha256", TEXT),
    *fields("notes", TEXTS),
    *fields("channels", by_name(CHANNEL)),
)
