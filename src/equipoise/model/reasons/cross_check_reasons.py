"""What a cross-check of an estimate came to, and why one does not count or shows nothing."""

from equipoise.model.reasons.reason import Code

SAID = "{0}: {distance:um plain} +/- {sd:um plain} um from P, {off:.1f} sd off the fit"


class CrossCheckReason(Code):
    """One thing to know about a cross-check, with its sentence."""

    # It counts
    AGREES = "cross_check_agrees", f"{SAID}. It counts, and agrees."
    DISAGREES = (
        "cross_check_disagrees",
        f"{SAID}; the limit is {{limit:.0f}}. It counts, and disagrees.",
    )

    # It does not
    LEAVES_OUT = (
        "cross_check_leaves_out",
        f"{SAID}. It does not count, because it neglects what the fit found: {{rest}}.",
    )
    ACROSS_EVENTS = (
        "cross_check_across_events",
        f"{SAID}. It does not count, because events lie within its rows.",
    )

    # It shows nothing
    DRIVEN = "swings_driven", "{0}: wheels or known torques drive the platform; no swing is free."
    NO_SWING = "no_swing", "{0}: no swing of {duration:.3g} s or less."
    NO_SWING_BESIDE_SPIN = (
        "no_swing_beside_spin",
        "{0}: no swing of {duration:.3g} s or less that can be separated from the spin "
        "(period {period:.3g} s) and its harmonics.",
    )
    FEW_ROWS = "few_rows_of_swing", "{0}: only {rows:.0f} rows since the masses stopped."
    NO_ESTIMATE = "cross_check_without_estimate", "{0}:"  # the estimate's own reasons follow
