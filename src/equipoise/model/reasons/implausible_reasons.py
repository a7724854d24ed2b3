"""Why an estimate is none of the platform that was recorded, however well it fits the rows."""

from equipoise.model.reasons.reason import Code


class ImplausibleReason(Code):
    """One thing that no platform can have, with its sentence."""

    INERTIA_OF_NO_BODY = (
        "inertia_of_no_body",
        "But a platform of {mass:.3g} kg with the estimated inertia would have a radius "
        "of gyration of {radius:.2g} m (sd {sd:.1g} m), where {low:.2g} to {high:.2g} m "
        "are possible. Check platform.mass_kg, the unit of the time, and what is stated "
        "of the masses; do not trust the numbers.",
    )
    SWINGS_WITH_COM_ABOVE = (
        "swings_with_com_above",
        "But the estimated centre of mass is above the pivot ({sds:.2g} sd), where a platform "
        "tips over within about {seconds:.2g} s. From {start:.4g} to {end:.4g} s it swings "
        "through level {count:.0f} times. Check the attitude's direction, the vertical axes of "
        "laboratory and body, and platform.mass_kg; do not trust the numbers.",
    )
