"""The table: how documents may differ from those of the former revision.

A change of the schema is declared here: a key that is called otherwise, with the factor of its unit
where that changed; also what is ``Added`` or ``Removed``, and words that were ``Recoded``.

The first rename that meets a key counts. Ignored keys are declared by their former names.
"""

from tests.schema_change.changes import Added, Ignored, Recoded, Removed, Rename, SchemaChange

ANSWERS = (("Passed", "passed"), ("Failed", "failed"), ("Cannot tell", "undecided"))
NOW_REASONS = ("unobservable", "unexplained")  # a sentence each before, now reasons
CHANGE = SchemaChange(
    renamed=(
        # Words.
        Rename("assess_*", "**.looks", "metrics"),
        Rename("design", "looks", "measurements"),
        Rename("plan", "**.asked", "requested"),
        Rename("compare", "methods.methods.*.believed", "trusted"),
        # Other units became SI.
        Rename("balance_*", "**.com_um", "com_m", 1e6),
        Rename("balance_*", "**.sd_um", "sd_m", 1e6),
        Rename("balance_*", "**.noise_floor_um", "noise_floor_m", 1e6),
        Rename("balance_*", "**.move.targets_mm", "targets_m", 1e3),
        Rename("balance_*", "**.move.travel_mm", "travel_m", 1e3),
        Rename("balance_*", "**.predicted_com_um", "predicted_com_m", 1e6),
        Rename("balance_*", "**.predicted_covariance_um2", "predicted_covariance_m2", 1e12),
        # Keys say the unit of their number.
        Rename("assess_*", "**.com.value", "value_m"),
        Rename("assess_*", "**.com.covariance", "covariance_m2"),
        Rename("assess_*", "**.com.covariance_at_inertia", "covariance_at_inertia_m2"),
        Rename("assess_*", "**.com.distance_from_target", "distance_from_target_m"),
        Rename("assess_*", "**.torque_in_range.tilt", "tilt_rad"),
        Rename("assess_*", "**.torque_in_range.rms", "rms_N_m"),
        Rename("assess_*", "**.torque_in_range.greatest", "greatest_N_m"),
        Rename("assess_*", "**.torque_in_range.greatest_high", "greatest_high_N_m"),
        Rename("assess_*", "**.looks.duration", "duration_s"),
        Rename("assess_*", "**.looks.window", "window_s"),
        Rename("assess_*", "**.looks.torque.rms", "rms_N_m"),
        Rename("assess_*", "**.looks.torque.rms_sd", "rms_sd_N_m"),
        Rename("assess_*", "**.looks.torque.greatest", "greatest_N_m"),
        Rename("assess_*", "**.looks.torque.noise", "noise_N_m"),
        Rename("assess_*", "**.looks.energy.rms", "rms_J"),
        Rename("assess_*", "**.looks.energy.rms_sd", "rms_sd_J"),
        Rename("assess_*", "**.looks.energy.greatest", "greatest_J"),
        Rename("assess_*", "**.looks.energy.noise", "noise_J"),
        Rename("assess_*", "**.looks.*.com", "com_m"),
        Rename("assess_*", "**.looks.*.com_covariance", "com_covariance_m2"),
        Rename("assess_*", "**.looks.swings.*.frequency", "frequency_hz"),
        Rename("assess_*", "**.looks.swings.*.frequency_sd", "frequency_sd_hz"),
        Rename("assess_*", "**.looks.swings.*.period", "period_s"),
        Rename("assess_*", "**.looks.swings.*.amplitude", "amplitude_rad"),
        Rename("assess_*", "**.looks.swings.*.decay", "decay_1_s"),
        Rename("assess_*", "**.looks.swings.*.distance", "distance_m"),
        Rename("assess_*", "**.looks.swings.*.distance_sd", "distance_sd_m"),
        Rename("assess_*", "over_hours.t", "t_s"),
        Rename("assess_*", "over_hours.com", "com_m"),
        Rename("assess_*", "over_hours.sd", "sd_m"),
        Rename("assess_*", "over_hours.drift", "drift_m_s"),
        Rename("assess_*", "over_hours.drift_sd", "drift_sd_m_s"),
        Rename("assess_*", "over_hours.walk", "walk_m_rts"),
        Rename("assess_*", "over_hours.allan.span", "span_s"),
        Rename("assess_*", "over_hours.allan.deviation", "deviation_m"),
        Rename("assess_*", "over_hours.allan.looks_alone", "measurements_alone_m"),
        Rename("compare", "methods.methods.*.time", "time_s"),
        Rename("compare", "methods.methods.*.memory", "memory_bytes"),
        Rename("compare", "methods.methods.*.settled", "settled_s"),
        Rename("compare", "laws.tilt", "tilt_rad"),
        Rename("compare", "laws.required_torque", "required_torque_N_m"),
        Rename("compare", "laws.torque_before", "torque_before_N_m"),
        Rename("compare", "laws.laws.*.aside", "aside_m"),
        Rename("compare", "laws.laws.*.height", "height_m"),
        Rename("compare", "laws.laws.*.torque", "torque_N_m"),
        Rename("compare", "laws.laws.*.followed", "followed_N_m"),
        Rename("compare", "laws.laws.*.time", "time_s"),
        Rename("compare", "laws.laws.*.travel", "travel_m"),
        # Outcomes and verdicts have codes.
        Rename("assess_*", "required.*.answer", "outcome"),
        Rename("design", "outcome", "verdict"),
        Rename("design", "outcome.met", "passed"),
    ),
    added=(
        Added("*", "**.reasons"),
        Added("*", "**.outcome.code"),
        Added("*", "**.outcome.trust"),
        Added("*", "**.verdict.code"),
        Added("*", "**.findings.*.code"),
        Added("balance_*", "steps.*.code"),
        Added("balance_manual", "steps.*.known"),
        Added("assess_*", "required.*.quantity"),
        Added("assess_*", "**.cross_checks"),
        *(
            Added(case, f"verdict.{key}")
            for case in ("assess_*", "design")
            for key in ("outcome", "com_*", "sd_*", "noise_floor_*")
        ),
        *(Added("*", f"**.{key}.*") for key in NOW_REASONS),
    ),
    removed=(
        Removed("*", "**.verdict.sure"),
        Removed("balance_*", "**.verdict.halted"),
        Removed("assess_*", "required.*.what"),
        *(Removed("*", f"**.{key}.*") for key in NOW_REASONS),
    ),
    recoded=(
        Recoded("*", "**.kind", (("look", "measurement"),)),
        Recoded("design", "budget.*.name", (("look", "measurement"),)),
        Recoded("balance_*", "**.verdict.outcome", (("cannot tell", "undecided"),)),
        Recoded("assess_*", "required.*.answer", ANSWERS),
        Recoded(
            "*",
            "**.schema",
            tuple(
                (f"equipoise/{name}/1", f"equipoise/{name}/2")
                for name in (
                    "assess",
                    "balance",
                    "compare",
                    "compare_laws",
                    "compare_methods",
                    "plan",
                )
            ),
        ),
    ),
)

PROSE = "a sentence for people, which may be worded anew; the numbers in it stand beside it"
PLACE = "says where a file lay and what it was called"
HASH = "changes with every byte of a recording, its heading included"
VERSION = "names versions of programs"
CLOCK = "time of day"
COST = "measured on the processor while others use it"

IGNORED = (
    Ignored("*", "**.sentence", PROSE),
    Ignored("*", "**.no_period", PROSE),
    Ignored("balance_*", "**.move.reason", PROSE),
    Ignored("compare", "methods.methods.*.why", PROSE),
    Ignored("design", "better.*.change", PROSE),
    Ignored("design", "budget.*.cause", PROSE),
    Ignored("design", "limit", PROSE),
    Ignored("design", "not_stated.*", PROSE),
    Ignored("*", "**.source", PLACE),
    Ignored("*", "**.provenance.command to repeat", PLACE),
    Ignored("*", "**.sha256", HASH),
    Ignored("*", "**.provenance.version", VERSION),
    Ignored("*", "**.provenance.equipoise", VERSION),
    Ignored("*", "**.provenance.made with", VERSION),
    Ignored("*", "**.provenance.made at", CLOCK),
    Ignored("compare", "methods.methods.*.time", COST),
    Ignored("compare", "methods.methods.*.memory", COST),
)
