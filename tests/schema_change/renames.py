"""The table: how documents may differ from those of the former revision.

It is empty: no key, unit or word may change. A change of the schema is declared here, as in

    renamed=(
        Rename("balance_*", "**.verdict.com_um", "com_m", former_per_new=1e6),
        Rename("balance_*", "**.predicted_covariance_um2", "predicted_covariance_m2", 1e12),
    ),
    added=(Added("*", "**.outcome.code"),),
    removed=(Removed("assess_*", "over_hours"),),
    recoded=(Recoded("*", "**.schema", (("equipoise/balance/1", "equipoise/balance/2"),)),),

The first rename that meets a key counts. Ignored keys are declared by their former names.
"""

from tests.schema_change.changes import Ignored, Recoded, Rename, SchemaChange

CHANGE = SchemaChange(
    renamed=(
        Rename("assess_*", "**.looks", "metrics"),
        Rename("assess_*", "**.looks_alone", "measurements_alone"),
        Rename("design", "looks", "measurements"),
        Rename("plan", "**.asked", "requested"),
        Rename("compare", "methods.methods.*.believed", "trusted"),
    ),
    recoded=(
        Recoded("*", "**.kind", (("look", "measurement"),)),
        Recoded("design", "budget.*.name", (("look", "measurement"),)),
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
    Ignored("*", "**.unobservable.*", PROSE),
    Ignored("*", "**.unexplained.*", PROSE),
    Ignored("*", "**.no_period", PROSE),
    Ignored("assess_*", "required.*.what", PROSE),
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
