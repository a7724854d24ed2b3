"""What there is to know about an estimate of a platform that is not rigid."""

from equipoise.model.reasons.reason import Code


class ModeReason(Code):
    """One thing to know about such an estimate, with its sentence."""

    MODE_FOUND = (
        "mode_found",
        "A mode is included: {frequency:.4g} Hz, damping {damping:.2g}; it adds {strength:.0f} to "
        "chi-square.",
    )
    MASS_HANGS = (
        "mass_hangs",
        "A mass that hangs or bends: com moves {sag:um .3g} um per rad of tilt, heading "
        "{heading:deg .3g} deg; spring share {spring:.2f} (0 hangs, 1 bends).",
    )
    SAG_MAY_HANG = (
        "sag_may_hang",
        "A part that sags may hang instead: com along the vertical may then be off by "
        "{height:um .2g} um, and other intervals too narrow.",
    )
    MASS_SWINGS = (
        "mass_swings",
        "A mode and sag together: a mass swings or sloshes. Do not trust the intervals.",
    )
