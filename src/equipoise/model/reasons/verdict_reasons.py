"""What a verdict rests on; ``model.verdict`` says which of these pass, fail or decide nothing."""

from equipoise.model.reasons.reason import Code

WHERE = (
    "the centre of mass is at ({com_x:um .2f} +/- {sd_x:um .2f}, {com_y:um .2f} +/- {sd_y:um .2f}, "
    "{com_z:um .2f} +/- {sd_z:um .2f}) um"
)
HOLD = (
    "held for {duration:min .3g} min; at most ({off_x:um .1f} +/- {sd_x:um .1f}, {off_y:um .1f} "
    "+/- {sd_y:um .1f}, {off_z:um .1f} +/- {sd_z:um .1f}) um from the target"
)
TORQUE = (
    "gravity torque within {tilt:deg g} deg of level, rms, is {found:uN m plain} uN m (95 %: "
    "{low:uN m plain} uN m to {high:uN m plain} uN m); required: at most {limit:uN m plain} uN m."
)
OFFSET = (
    "the centre of mass is {found:um plain} um from its target (95 %: {low:um plain} um to "
    "{high:um plain} um); required: at most {limit:um plain} um."
)
UNPASSABLE = (
    "even a perfect platform would not pass. Record longer, with larger swings about both axes, or "
    "with better sensors."
)
TOO_NEAR = "the value is too near to the limit to be sure."
SCATTER = "(chi-square {chi_square:.3g} of {freedom:.3g} expected, probability {probability:.2g})."
MISSED = "The requirement of {required:uN m plain} uN m cannot be met:"


class VerdictReason(Code):
    """One thing that a verdict rests on, with its sentence."""

    # On the centre of mass, as a record shows it
    WITHIN_TOLERANCE = "within_tolerance", f"Passed: {WHERE}, within tolerance on every axis."
    OUTSIDE_TOLERANCE = "outside_tolerance", f"Failed: {WHERE}; {{names}} outside the tolerance."
    TOO_UNCERTAIN = "too_uncertain", f"Cannot tell: {WHERE}; {{names}} not known precisely enough."
    RECORD_MISFITS = (
        "record_misfits",
        "Failed: the record since the last move contradicts the estimate before it.",
    )
    MOVE_MISSED = (
        "move_missed",
        f"Failed: {WHERE}, which is not where the last move should have left it.",
    )
    ESTIMATE_UNUSABLE = "estimate_unusable", "Cannot tell:"  # the estimate's own reasons follow
    HELD = "held", f"Passed: {HOLD}, within tolerance on every axis all the time."
    HOLD_UNDECIDED = "hold_undecided", f"Cannot tell: {HOLD}; {{names}} not known precisely enough."
    RAILS_ENDED = (
        "rails_ended",
        f"Failed: held for {{duration:min .3g}} min, until the masses reached the ends "
        f"of their rails; {WHERE}. Add a weight by hand so that they start closer to "
        "home.",
    )
    NOT_HELD = "not_held", f"Failed: {HOLD}; {{names}} outside the tolerance."

    # On a run that was broken off
    TILTED = "tilted", "Stopped: the platform reaches its tilt limit."
    BENCH_STOPPED = "bench_stopped", "Stopped: {0}."
    STOPPED_BY_HAND = "stopped_by_hand", "Stopped by the user: {0}."
    STOPPED_BY_SIGNAL = "stopped_by_signal", "Stopped by {0}: {1}."

    # On a requirement
    TORQUE_MET = "torque_met", f"Passed: {TORQUE}"
    TORQUE_EXCEEDED = "torque_exceeded", f"Failed: {TORQUE}"
    TORQUE_UNDECIDED = "torque_undecided", f"Cannot tell: {TORQUE}"
    TORQUE_FLOOR_BEYOND_LIMIT = (
        "torque_floor_beyond_limit",
        f"The detection limit of this recording is {{floor:uN m plain}} uN m: {UNPASSABLE}",
    )
    TORQUE_TOO_NEAR_LIMIT = (
        "torque_too_near_limit",
        f"The detection limit of this recording is {{floor:uN m plain}} uN m: {TOO_NEAR}",
    )
    OFFSET_MET = "offset_met", f"Passed: {OFFSET}"
    OFFSET_EXCEEDED = "offset_exceeded", f"Failed: {OFFSET}"
    OFFSET_UNDECIDED = "offset_undecided", f"Cannot tell: {OFFSET}"
    OFFSET_FLOOR_BEYOND_LIMIT = (
        "offset_floor_beyond_limit",
        f"The detection limit of this recording is {{floor:um plain}} um: {UNPASSABLE}",
    )
    OFFSET_TOO_NEAR_LIMIT = (
        "offset_too_near_limit",
        f"The detection limit of this recording is {{floor:um plain}} um: {TOO_NEAR}",
    )
    INERTIA_UNCERTAIN = (
        "inertia_uncertain",
        "The result is proportional to the inertia, which is known to {sd:% .2g} %.",
    )

    # On whether several runs agree
    RUNS_AGREE = (
        "runs_agree",
        f"Passed: {{count:.0f}} runs scatter no more than their intervals allow {SCATTER}",
    )
    RUNS_SCATTER = (
        "runs_scatter",
        f"Failed: {{count:.0f}} runs scatter {{factor:.2g}} times as much as their intervals allow "
        f"{SCATTER}",
    )
    RUNS_DEVIATE = "runs_deviate", "{both} contributes most."
    RUNS_INCOMPARABLE = (
        "runs_incomparable",
        "Cannot tell: the {count:.0f} runs have no determined parameter in common.",
    )
    RUNS_NOT_FITTED = "runs_not_fitted", "Cannot tell whether runs agree: there is no joint fit."

    # On a series of balancings
    EVERY_RUN_PASSED = "every_run_passed", "Passed: all {count:.0f} runs passed."
    SOME_RUNS_FAILED = (
        "some_runs_failed",
        "Failed: {failed:.0f} of {count:.0f} runs did not pass, number {names}.",
    )

    # On a design
    NOTHING_REQUIRED = (
        "nothing_required",
        "No requirement was stated; {expected:uN m plain} uN m are expected.",
    )
    REQUIREMENT_MET = (
        "requirement_met",
        "{expected:uN m plain} uN m are expected; {required:uN m plain} uN m are required.",
    )
    EXPECTED_NEAR_LIMIT = (
        "expected_near_limit",
        "Cannot tell: {expected:uN m plain} uN m are expected, accurate to {accuracy:% "
        ".3g} %; {required:uN m plain} uN m are required.",
    )
    OUT_OF_REACH = (
        "out_of_reach",
        f"{MISSED} only {{within:% .3g}} % of the platforms that the testbed states are within "
        "reach of the masses. Of those, {expected:uN m plain} uN m are expected.",
    )
    MET_BY_ONE_CHANGE = (
        "met_by_one_change",
        f"{MISSED} {{expected:uN m plain}} uN m are expected; sufficient would be: {{choices}}.",
    )
    MET_BY_CHANGES = (
        "met_by_changes",
        f"{MISSED} {{expected:uN m plain}} uN m are expected; sufficient together would be: "
        "{choices}.",
    )
    MET_BY_NO_CHANGE = (
        "met_by_no_change",
        f"{MISSED} {{expected:uN m plain}} uN m are expected; no change found is sufficient.",
    )
