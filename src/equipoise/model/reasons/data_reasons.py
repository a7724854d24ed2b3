"""What data do not show, what a model leaves open, and why a motion may be another."""

from equipoise.model.reasons.reason import Code


class Unobservable(Code):
    """A direction that the data do not show."""

    SCALE = (
        "scale",
        "the data determine inertia and centre of mass up to a common scale, since motion shows "
        "ratios only; move a mass, store momentum, or hold a value",
    )
    SCALE_OF_MOMENT = (
        "scale_of_moment",
        "the data do not determine the common scale of inertia and first moment",
    )
    PARAMETER = "parameter", "the data do not determine {0}"
    COMBINATION = "combination", "the data cannot separate: {names}"
    MISFIT_FLAT = (
        "misfit_flat",
        "the data do not determine {0}: at {sds:.2g} sd from the optimum, chi-square "
        "rises by {rise:.2g} only; a valid interval requires {due:.2g}",
    )
    TILT = (
        "tilt_open",
        "the data do not determine the direction of gravity, hence not the centre of mass; add "
        "an attitude sensor, or record larger swings",
    )
    HEADING = (
        "heading",
        "the data do not determine the heading, which affects each of {names}; the direction of "
        "gravity in the body is determined",
    )
    DISTANCE = (
        "distance",
        "the data do not determine the distance of the centre of mass from the centre of rotation",
    )


class Unexplained(Code):
    """What a model leaves open and what that might do, or by what a scale is known."""

    TERM_WOULD_WIDEN = (
        "term_would_widen",
        "{0} depends on the model: adding a '{1}' term, which the data do not require, "
        "would raise its standard deviation to {sd:{2} .2g} {2}.",
    )
    GAINS_ALIKE = (
        "gains_alike",
        "The moves do not separate the gains of {both}: masses that always move "
        "together determine only their sum. Move each one individually.",
    )
    RAILS_ALIKE = (
        "rails_alike",
        "The moves do not separate the rails of {both}: masses that always move "
        "together determine only their sum. Move each one individually.",
    )
    SCALE_BY_REFERENCE = (
        "scale_by_reference",
        "The common scale of gains and inertia is fixed by {both}: weight and steps as stated.",
    )
    SCALE_BY_DEVICES = (
        "scale_by_devices",
        "The common scale of gains and inertia is fixed by what devices reported.",
    )
    SCALE_BY_INERTIA = (
        "scale_by_inertia",
        "The common scale of gains and inertia is fixed by the stated inertia.",
    )
    SCALE_BY_STATEMENTS = (
        "scale_by_statements",
        "The common scale of gains and inertia is known to {sd:% .2g} % only: it "
        "assumes that stated weights and steps are correct to {stated:% .0f} %. Ratios "
        "of gains, rails and sensors do not depend on it, and neither does balancing. "
        "To fix it, name a mass that you weighed and measured (--reference).",
    )
    STOPS_SCATTER = (
        "stops_scatter",
        "Stops of {0} scatter by {found:mm .2g} mm; stated are {stated:mm .2g}. Set "
        "accuracy_mm accordingly and calibrate again.",
    )


class Caution(Code):
    """Why the motion that a fit followed may not be the recording's."""

    DAMPING_ADDED = (
        "damping_added",
        "Damping is estimated too: without it the fit cannot follow the motion.",
    )
    NOT_CONVERGED = (
        "motion_not_converged",
        "The fit did not converge: bounds and ranks are those of the motion where it "
        "stopped, which may differ from the recording's.",
    )
    UNEXPLAINED = (
        "motion_unexplained",
        "The plain model does not explain the record: residuals are {times:.2g} times "
        "the stated noise. Bounds assume the stated noise and no other torque; an "
        "estimate will be wider.",
    )


class RecordCaution(Code):
    """What is to be known of a record that a design counts on."""

    COM_UNOBSERVABLE = (
        "com_unobservable",
        "The record does not determine the centre of mass; it remains as uncertain as before.",
    )
    SWINGS_BEYOND_LIMIT = (
        "swings_beyond_limit",
        "A free swing would tilt the platform by {tilt:deg .0f} deg, beyond its limit "
        "of {limit:deg .0f} deg; bounds assume a bearing without a stop.",
    )
    MOVE_SHORTENED = (
        "move_shortened",
        "The first record's move is shortened to {length:mm .3g} mm because of time and "
        "tilt limit; a longer one would be more informative.",
    )
