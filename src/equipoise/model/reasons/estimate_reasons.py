"""What there is to know about an estimate; ``model.outcome`` says what follows for its trust."""

from equipoise.model.reasons.reason import Code


class EstimateReason(Code):
    """One thing to know about an estimate, with its sentence."""

    # Of fits of the trajectory
    EXPLAINED_ATTITUDE = (
        "explained_attitude",
        "The model explains the record: residuals are {attitude_rms:deg .3g} deg rms per axis.",
    )
    EXPLAINED_RATE = (
        "explained_rate",
        "The model explains the record: residuals are {rate_rms:deg .3g} deg/s rms per axis.",
    )
    UNEXPLAINED_ATTITUDE = (
        "unexplained_attitude",
        "The model does not explain the record. Residuals are {attitude_rms:deg .3g} deg rms per "
        "axis, {times:.2g} times the stated noise, with a lag-one autocorrelation of "
        "{lag_one:.2f} (white noise: 0). Unmodelled torques act; do not trust the intervals.",
    )
    UNEXPLAINED_RATE = (
        "unexplained_rate",
        "The model does not explain the record. Residuals are {rate_rms:deg .3g} deg/s rms per "
        "axis, {times:.2g} times the stated noise, with a lag-one autocorrelation of "
        "{lag_one:.2f} (white noise: 0). Unmodelled torques act; do not trust the intervals.",
    )
    COLOURED_RESIDUAL = (
        "coloured_residual",
        "Residuals are not white (lag-one autocorrelation {lag_one:.2f}, spectral peak "
        "{spectral_peak:.2g} times the mean): intervals are widened by a factor of "
        "{widening:.2g}.",
    )
    NOT_CONVERGED = "not_converged", "The fit did not converge; its numbers are meaningless."
    MOTION_NOT_FOUND = (
        "motion_not_found",
        "The fit did not find the motion: residuals are {attitude_rms:deg .2g} deg rms per axis, "
        "and its numbers are meaningless. Use a shorter part of the record, or hold known mass "
        "properties (--hold).",
    )
    BUDGET_SPENT = (
        "budget_spent",
        "The search time ended before {names} was complete, so an undetected error may remain: "
        "do not trust the intervals. Allow more time (--budget-s 300), or shorten the record.",
    )
    BUDGET_TOO_SMALL = (
        "budget_too_small",
        "The search time ended before {names} was complete, and residuals exceed noise: do not "
        "trust the numbers. Allow more time (--budget-s 300), or shorten the record.",
    )
    RATIOS_ONLY = (
        "ratios_only",
        "The scale is open: the record determines only ratios of inertia and centre of mass.",
    )
    PART_UNOBSERVABLE = (
        "part_unobservable",
        "Some mass properties are unobservable; their intervals are infinite.",
    )
    FLAT_BODY = (
        "flat_body",
        "The best estimate is a flat body, at the limit of physical consistency. Its greatest "
        "principal moment is {gap:% .1g} % below the sum of the other two. Intervals do not "
        "account for this limit.",
    )

    # Of the model that a record supports
    EVENTS_FOUND = "events_found", "The model includes {count:.0f} events, at {names} s."
    EVENTS_AT_TRAVELS = (
        "events_at_travels",
        "Events coincide with moves of masses ({names} s), so these moves do not fix the scale; "
        "check the log of the masses.",
    )
    TOO_MANY_EVENTS = "too_many_events", "With so many events the numbers cannot be trusted."
    ATTITUDE_NOISE_OFF = (
        "attitude_noise_off",
        "The attitude noise is {found:deg .2g} deg per sample; stated are {stated:deg .2g}.",
    )
    GYRO_NOISE_OFF = (
        "gyro_noise_off",
        "The gyro noise is {found:deg .2g} deg/s per sample; stated are {stated:deg .2g}.",
    )
    TERMS_ADDED = "terms_added", "Terms that the record supports were added: {names}."
    TERMS_CARRIED = (
        "terms_carried",
        "Intervals account for sensor errors that may be zero: {names}.",
    )
    RIVAL_MODELS = "rival_models", "Intervals account for alternative models of similar likelihood."
    TERMS_TO_DECLARE = (
        "terms_to_declare",
        "Declare {names} under [disturbance] consider in the testbed file. Shorter records, "
        "balancing and holding then account for it too.",
    )
    CAMERA_LEANS = (
        "camera_leans",
        "The camera's vertical is inclined by {lean:deg .2g} deg to gravity; this is corrected.",
    )
    GYRO_CLOCK = (
        "gyro_clock",
        "The gyro's clock is {fast:% .2g} % faster than the camera's; this is corrected.",
    )
    LAMP_RESPONSE = (
        "lamp_response",
        "The lamp heats the platform with a time constant of {found:.3g} s; stated are "
        "{stated:.3g} s. This is corrected.",
    )
    LATE_LOG = (
        "late_log",
        "Masses moved {late:ms .0f} ms after their log (before it if negative); this is corrected.",
    )
    SENSOR_IMPLAUSIBLE = (
        "sensor_implausible",
        "But the estimated sensor errors are implausibly large ({names}). They may stand for "
        "another error, such as misread axes or attitude direction; do not trust the intervals.",
    )
    TORQUE_WANDERS = (
        "torque_wanders",
        "An unexplained torque varies by {torque_x:uN m .2g}, {torque_y:uN m .2g}, {torque_z:uN "
        "m .2g} uN m about x, y, z within {seconds:.2g} s; intervals account for it.",
    )
    LAY_ON_STOP = (
        "lay_on_stop",
        "But the platform stays at its tilt limit from {start:.4g} to {end:.4g} s. No model "
        "includes the contact force of the stop: do not trust the numbers. Use a part without "
        "such a stay, the longest from {first:.4g} to {last:.4g} s (--from-s, --to-s).",
    )
    UNKNOWN_TORQUE = (
        "unknown_torque",
        "That torque is {share:.2g} times the gravity torque: an unmodelled torque drives the "
        "platform; do not trust the numbers.",
    )
    INPUT_LIMITS = "input_limits", "The uncertainty of the input '{0}' limits {rest}."
    OUTLIERS_REMOVED = "outliers_removed", "{rows:.0f} outliers were removed."
    RATES_UNRESOLVED = (
        "rates_unresolved",
        "{rows:.0f} gyro rows were excluded: masses moved between the samples of their position.",
    )

    # Of several recordings of one platform
    FITTED_JOINTLY = (
        "fitted_jointly",
        "{count:.0f} runs are fitted jointly: inertia and centre of mass are common; starts, "
        "biases and moves are individual.",
    )
    RUNS_SCATTERED = (
        "runs_scattered",
        "The runs scatter more than their intervals allow: these are widened {widening:.2g} times.",
    )
    RUNS_DISAGREE = (
        "runs_disagree",
        "The runs disagree: they scatter {widening:.2g} times as much as their intervals allow. "
        "The platform or the bench changed between them. There is no joint estimate; compare the "
        "individual means and their scatter.",
    )
    RUNS_LEFT_OUT = "runs_left_out", "Excluded, because not usable individually: {names}."
    TOO_FEW_RUNS = (
        "too_few_runs",
        "Only {usable:.0f} of {count:.0f} runs are usable individually; a joint fit needs two.",
    )
    CROSS_CHECKS_DISAGREE = (
        "cross_checks_disagree",
        "But cross-checks at the same inertia disagree by up to {off:.0f} sd ({names}): one of "
        "them is wrong; do not trust the numbers.",
    )

    # Of a centre of mass that drifts
    DRIFTS = (
        "drifts",
        "The centre of mass drifts by {way_x:um .2g}, {way_y:um .2g}, {way_z:um .2g} um over the "
        "record (sd {sd_x:um .2g}, {sd_y:um .2g}, {sd_z:um .2g}). com is its value at the start, "
        "com_end at the end.",
    )
    NO_DRIFT = (
        "no_drift",
        "No significant drift of the centre of mass: {way_x:um .2g}, {way_y:um .2g}, {way_z:um "
        ".2g} um over the record (sd {sd_x:um .2g}, {sd_y:um .2g}, {sd_z:um .2g}).",
    )
    DRIFT_UNOBSERVABLE = (
        "drift_unobservable",
        "The centre of mass and its drift are only partly observable.",
    )

    # Of linear methods
    LINEAR = "linear", "A linear estimate."
    LINEAR_RATIOS = "linear_ratios", "The scale is open: only ratios are determined."
    LONGEST_PIECE_ONLY = (
        "longest_piece_only",
        "Note: with a gyro alone the attitude is unknown after a gap; only the longest "
        "continuous part is used.",
    )
    IMPOSSIBLE_INERTIA = (
        "impossible_inertia",
        "The estimated inertia is physically inconsistent: no body can have it.",
    )
    REGRESSOR_NOISE_TOO_LARGE = (
        "regressor_noise_too_large",
        "Noise in the regressor reduces a moment of inertia by about {share:% .0f} %: do not "
        "trust the intervals.",
    )
    RESIDUAL_TOO_LARGE = (
        "residual_too_large",
        "Residual power is much larger than sensor noise: unmodelled torques act on the "
        "platform; do not trust the intervals.",
    )
    RESIDUAL_LARGE = (
        "residual_large",
        "Residual power exceeds sensor noise by up to {power:.2g}x: intervals are widened by a "
        "factor of {widening:.2g}.",
    )
    BIAS_BY_NOISE = (
        "bias_by_noise",
        "Noise in the regressor biases {0} by about {sds:.2g} sd. Intervals are widened "
        "accordingly, but are not trustworthy; use momentum_corrected or trajectory.",
    )
    BIAS_BY_SMOOTHING = (
        "bias_by_smoothing",
        "Smoothing of the camera data attenuates fast motion and biases {0} by about {sds:.2g} "
        "sd. Intervals are widened accordingly, but are not trustworthy; use a gyro.",
    )
    BIAS_BY_MODEL = (
        "bias_by_model",
        "Neglected terms bias {0} by about {sds:.2g} sd. Intervals are widened accordingly, but "
        "are not trustworthy.",
    )

    # Of filters and the tracker
    FILTERED = (
        "filtered",
        "Filtered to the last row; innovations are {innovation:.2g} times their predicted size.",
    )
    FILTER_INNOVATIONS_TOO_LARGE = (
        "filter_innovations_too_large",
        "Filtered to the last row; innovations are {innovation:.2g} times their predicted size: "
        "inertia, noise or model are wrong; do not trust the estimate.",
    )
    FILTER_DIVERGED = (
        "filter_diverged",
        "The filter diverged: no body can have the estimated inertia.",
    )
    GYROSCOPIC_TORQUE_LEFT_OUT = (
        "gyroscopic_torque_left_out",
        "The simplified model neglects the gyroscopic torque and products of inertia. This "
        "biases com by about {com:um .2g} um (|w|^2 dJ / m g: {rule:um .2g} um), more than all "
        "other errors. The interval is as wide as that bound and not trustworthy as one of 95 %. "
        "Use another filter.",
    )
    TRACKED = (
        "tracked",
        "Tracked to the last row; innovations are {innovation:.2g} times their predicted size.",
    )
    TRACKER_INNOVATIONS_TOO_LARGE = (
        "tracker_innovations_too_large",
        "Tracked to the last row; innovations are {innovation:.2g} times their predicted size: "
        "inertia, noise or model are wrong; do not trust the interval.",
    )
    ROWS_REJECTED = "rows_rejected", "{rows:.0f} outliers were rejected."
    TOO_MANY_ROWS_REJECTED = (
        "too_many_rows_rejected",
        "{rows:.0f} outliers were rejected: wrong inertia or noise; do not trust the interval.",
    )

    # Of rest positions
    FROM_RESTS = (
        "from_rests",
        "The centre of mass follows from {rests:.0f} equilibria; the inertia is not estimated.",
    )
    SWINGS_AT_REST = (
        "swings_at_rest",
        "But the platform swung by {swing:deg .2g} deg rms at an equilibrium where it should "
        "rest: the intervals are not trustworthy.",
    )
    RESTS_DISAGREE = (
        "rests_disagree",
        "But the equilibrium positions are inconsistent: the intervals are not trustworthy.",
    )
    TOO_FEW_RESTS = (
        "too_few_rests",
        "{rests:.0f} distinct equilibrium positions found, two are needed: move a mass sideways "
        "and let the platform settle.",
    )
    RESTS_TOO_ROUGH = (
        "rests_too_rough",
        "The platform swung by {swing:deg .2g} deg rms at an equilibrium, which is therefore "
        "known to {sd:deg .2g} deg only. This does not determine the distance of the centre of "
        "mass from P. Let it settle after each move, or use a method that needs no rest.",
    )

    # Of a calibration
    GYRO_MIRRORED = (
        "gyro_mirrored",
        "The gyro's axes are a mirror image of the body's: one has the wrong sign.",
    )
    NO_MASS_MOVES = (
        "no_mass_moves",
        "No mass moves in this record: there is nothing to calibrate masses with.",
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
    HARDLY_MOVED = "hardly_moved", "The platform moved too little to determine the unknowns."
    NO_CAMERA = "no_camera", "The method needs a camera, in the record and in the testbed."
    NO_ATTITUDE = "no_attitude", "The tracker needs an attitude sensor: the record has no attitude."
    NO_GYRO = "no_gyro", "The method needs a gyro, in the record and in the testbed."
    NO_KNOWN_INPUT = (
        "no_known_input",
        "The method needs a known torque, stored momentum or move that changes: free motion "
        "determines only the ratio of inertia and centre of mass.",
    )
    INERTIA_TOO_UNCERTAIN = (
        "inertia_too_uncertain",
        "The inertia is too uncertain: some sigma points would have a negative inertia.",
    )
