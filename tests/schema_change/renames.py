"""The table: how documents may differ from those of the former revision.

No other key, unit or word may change. A change of the schema is declared here, as in

    renamed=(
        Rename("balance_*", "**.verdict.com_um", "com_m", former_per_new=1e6),
        Rename("balance_*", "**.predicted_covariance_um2", "predicted_covariance_m2", 1e12),
    ),
    added=(Added("*", "**.outcome.code"),),
    removed=(Removed("assess_*", "over_hours"),),
    recoded=(Recoded("*", "**.schema", (("equipoise/balance/1", "equipoise/balance/2"),)),),

The first rename that meets a key counts. Ignored keys are declared by their former names.
"""

from tests.schema_change.changes import Added, Ignored, Recoded, Removed, Rename, SchemaChange

ANSWERS = (("Passed", "passed"), ("Failed", "failed"), ("Cannot tell", "undecided"))
NOW_REASONS = ("unobservable", "unexplained")  # a sentence each before, now reasons
CHANGE = SchemaChange(
    renamed=(
        Rename("assess_*", "**.looks", "metrics"),
        Rename("assess_*", "**.looks_alone", "measurements_alone"),
        Rename("design", "looks", "measurements"),
        Rename("plan", "**.asked", "requested"),
        Rename("compare", "methods.methods.*.believed", "trusted"),
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
        Added("assess_*", "required.*.quantity"),
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
