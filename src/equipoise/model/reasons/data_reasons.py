"""What data do not show, what a model leaves open, and why a motion may be another."""

from equipoise.model.reasons.reason import Code


class Unobservable(Code):
    """A direction that the data do not show."""

    SCALE = (
        "scale",
        "the data do not show the common scale of inertia and centre of mass: motion without a "
        "known move or stored momentum shows ratios only; move a mass, or hold one value that is "
        "known",
    )
    SCALE_OF_MOMENT = (
        "scale_of_moment",
        "the data do not show the common scale of inertia and first moment",
    )
    PARAMETER = "parameter", "the data do not show {0}"
    COMBINATION = "combination", "the data cannot separate: {names}"
    MISFIT_FLAT = (
        "misfit_flat",
        "the data do not show {0}: {sds:.2g} sd from its best value chi-square rises by {rise:.2g} "
        "only, where an interval that holds has {due:.2g}",
    )
    TILT = (
        "tilt_open",
        "the data do not show where gravity points, so nor the centre of mass; an attitude sensor "
        "does, or a longer record of larger swings",
    )
    HEADING = (
        "heading",
        "the data do not show the heading, a turn about the vertical in which {names} each have a "
        "part; where gravity points in the body they do show",
    )
    DISTANCE = (
        "distance",
        "the data do not show the distance of the centre of mass from the centre of rotation",
    )


class Unexplained(Code):
    """What a model leaves open and what that might do, or by what a scale is known."""

    TERM_WOULD_WIDEN = (
        "term_would_widen",
        "{0} is this firm only without a '{1}' term, which the record does not support: with one "
        "its sd would be {sd:{2} .2g} {2}.",
    )
    GAINS_ALIKE = (
        "gains_alike",
        "The moves do not separate the gains of {both}: masses that always move together show "
        "their sum only. Move each by itself.",
    )
    RAILS_ALIKE = (
        "rails_alike",
        "The moves do not separate the rails of {both}: masses that always move together show "
        "their sum only. Move each by itself.",
    )
    SCALE_BY_REFERENCE = (
        "scale_by_reference",
        "The common scale of gains and inertia is that of {both}: weight and steps as stated.",
    )
    SCALE_BY_DEVICES = (
        "scale_by_devices",
        "The common scale of gains and inertia is that of what devices reported.",
    )
    SCALE_BY_INERTIA = (
        "scale_by_inertia",
        "The common scale of gains and inertia is that of the stated inertia.",
    )
    SCALE_BY_STATEMENTS = (
        "scale_by_statements",
        "The common scale of gains and inertia is known to {sd:% .2g} % only: it rests on each "
        "stated weight and step being right to {stated:% .0f} %. Ratios of gains, rails and "
        "sensors do not depend on it, and no balance does; name a mass that you weighed and "
        "measured as reference to fix it.",
    )
    STOPS_SCATTER = (
        "stops_scatter",
        "Stops of {0} scatter by {found:mm .2g} mm, stated are {stated:mm .2g}: state accuracy_mm "
        "so and calibrate again.",
    )


class Caution(Code):
    """Why the motion that a fit followed may not be the recording's."""

    DAMPING_ADDED = (
        "damping_added",
        "Damping is estimated too: without it the motion cannot be followed.",
    )
    NOT_CONVERGED = (
        "motion_not_converged",
        "The fit did not settle: bounds and ranks are those of the motion where it stopped, which "
        "need not be the recording's.",
    )
    UNEXPLAINED = (
        "motion_unexplained",
        "The plain model does not explain the record: it leaves {times:.2g} times the stated "
        "noise. Bounds hold for noise as stated, and if nothing else moves the platform; an "
        "estimate will be wider.",
    )


class RecordCaution(Code):
    """What is to be known of a record that a design counts on."""

    COM_UNOBSERVABLE = (
        "com_unobservable",
        "The record does not show the centre of mass; it stays as uncertain as it was.",
    )
    SWINGS_BEYOND_LIMIT = (
        "swings_beyond_limit",
        "A free swing would tilt the platform by {tilt:deg .0f} deg, beyond its limit of "
        "{limit:deg .0f} deg; bounds are those of a bearing without one.",
    )
    MOVE_SHORTENED = (
        "move_shortened",
        "The first record's move is shortened to {length:mm .3g} mm, for time and tilt limit; a "
        "longer one would show more.",
    )
