"""What there is to know about a sum of parts, and about swings that confirm or deny it."""

from equipoise.model.reasons.reason import Code


class MassBudgetReason(Code):
    """One thing to know about mass properties from parts and swings, with its sentence."""

    PARTS_SUMMED = (
        "parts_summed",
        "{count:.0f} parts are summed; their errors are taken as independent.",
    )
    SWINGS_COMBINED = (
        "swings_combined",
        "Swings about known axes ({count:.0f}) agree with the sum; {0} deviates most, "
        "by {off:.1f} sd.",
    )
    SWINGS_CONTRADICT = (
        "swings_contradict",
        "But swings and parts contradict each other (probability {chance:.1g}): {0} "
        "deviates most, by {off:.1f} sd. A part, a period or a lever arm is wrong; do "
        "not trust the intervals.",
    )
