"""The torque on a platform by cause as a JSON document, SI units, body axes."""

from equipoise.app.text.json_document import REASONS
from equipoise.app.text.json_shape import (
    MATRIX,
    NUMBER,
    TEXT,
    VECTOR,
    Key,
    Kind,
    by_name,
    document,
    fields,
    shape,
)

BY_CAUSE = by_name(MATRIX)


def _by_cause(name: str, field: int) -> Key:
    """Return a key of the torques, or of their sd, by the names of the causes."""
    return Key(name, BY_CAUSE, lambda torque: {c: torque.of(c)[field] for c in torque.causes})


CLOSURE: Kind = shape(
    *fields("left_N_m=left sd_N_m=sd", MATRIX),
    *fields("normalised_rms share_within", NUMBER),
)

# Means over intervals that begin at t_s; rows are x, y, z.
LEDGER = document(
    "equipoise/ledger/1",
    *fields("source sha256", TEXT),
    *fields("interval_s=interval", NUMBER),
    *fields("t_s=t", VECTOR),
    _by_cause("torque_N_m", 0),
    _by_cause("sd_N_m", 1),
    *fields("total_N_m=total total_sd_N_m=total_sd", MATRIX),
    *fields("unmodelled_sd_N_m=unmodelled_sd", NUMBER),
    *fields("unmodelled_correlation_s=unmodelled_correlation", NUMBER),
    *fields("closure", CLOSURE),
    *fields("reasons", REASONS),
)
