"""What a recording holds, what the platform did in it, and what is wrong with it."""

from equipoise.model.reasons.reason import Code


class FindingReason(Code):
    """One thing that a recording shows, with its sentence."""

    # Channels
    CHANNEL = "channel", "{0}: {rows:.0f} rows from {first:.6g} to {last:.6g} s, {rate:.4g} Hz."
    CHANNEL_OF_PARTS = (
        "channel_of_parts",
        "{0} of {rest}: {rows:.0f} rows from {first:.6g} to {last:.6g} s, {rate:.4g} Hz.",
    )
    SINGLE_ROW = "single_row", "{0}: 1 row, at {first:.6g} s."
    NOT_RECORDED = "not_recorded", "No {0} was recorded."
    GAP = "gap", "{0}: gap of {gap:.3g} s at {t:.6g} s."
    MORE_GAPS = "more_gaps", "{0}: {count:.0f} further, shorter gaps."
    UNEVEN_INTERVALS = (
        "uneven_intervals",
        "{0}: sample intervals vary by {scatter:.2g} s around {interval:.3g} s.",
    )
    NOT_IN_TESTBED = "not_in_testbed", "{0} {1} is not in the testbed; {2}"
    LAMP_NOT_COUNTED = (
        "lamp_not_counted",
        "the lamp is switched, but the testbed file has no [lamp]: its heat is not modelled.",
    )
    INERTIA_PROJECTED = (
        "inertia_projected",
        "the testbed's inertia is physically inconsistent: its greatest principal "
        "moment, {greatest:.4g} kg m2, is {sds:.2g} sd above the sum of the other two, "
        "{others:.4g} kg m2. The nearest consistent inertia is used.",
    )
    SET_RIGHT = "set_right", "{0}"  # by reading the file, which says what it was

    ROWS_UNUSED = (
        "rows_unused",
        "{0}: {rows:.0f} rows are not used, because the testbed has no {1}.",
    )
    FIELD_CHANGED = (
        "field_changed",
        "{0}: {rows:.0f} rows are not used, because the cage changed its field. Use a "
        "part with a constant field (--from-s, --to-s).",
    )
    INPUT_UNREAD = (
        "input_unread",
        "the column '{0}' ranges from {low:.4g} to {high:.4g}, and nothing reads it: if "
        "it acts on the platform, the motion is not free.",
    )
    MORE_INPUTS_UNREAD = (
        "more_inputs_unread",
        "{count:.0f} further columns of this kind ({0}) change.",
    )
    READ_DEVICE = "read_device", "In a column map: {0}; in the testbed: {1}."
    READ_TRIAD = "read_triad", "In a column map: [{0}], three columns in body axes."
    READ_REPORTS = (
        "read_reports",
        "Commands are not what acts on the platform: read what its devices report "
        "([[device]], [[mass]]), or use a part without commands (--from-s, --to-s).",
    )

    # Masses and motion
    NO_POSITIONS = "no_positions", "No mass positions were recorded: the scale remains open."
    NO_MASS_MOVED = "no_mass_moved", "No mass moved: the scale remains open."
    MASSES_STAND = "masses_stand", "No mass moved."
    MASS_MOVES = (
        "mass_moves",
        "mass {0} moves from {start:mm .4g} to {end:mm .4g} mm between {t_start:.6g} and "
        "{t_end:.6g} s.",
    )
    MASS_FLICKERS = (
        "mass_flickers",
        "mass {0} is logged one step away and back within a second, {count:.0f} times. Its "
        "position lies between two steps of the log; it is treated as stationary.",
    )
    MORE_MOVES = "more_moves", "{count:.0f} further moves of masses."
    TILT_RANGE = "tilt_range", "tilt: {low:deg .3g} to {high:deg .3g} deg."
    TILT_RANGE_OF_AXIS = (
        "tilt_range_of_axis",
        "tilt of body axis {0}, the one nearest to vertical: {low:deg .3g} to {high:deg .3g} deg.",
    )
    GRAVITY_NOT_DOWN = (
        "gravity_not_down",
        "gravity does not point down: the median tilt is {tilt:deg .0f} deg; body axis "
        "{0} is nearest to vertical. Is the laboratory's Z axis up?",
    )
    MEETS_STOP = (
        "meets_stop",
        "the platform reaches its tilt limit of {limit:deg .3g} deg at {t:.4g} s: no "
        "estimate models the impact.",
    )
    LIES_ON_STOP = (
        "lies_on_stop",
        "the platform rests at its tilt limit of {limit:deg .3g} deg from {start:.4g} "
        "to {end:.4g} s: no estimate models the contact force.",
    )
    MORE_TOUCHES = "more_touches", "{count:.0f} further contacts with the stop."
    SPIN = (
        "spin",
        "spin about the vertical: {first:deg .4g} deg/s at the start, {last:deg .4g} "
        "deg/s at the end (measurable at this rate: up to {limit:deg .4g} deg/s).",
    )

    # Attitude rows
    ATTITUDE_NOISE = (
        "attitude_noise",
        "attitude noise: {noise:deg .2g} deg per axis at most, white part.",
    )
    ROWS_AVERAGED = (
        "rows_averaged",
        "each attitude row is an average over {window:.3g} s (sd {sd:.1g} s): its "
        "quaternion is {shortness:.2g} short. Treated as instantaneous, the rows bias "
        "inertia by about {damping:.1%}.",
    )
    OTHER_WINDOW = (
        "other_window",
        "the testbed states averaging_s = {stated:.3g} for the attitude; the record shows "
        "{window:.3g} s.",
    )
    UNSTEADY_WINDOW = (
        "unsteady_window",
        "the lengths of the quaternions do not follow the rate: rows may be averages "
        "over different windows.",
    )
    ROW_NOT_A_MEAN = (
        "row_not_a_mean",
        "row {row:.0f} at {t:.6g} s is not averaged like the others: its quaternion has "
        "the length {length:.6f}, theirs {theirs:.6f}.",
    )
    MORE_ROWS_NOT_MEANS = (
        "more_rows_not_means",
        "{count:.0f} further rows are not averaged like the others.",
    )

    # Gyro rows
    GYRO_NOISE = "gyro_noise", "gyro noise: {noise:deg .2g} deg/s per axis at most, white part."
    DEAD_AXIS = "dead_axis", "gyro {0} is {rate:deg .3g} deg/s in every row."
    ZERO_START = (
        "zero_start",
        "rates start at exactly zero: they look like backward differences, not like gyro data.",
    )
    QUANTISED = "quantised", "gyro {0} is quantised to {step:deg .3g} deg/s."

    # Rows of either
    OUTLYING_ROW = (
        "outlying_row",
        "{0}: row {row:.0f} at {t:.6g} s is {off:deg .2g} {1} off the motion of its "
        "neighbours (their scatter: {scatter:deg .2g} {1} per axis).",
    )
    MORE_OUTLYING_ROWS = "more_outlying_rows", "{0}: {count:.0f} further outliers."
    OUTLYING_VECTORS = "outlying_vectors", "{0}: {count:.0f} outliers."
    REPEATED_ROW = (
        "repeated_row",
        "{0}: row {first:.0f} repeats the one before, from {start:.6g} to {end:.6g} s.",
    )
    REPEATED_ROWS = (
        "repeated_rows",
        "{0}: rows {first:.0f} to {last:.0f} repeat the one before, from {start:.6g} to "
        "{end:.6g} s.",
    )
    MORE_REPEATED_ROWS = "more_repeated_rows", "{0}: {count:.0f} further repeats of rows."
    NOISE_ASSUMED = (
        "noise_assumed",
        "the testbed has no sensor.{0}: its noise is assumed to be {noise:deg .2g} {1} per sample.",
    )

    # Gyro and attitude together
    NO_OVERLAP = "no_overlap", "gyro and attitude hardly overlap in time."
    RATES_DERIVED = (
        "rates_derived",
        "the rates are differences of the attitude to the last digit: not an independent sensor.",
    )
    ATTITUDE_INVERSE = (
        "attitude_inverse",
        "gyro and attitude rotate in opposite directions: the attitude transforms "
        "laboratory to body components.",
    )
    ATTITUDE_REVERSED = (
        "attitude_reversed",
        "the motion is that of a platform if the attitude transforms laboratory to body "
        "components (chi-square is {excess:.3g} lower), not as it is read.",
    )
    READ_INVERSE = "read_inverse", 'In a column map, attitude: turns = "laboratory to body".'
    GYRO_AXES = "gyro_axes", "the body's x, y, z correspond to the gyro's {names}."
    READ_AXES = "read_axes", "In a column map, rate: axes = [{names}]."
    OTHER_UNIT = "other_unit", "the gyro reads {scale:.3g} times the rate of the attitude."
    READ_UNIT = "read_unit", "In a column map, rate: its unit, or a factor."
    NO_RELATION = (
        "no_relation",
        "no order, sign or direction of axes reconciles gyro and attitude: "
        "{unexplained:% .0f} % of the rate remains unexplained.",
    )
    OTHER_SCALE = "other_scale", "gyro {0} reads {scale:.3g} times the rate of the attitude."
    SENSORS_AGREE = "sensors_agree", "gyro and attitude agree about {names}."
    TOO_LITTLE_MOTION = "too_little_motion", "the motion is too small to compare gyro and attitude."
    GYRO_ZERO = (
        "gyro_zero",
        "gyro bias: {zero_x:deg .3g}, {zero_y:deg .3g}, {zero_z:deg .3g} deg/s.",
    )
    ATTITUDE_LATE = (
        "attitude_late",
        "attitude time stamps lag the gyro's by {lag:ms .3g} ms (sd {sd:ms .2g} ms).",
    )
    ATTITUDE_LATE_UNSTATED = (
        "attitude_late_unstated",
        "attitude time stamps lag the gyro's by {lag:ms .3g} ms (sd {sd:ms .2g} ms); "
        "the testbed states {stated:ms .3g} ms.",
    )

    # Whether it can be
    IMPOSSIBLE_RATE = (
        "impossible_rate",
        "{0}: one row every {period:.3g} s, faster than any sensor of a platform. Is "
        "the clock in another unit?",
    )
    READ_CLOCK = "read_clock", "In a column map, time: its unit (ms, us, ns)."
    TOO_SLOW = (
        "too_slow",
        "the platform turns by {turn:deg .3g} deg between attitude samples, "
        "{interval:.3g} s: the sample rate is too low for its motion.",
    )
    SATURATED = (
        "saturated",
        "gyro {0} stays at its greatest value, {rate:deg .4g} deg/s, in {count:.0f} "
        "rows: it is saturated.",
    )
    NO_BODY = (
        "no_body",
        "the testbed's inertia does not match its mass of {mass:.3g} kg: the radius of "
        "gyration would be {radius:.2g} m, where {low:.2g} to {high:.2g} m are "
        "possible. Check the units of platform.inertia_kg_m2 and platform.mass_kg.",
    )
    COM_ABOVE = (
        "com_above",
        "the testbed's centre of mass is {height:um .3g} um above the pivot: such a "
        "platform tips over.",
    )

    # Events
    EVENTS_NOT_SOUGHT = (
        "events_not_sought",
        "contacts and shifted parts were not searched for; give a testbed for that.",
    )
    TOUCH = (
        "touch",
        "at {t:.4g} s the platform received an impulse of {size:mN m s .2g} mN m s "
        "(laboratory x, y, z: {size_x:mN m s .2g}, {size_y:mN m s .2g}, {size_z:mN m s "
        ".2g}; sd {sd:mN m s .1g}).",
    )
    PUSH = (
        "push",
        "at {t:.4g} s the platform received an impulse of {size:mN m s .2g} mN m s (laboratory "
        "x, y, z: {size_x:mN m s .2g}, {size_y:mN m s .2g}, {size_z:mN m s .2g}; sd {sd:mN m s "
        ".1g}). It is that of a push from below at the body azimuth {azimuth:deg .0f} deg, or "
        "from above on the opposite side.",
    )
    TOUCH_UNCLEAR = (
        "touch_unclear",
        "A shifted part would explain it about as well: intervals account for either.",
    )
    COM_STEP = (
        "com_step",
        "at {t:.4g} s the centre of mass moved by {size_x:um .2g}, {size_y:um .2g}, "
        "{size_z:um .2g} um (body x, y, z; sd {sd_x:um .2g}, {sd_y:um .2g}, {sd_z:um "
        ".2g}): a part shifted.",
    )
    COM_STEP_UNCLEAR = (
        "com_step_unclear",
        "A contact would explain it about as well: intervals account for either.",
    )
