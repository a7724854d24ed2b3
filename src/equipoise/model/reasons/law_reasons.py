"""What balancing laws report, and why they have done their work."""

from equipoise.model.reasons.reason import Code


class LawReason(Code):
    """One thing that a law reports, with its sentence."""

    # What it does next
    RELAY_BEGINS = "relay_begins", "Hangs at rest; the relay experiment begins."
    SWINGS_FOR_HEIGHT = (
        "swings_for_height",
        "Level; swings by {swing:deg .1f} deg to measure its height.",
    )
    PUSH_BEGINS = "push_begins", "Levelled; now a push, and an estimate of the swing."
    RAISED = "raised", "Raised to {depth:um .3g} um below the target."
    MOVED_BY_JETS = (
        "moved_by_jets",
        "Moved on by ({shift_x:um .2f}, {shift_y:um .2f}, {shift_z:um .2f}) um by what the jets "
        "spent.",
    )
    CONE_BEGINS = (
        "cone_begins",
        "Gravity is led around a cone of {angle:deg .1f} deg, {turn:.0f} s per "
        "revolution. An offset decays in {fades:.0f} s; the expected duration is "
        "{expected:.0f} s.",
    )

    # What it found
    CYCLE_MEASURED = (
        "cycle_measured",
        "K_u {gain:um .3g} um/rad, T_u {period:.3g} s (calculated {expected_gain:um .3g} and "
        "{expected_period:.3g}).",
    )
    CYCLE_REJECTED = "cycle_rejected", "No reliable limit cycle; using the calculated gains."
    HEIGHT_MISSING = (
        "height_missing",
        "Swing {rounds:.0f}: {missing:um .2f} um remain in height, about {across:um "
        ".2f} um horizontally.",
    )
    ESTIMATE_UNUSABLE = (
        "swing_unusable",
        "The estimate is not usable:",
    )  # its reasons follow

    # Why it ends
    LEVEL_AT_TARGET = "level_at_target", "Level, and at the target."
    HEIGHT_NOT_SHOWN = (
        "height_not_shown",
        "Level; its height could not be determined:",
    )  # reasons follow
    COM_NOT_SHOWN = (
        "com_not_shown",
        "The centre of mass could not be determined:",
    )  # reasons follow
    AT_PLACE = "at_place", "At its place after {swings:.0f} swings."
    MOVES_MADE = "moves_made", "Made its {moves:.0f} moves."
    AT_PLACE_BY_TURNS = "at_place_by_turns", "At its place after {rounds:.0f} rounds of turns."
    COM_TOO_UNCERTAIN = (
        "com_too_uncertain",
        "After {swings:.0f} swings r is known to {sd:um .2g} um; {wanted:um .2g} um are required.",
    )
    LEVEL_AT_HEIGHT = "level_at_height", "Level, and at its height after {swings:.0f} swings."
    MOTOR_STEP_OR_LESS = "motor_step_or_less", "That is a motor step or less."
    NOTHING_GAINED = "nothing_gained", "The last round gained nothing."
    LEVEL_AGAIN = "level_again", "Level again."
    ALL_ATTITUDES_MEASURED = "all_attitudes_measured", "Measured at all attitudes and moved there."
    MASSES_AT_REST = (
        "masses_at_rest",
        "Gravity has completed {turns:.0f} revolutions of the cone. From the motion of "
        "the masses in the last two, {left:um .2f} um remain; an inertia error of one "
        "sd leaves {height:um .2g} um in height.",
    )
    MASSES_NOT_AT_REST = (
        "masses_not_at_rest",
        "After {past:.0f} s, much longer than expected, the masses still move: about "
        "{left:um .2g} um remain.",
    )
    TORQUE_NOT_GIVEN = (
        "torque_not_given",
        "For {past:.0f} s, much longer than expected, wheels or gyros have not "
        "delivered the requested torque: the remaining offset is unknown.",
    )
    DIRECTION_NOT_SWEPT = (
        "direction_not_swept",
        "The platform is at rest. Gravity has swept all directions but ({axis_x:.2f}, "
        "{axis_y:.2f}, {axis_z:.2f}), for {least:.2g} s of {past:.3g} s: the centre of "
        "mass may lie anywhere along it, and is not balanced. A momentum trajectory "
        "must move it.",
    )
    OFF_TARGET_BY = (
        "off_target_by",
        "The centre of mass is ({off_x:um .3f} +/- {sd_x:um .3f}, {off_y:um .3f} +/- "
        "{sd_y:um .3f}, {off_z:um .3f} +/- {sd_z:um .3f}) um off target.",
    )
    FOLLOWED = "followed", "Masses followed tilt and drift."
    TILTED = "law_tilted", "Stopped: the platform reaches its tilt limit."
