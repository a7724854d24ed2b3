"""Comparisons, cards, devices, logbooks, bodies and channels as JSON documents, SI units."""

from equipoise.app.text.json_document import ESTIMATE, NUMBERS, PARAMETER, SENT, TEXTS
from equipoise.app.text.json_shape import (
    COUNT,
    FLAG,
    MATRIX,
    NUMBER,
    TEXT,
    VECTOR,
    by_name,
    document,
    fields,
    key,
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
        key("period_s", NUMBER, lambda card: card.period),
        *fields("follows", FLAG),
    ))),
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
    key("time_s", NUMBER, lambda method: method.time),
    key("memory_bytes", maybe(COUNT), lambda method: method.memory),
    key("settled_s", NUMBER, lambda method: method.settled),
)

COMPARE_METHODS = document(
    "equipoise/compare_methods/2",
    key("testbed", TEXT, lambda made: made["found"].scene.testbed.name),
    key("seeds", many(COUNT), lambda made: made["found"].seeds),
    key("duration_s", NUMBER, lambda made: made["found"].scene.duration),
    key("moves", many(SENT), lambda made: made["found"].scene.moves),
    key("options", shape(*fields("terms hold", TEXTS), *fields("use_prior robust", FLAG)),
        lambda made: made["found"].scene.options),
    *fields("parameters", TEXTS),
    key("bound", VECTOR, lambda made: made["found"].bound),
    key("methods", many(METHOD_SUMMARY), lambda made: made["found"].methods),
    *fields("recommended", shape(*fields("com inertia", ADVICE))),
)  # fmt: skip

# The middle of many runs, and what 95 % of them stay below.
MIDDLE = shape(*fields("median most", NUMBER))

LAW_SUMMARY = shape(
    *fields("law", TEXT),
    *fields("runs halted late within false_passes", COUNT),
    key("aside_m", MIDDLE, lambda law: law.aside),
    key("height_m", MIDDLE, lambda law: law.height),
    key("torque_N_m", MIDDLE, lambda law: law.torque),
    key("followed_N_m", maybe(MIDDLE), lambda law: law.followed),
    key("time_s", MIDDLE, lambda law: law.time),
    key("travel_m", MIDDLE, lambda law: law.travel),
)

COMPARE_LAWS = document(
    "equipoise/compare_laws/2",
    key("testbed", TEXT, lambda made: made["found"].testbed.name),
    key("seeds", many(COUNT), lambda made: made["found"].seeds),
    key("tilt_rad", NUMBER, lambda made: made["found"].tilt),
    key("required_torque_N_m", NUMBER, lambda made: made["found"].required),
    key("torque_before_N_m", MIDDLE, lambda made: made["found"].before),
    key("laws", many(LAW_SUMMARY), lambda made: made["found"].laws),
    key("refused", many(shape(*fields("law why", TEXT))), lambda made: made["found"].refusals),
    *fields("recommended", ADVICE),
)

COMPARE = document(
    "equipoise/compare/2",
    *fields("methods", COMPARE_METHODS),
    *fields("laws", COMPARE_LAWS),
)

MANOEUVRE = shape(
    key("start_rad", VECTOR, lambda made: made["start"]),
    key("singular_s", maybe(VECTOR), lambda made: made["singular"]),
    *fields("truth", NUMBERS),
    *fields("estimates", by_name(ESTIMATE)),
    *fields("warns", by_name(FLAG)),
    *fields("least_sd least_sd_of_preset_sensors", NUMBERS),
)

REPRODUCE_LEE = document(
    "equipoise/reproduce-lee/2",
    *fields("seed", COUNT),
    *fields("loop", shape(*fields("frequency_rad_s damping integral_rad_s", NUMBER))),
    *fields("manoeuvres", many(MANOEUVRE)),
)

DEVICES = document(
    "equipoise/devices/1", *fields("serial", many(shape(*fields("path what", TEXT))))
)

LOGGED_RUN = shape(
    *fields("name kind made_at platform configuration method bench outcome sentence", TEXT),
    key("temperature_degC", NUMBER, lambda run: run["temperature"]),
    *fields("parameters com_as_judged", many(PARAMETER)),
    *fields("provenance", by_name(TEXT)),
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
    key("mass_kg", NUMBER, lambda body: body.mass),
    key("com_m", VECTOR, lambda body: body.com),
    key("inertia_P_kg_m2", MATRIX, lambda body: body.inertia_P),
    key("possible", FLAG, is_possible),
)

# Rows of one channel; values are in SI, a column for each of ``columns``.
CHANNEL = shape(
    *fields("columns", TEXTS),
    key("t_s", VECTOR, lambda channel: channel["rows"].t),
    key("values", MATRIX, lambda channel: channel["rows"].values),
)

CHANNELS = document(
    "equipoise/channels/1",
    *fields("source sha256", TEXT),
    *fields("notes", TEXTS),
    *fields("channels", by_name(CHANNEL)),
)
