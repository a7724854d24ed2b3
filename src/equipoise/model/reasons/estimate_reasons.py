"""What there is to know about an estimate; ``model.outcome`` says what follows for its trust."""

from equipoise.model.reasons.reason import Code


class EstimateReason(Code):
    """One thing to know about an estimate, with its sentence."""

    # Of fits of the trajectory
    EXPLAINED_ATTITUDE = (
        "explained_attitude",
        "The model explains the record to {attitude_rms:deg .3g} deg rms per axis.",
    )
    EXPLAINED_RATE = (
        "explained_rate",
        "The model explains the record to {rate_rms:deg .3g} deg/s rms per axis.",
    )
    UNEXPLAINED_ATTITUDE = (
        "unexplained_attitude",
        "The model does not explain the record: it leaves {attitude_rms:deg .3g} deg rms per "
        "axis, {times:.2g} times the stated noise, with a lag-one correlation of {lag_one:.2f} "
        "where noise has 0. Something moves the platform that the model does not know; do not "
        "trust the intervals.",
    )
    UNEXPLAINED_RATE = (
        "unexplained_rate",
        "The model does not explain the record: it leaves {rate_rms:deg .3g} deg/s rms per axis, "
        "{times:.2g} times the stated noise, with a lag-one correlation of {lag_one:.2f} where "
        "noise has 0. Something moves the platform that the model does not know; do not trust "
        "the intervals.",
    )
    COLOURED_RESIDUAL = (
        "coloured_residual",
        "What is left is not quite noise (lag-one correlation {lag_one:.2f}, spectral peak "
        "{spectral_peak:.2g} times the mean): intervals are widened {widening:.2g} times.",
    )
    NOT_CONVERGED = "not_converged", "The fit did not settle; its numbers mean nothing."
    MOTION_NOT_FOUND = (
        "motion_not_found",
        "The fit did not find the motion: it leaves {attitude_rms:deg .2g} deg rms per axis, and "
        "its numbers mean nothing. Try a shorter part of the record, or hold what is known of the "
        "body.",
    )
    BUDGET_SPENT = (
        "budget_spent",
        "The time for the search was spent before it was done with {names}: an error that was not "
        "sought may hide in the numbers, do not trust the intervals. Give it more (--budget-s "
        "300), or a shorter part of the record.",
    )
    BUDGET_TOO_SMALL = (
        "budget_too_small",
        "The time for the search was spent before it was done with {names}, and what is left is "
        "more than noise: do not trust the numbers. Give it more (--budget-s 300), or a shorter "
        "part of the record.",
    )
    RATIOS_ONLY = (
        "ratios_only",
        "The scale is open: only ratios of inertia and centre of mass are known.",
    )
    PART_UNOBSERVABLE = (
        "part_unobservable",
        "Part of the mass properties is not observable; those intervals are infinite.",
    )
    FLAT_BODY = (
        "flat_body",
        "The best body is flat: its inertia lies at the edge of the possible, its greatest "
        "principal moment {gap:% .1g} % below the sum of the other two. Intervals know of no edge.",
    )

    # Of the model that a record supports
    EVENTS_FOUND = "events_found", "It steps over {count:.0f} events, at {names} s."
    EVENTS_AT_TRAVELS = (
        "events_at_travels",
        "Masses travel at the time of events ({names} s), so that such a travel gives no scale; "
        "check the log of the masses.",
    )
    TOO_MANY_EVENTS = "too_many_events", "So many events leave nothing to trust the numbers by."
    ATTITUDE_NOISE_OFF = (
        "attitude_noise_off",
        "The attitude noise is {found:deg .2g} deg a row, not {stated:deg .2g} as stated.",
    )
    GYRO_NOISE_OFF = (
        "gyro_noise_off",
        "The gyro noise is {found:deg .2g} deg/s a row, not {stated:deg .2g} as stated.",
    )
    TERMS_ADDED = "terms_added", "Terms that the record supports were added: {names}."
    TERMS_CARRIED = "terms_carried", "Intervals count errors of sensors that may be zero: {names}."
    RIVAL_MODELS = "rival_models", "Intervals count other models of the record, about as likely."
    TERMS_TO_DECLARE = (
        "terms_to_declare",
        "Declare under [disturbance] consider in the testbed file: {names}; then shorter records "
        "count that, too, also when balancing and holding.",
    )
    CAMERA_LEANS = (
        "camera_leans",
        "The camera's vertical leans {lean:deg .2g} deg from gravity's; that is corrected.",
    )
    GYRO_CLOCK = (
        "gyro_clock",
        "The gyro's clock is {fast:% .2g} % fast beside the camera's (slow, if negative); that is "
        "corrected.",
    )
    LAMP_RESPONSE = (
        "lamp_response",
        "The lamp warms the platform with a time constant of {found:.3g} s, not {stated:.3g} s as "
        "stated; that is corrected.",
    )
    LATE_LOG = (
        "late_log",
        "Masses travelled {late:ms .0f} ms behind their log (before it, if negative); that is "
        "corrected.",
    )
    SENSOR_IMPLAUSIBLE = (
        "sensor_implausible",
        "But errors of sensors are larger than real ones are ({names}): they may stand for another "
        "error, such as axes or an attitude read the other way; do not trust the intervals.",
    )
    TORQUE_WANDERS = (
        "torque_wanders",
        "A torque that no term explains wanders by {torque_x:uN m .2g}, {torque_y:uN m .2g}, "
        "{torque_z:uN m .2g} uN m about x, y, z within {seconds:.2g} s; intervals count it.",
    )
    LAY_ON_STOP = (
        "lay_on_stop",
        "But the platform stays at its tilt limit from {start:.4g} to {end:.4g} s, as no swing "
        "does, and no model has the pressure of a stop: do not trust the numbers. Identify a part "
        "without such a stay, the longest from {first:.4g} to {last:.4g} s (--from-s, --to-s).",
    )
    UNKNOWN_TORQUE = (
        "unknown_torque",
        "That torque is {share:.2g} times what gravity does: something drives the platform that "
        "the model does not know, do not trust the numbers.",
    )
    INPUT_LIMITS = "input_limits", "How well the input '{0}' is known limits {rest}."
    OUTLIERS_REMOVED = "outliers_removed", "{rows:.0f} outlying rows are left out."
    RATES_UNRESOLVED = (
        "rates_unresolved",
        "{rows:.0f} gyro rows are left out: masses travelled between the rows of their track.",
    )

    # Of several recordings of one platform
    FITTED_JOINTLY = (
        "fitted_jointly",
        "{count:.0f} runs are fitted jointly: inertia and centre of mass are common to all; "
        "starts, biases and moves are each run's own.",
    )
    RUNS_SCATTERED = (
        "runs_scattered",
        "The runs scatter more than their intervals allow: intervals are widened {widening:.2g} "
        "times.",
    )
    RUNS_DISAGREE = (
        "runs_disagree",
        "The runs disagree, by {widening:.2g} times what their intervals allow: the platform or "
        "the bench was not the same in all of them. There is no joint estimate; their means and "
        "scatter stand by themselves.",
    )
    RUNS_LEFT_OUT = "runs_left_out", "Left out, as not usable by themselves: {names}."
    TOO_FEW_RUNS = (
        "too_few_runs",
        "{usable:.0f} of {count:.0f} runs can be used by itself; a joint fit needs two.",
    )
    CROSS_CHECKS_DISAGREE = (
        "cross_checks_disagree",
        "But cross-checks at the same inertia disagree by up to {off:.0f} sd ({names}): one of "
        "them is wrong, do not trust the numbers.",
    )

    # Of a centre of mass that drifts
    DRIFTS = (
        "drifts",
        "The centre of mass drifts: from start to end it moves by {way_x:um .2g}, {way_y:um "
        ".2g}, {way_z:um .2g} um (sd {sd_x:um .2g}, {sd_y:um .2g}, {sd_z:um .2g}). com is that "
        "of the start, com_end that of the end.",
    )
    NO_DRIFT = (
        "no_drift",
        "No drift of the centre of mass is observed: from start to end it moves by {way_x:um "
        ".2g}, {way_y:um .2g}, {way_z:um .2g} um (sd {sd_x:um .2g}, {sd_y:um .2g}, {sd_z:um "
        ".2g}).",
    )
    DRIFT_UNOBSERVABLE = (
        "drift_unobservable",
        "Not all of the centre of mass is observable, nor how much it drifts.",
    )

    # Of linear methods
    LINEAR = "linear", "A linear estimate."
    LINEAR_RATIOS = "linear_ratios", "The scale is open: only ratios are known."
    LONGEST_PIECE_ONLY = (
        "longest_piece_only",
        "Note: behind a gap a gyro alone does not know the attitude: only the longest piece is "
        "used.",
    )
    IMPOSSIBLE_INERTIA = "impossible_inertia", "No body can have the inertia found."
    REGRESSOR_NOISE_TOO_LARGE = (
        "regressor_noise_too_large",
        "Noise in the regressor takes some {share:% .0f} % of a moment of inertia away: do not "
        "trust the intervals.",
    )
    RESIDUAL_TOO_LARGE = (
        "residual_too_large",
        "The rows leave much more than the sensors' noise: something moves the platform that the "
        "model does not know; do not trust the intervals.",
    )
    RESIDUAL_LARGE = (
        "residual_large",
        "The rows leave more than the sensors' noise, {power:.2g} times its power where it is "
        "most: intervals are widened {widening:.2g} times.",
    )
    BIAS_BY_NOISE = (
        "bias_by_noise",
        "Noise in the regressor moves {0} by about {sds:.2g} sd: the intervals are widened by "
        "it, but are not trustworthy; use momentum_corrected, or trajectory.",
    )
    BIAS_BY_SMOOTHING = (
        "bias_by_smoothing",
        "Smoothing the camera's rows blurs quick motion and moves {0} by about {sds:.2g} sd: the "
        "intervals are widened by it, but are not trustworthy; a gyro would show it.",
    )
    BIAS_BY_MODEL = (
        "bias_by_model",
        "What the model leaves out moves {0} by about {sds:.2g} sd: the intervals are widened by "
        "it, but are not trustworthy.",
    )

    # Of filters and the tracker
    FILTERED = (
        "filtered",
        "Filtered to the last row; innovations are {innovation:.2g} times what they should be.",
    )
    FILTER_INNOVATIONS_TOO_LARGE = (
        "filter_innovations_too_large",
        "Filtered to the last row; innovations are {innovation:.2g} times what they should be: "
        "inertia, noise or model are wrong, do not trust it.",
    )
    FILTER_DIVERGED = "filter_diverged", "No body can have the inertia found: the filter diverged."
    GYROSCOPIC_TORQUE_LEFT_OUT = (
        "gyroscopic_torque_left_out",
        "The gyroscopic torque and products of inertia that the simplified model leaves out move "
        "com by some {com:um .2g} um (|w|^2 dJ / m g: {rule:um .2g} um), more than all else. The "
        "interval is as wide as that: a bound, not trustworthy as one of 95 %. Take another "
        "filter.",
    )
    TRACKED = (
        "tracked",
        "Tracked to the last row; innovations are {innovation:.2g} times what they should be.",
    )
    TRACKER_INNOVATIONS_TOO_LARGE = (
        "tracker_innovations_too_large",
        "Tracked to the last row; innovations are {innovation:.2g} times what they should be: "
        "inertia, noise or model are wrong, do not trust the interval.",
    )
    ROWS_REJECTED = "rows_rejected", "{rows:.0f} outlying rows were not used."
    TOO_MANY_ROWS_REJECTED = (
        "too_many_rows_rejected",
        "{rows:.0f} outlying rows were not used: inertia, noise or model are wrong, do not "
        "trust the interval.",
    )

    # Of rest positions
    FROM_RESTS = (
        "from_rests",
        "The centre of mass from {rests:.0f} rest positions; the inertia is not estimated.",
    )
    SWINGS_AT_REST = (
        "swings_at_rest",
        "But the platform swung by {swing:deg .2g} deg rms at a stop, where it should rest: the "
        "intervals are not trustworthy.",
    )
    RESTS_DISAGREE = (
        "rests_disagree",
        "But the rests do not agree with one another: the intervals are not trustworthy.",
    )
    TOO_FEW_RESTS = (
        "too_few_rests",
        "{rests:.0f} distinct rest positions found, two are needed: move a mass sideways and let "
        "the platform settle.",
    )
    RESTS_TOO_ROUGH = (
        "rests_too_rough",
        "The platform swung by {swing:deg .2g} deg rms at a stop, which shows where it would "
        "rest to {sd:deg .2g} deg only: too roughly to show the distance of the centre of mass "
        "from the centre of rotation. Let it settle after each move, or take a method that needs "
        "no rest.",
    )

    # Of a calibration
    GYRO_MIRRORED = (
        "gyro_mirrored",
        "The gyro's axes are a mirror image of the body's: one has the wrong sign.",
    )
    NO_MASS_MOVES = (
        "no_mass_moves",
        "No mass moves in this record: there is nothing to calibrate masses by.",
    )

    # Of a method that cannot begin
    TOO_FEW_ROWS = "too_few_rows", "Only {rows:.0f} rows: nothing can be estimated."
    TOO_FEW_ROWS_WITHOUT_GAP = (
        "too_few_rows_without_gap",
        "Only {rows:.0f} rows without a gap: there is nothing to fit.",
    )
    TOO_FEW_ROWS_FOR_FILTER = (
        "too_few_rows_for_filter",
        "Fewer than {least:.0f} rows without gaps: too few for a filter.",
    )
    HARDLY_MOVED = (
        "hardly_moved",
        "The rows do not determine the unknowns: the platform hardly moved.",
    )
    NO_CAMERA = "no_camera", "It needs a camera, in the record and in the testbed."
    NO_ATTITUDE = "no_attitude", "The tracker needs a camera: the record has no attitude."
    NO_GYRO = "no_gyro", "It needs a gyro, in the record and in the testbed."
    NO_KNOWN_INPUT = (
        "no_known_input",
        "It needs a known torque, stored momentum or move that changes: free motion shows "
        "inertia and centre of mass by their ratio only.",
    )
    INERTIA_TOO_UNCERTAIN = (
        "inertia_too_uncertain",
        "The inertia is known too badly: unscented points would have a negative one.",
    )
