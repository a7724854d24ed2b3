"""What a step of a procedure did, and why a procedure went on or ended."""

from equipoise.model.reasons.reason import Code

LEAVES = (
    "{travel:mm .0f} mm in {duration:.1f} s; should leave ({com_x:um .1f}, {com_y:um .1f}, "
    "{com_z:um .1f}) um."
)
PAIRS = (
    "({com_x:um .1f} +/- {sd_x:um .1f}, {com_y:um .1f} +/- {sd_y:um .1f}, {com_z:um .1f} +/- "
    "{sd_z:um .1f}) um"
)


class MoveReason(Code):
    """Why masses are moved, with what the move should leave."""

    TO_TARGET = "to_target", f"Move (to target): {LEAVES}"
    BELOW_FIRST = (
        "below_first",
        f"Move (below the target first: stiffer, and more informative): {LEAVES}",
    )
    BRAKE = "brake", f"Move (brake: the platform tips faster than it can be caught): {LEAVES}"
    DRIFT = (
        "drift",
        "Drifted to ({was_x:um .1f}, {was_y:um .1f}, {was_z:um .1f}) um; moved masses by "
        "{travel:mm .0f} mm in all.",
    )


class StepReason(Code):
    """One thing to know about a step, with its sentence."""

    # Records and what they show
    OBSERVED = "observed", "Observed for {duration:.1f} s."
    RECORDING_READ = "recording_read", "Read {duration:.4g} s of recording."
    PLAN_CARRIED_OUT = "plan_carried_out", "Carried out the planned manoeuvre of {duration:g} s."
    ESTIMATED_BY = "estimated_by", "{0}:"  # the estimate's own reasons follow
    RUN_ESTIMATED = "run_estimated", "{0}:"  # the estimate's own reasons follow
    COM_AT = (
        "com_at",
        "The centre of mass is at ({com_x:um .2f} +/- {sd_x:um .2f}, {com_y:um .2f} +/- "
        "{sd_y:um .2f}, {com_z:um .2f} +/- {sd_z:um .2f}) um.",
    )
    COM_DRIFTS = (
        "com_drifts",
        "It drifts by ({of_x:um/min .2f} +/- {sd_x:um/min .2f}, {of_y:um/min .2f} +/- "
        "{sd_y:um/min .2f}, {of_z:um/min .2f} +/- {sd_z:um/min .2f}) um/min.",
    )
    COM_WARMS = (
        "com_warms",
        "A kelvin moves it by ({of_x:um .2f} +/- {sd_x:um .2f}, {of_y:um .2f} +/- "
        "{sd_y:um .2f}, {of_z:um .2f} +/- {sd_z:um .2f}) um.",
    )
    COM_SAGS = (
        "com_sags",
        "Elastic sag: xx {of_xx:um .1f} +/- {sd_xx:um .1f}, yy {of_yy:um .1f} +/- {sd_yy:um .1f}, "
        "xy {of_xy:um .1f} +/- {sd_xy:um .1f}, xz {of_xz:um .1f} +/- {sd_xz:um .1f}, "
        "yz {of_yz:um .1f} +/- {sd_yz:um .1f} um.",
    )
    COM_BY_HAND = "com_by_hand", f"Centre of mass at {PAIRS}."
    COM_ASTRAY = (
        "com_astray",
        f"Centre of mass at {PAIRS}; that is not where the weights should have left it: "
        "check those placed last.",
    )

    # Weights that a person places
    WEIGHTS_TO_MOVE = "weights_to_move", "Move {names}."
    WEIGHTS_TO_TAKE_OFF = "weights_to_take_off", "Remove {names}."
    WEIGHTS_TO_PUT_ON = "weights_to_put_on", "Add {names}."
    PLACING_LEAVES = "placing_leaves", f"That should leave {PAIRS}."
    NOTHING_TO_PLACE = (
        "nothing_to_place",
        f"Nothing to place: should leave {PAIRS}. Release once more.",
    )
    TARGET_OUT_OF_REACH = (
        "target_out_of_reach",
        "Stock and places do not reach the target along {names}.",
    )
    HANDS_FIRST = (
        "hands_first",
        "Weights first, to within ({within_x:um .0f}, {within_y:um .0f}, {within_z:um "
        ".0f}) um of the target; the sliding masses can correct that much.",
    )
    MASSES_GO_ON = "masses_go_on", "The sliding masses can correct the rest."
    WEIGHTS_LIE = "weights_lie", "{weights:.0f} weights lie on {places:.0f} places."

    # When masses may move during an experiment
    EXPERIMENT_HOLDS = "experiment_holds", "The experiment requests that masses stand still."
    QUIET_TIME = "quiet_time", "A quiet time begins: masses stand still."
    MASSES_FREE = "masses_free", "Masses may move again."
    EXPERIMENT_DONE = "experiment_done", "The experiment has ended."

    # Why a procedure ends
    WITHIN_TOLERANCE = "goal_reached", "Within tolerance."
    ESTIMATE_UNUSABLE = "estimate_cannot_be_used", "The estimate is not usable."
    TIME_USED_UP = "time_used_up", "The time limit is reached."
    MOVES_USED_UP = "moves_used_up", "All permitted moves were made."
    NEAREST = (
        "nearest",
        "The masses are where they bring the centre of mass closest to the target: "
        "their travel does not reach it.",
    )
    ROUNDS_USED_UP = "rounds_used_up", "All permitted rounds were made."
    TILTED = "tilt_limit_exceeded", "The platform reaches its tilt limit."
    NOTHING_REQUIRED = "no_verdict_required", "No requirement was stated, so there is no verdict."
    LAW_WILL_BE_LATE = (
        "law_will_be_late",
        "{0} should take {expected:.0f} s on this testbed, and has {available:.0f} s: "
        "it will probably be cut off before the platform is balanced. Allow more time "
        "(--max-time-s), use stronger devices or another law, or state a smaller "
        "com_sd.",
    )
    LAW_RAN = "law_ran", "{0} for {duration:.0f} s of bench time:"  # why it ended follows
