"""When a hold moves masses, and where to: towards the target, and not so as to pump a swing.

Where the tracker suspects a contact it opens its posterior, which noise then moves by as much as
the sd, for some measurements. Mostly there was no contact: so what is not known well moves masses
only where it is off for sure.
"""

import numpy as np

from equipoise.actuators.sliding_masses import shift_by
from equipoise.estimation.tracker import tracker
from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.testbed import Testbed
from equipoise.procedure.balancing.hold_verdict import Measured
from equipoise.procedure.steps.displacement_choice import displacements_for
from equipoise.procedure.steps.verify import Aim

ACT = 0.25  # of the tolerance, chosen: an offset from which a move is considered
PRESSING = 0.6  # of the tolerance: an offset that is not kept waiting
WIDE = 0.6  # of the tilt limit: a swing that corrections should calm
VAGUE = 0.5  # of the tolerance, chosen: an sd of the centre of mass that is open
FOR_SURE = 2.0  # sd, chosen
GAIN = 0.1  # of the tolerance: the least improvement of the worst axis by a move


def significant_com(later: Measured, aim: Aim) -> Vector3:
    """Return the centre of mass (m), as on target where it is open and not off for sure."""
    off = later.com - aim.target
    is_open = later.sd > VAGUE * aim.tolerance
    return aim.target + np.where(is_open & (np.abs(off) < FOR_SURE * later.sd), 0.0, off)


def correction(com: Vector3, displacement: Floats, testbed: Testbed, options: Aim) -> Floats | None:
    """Return displacements (m) that bring the centre of mass closer, or None."""
    now = np.abs(com - options.target) / options.tolerance
    if now.max() < ACT:
        return None
    goal = displacements_for(testbed, displacement, options.target - com)
    change = shift_by(testbed, goal - displacement)
    then = np.abs(com + change - options.target) / options.tolerance
    return goal if then.max() < now.max() - GAIN else None


def swing_amplitude(state: tracker.State, com: Vector3, testbed: Testbed) -> float:
    """Return the tilt (rad) that the present swing reaches: all its energy as height.

    1/2 w.J w (w across the vertical) + m g (R r).z = -m g |r| cos(amplitude)
    """
    R = to_matrix(state.q)
    across = state.rate - (state.rate @ R[2]) * R[2]
    weight = testbed.weight * float(np.linalg.norm(com))
    height = testbed.weight * float((R @ com)[2])
    energy = 0.5 * float(across @ state.inertia_P @ across) + height
    return float(np.arccos(np.clip(-energy / weight, -1.0, 1.0)))


def calming(state: tracker.State, shift: Vector3, testbed: Testbed) -> bool:
    """Say whether a shift d of the centre of mass (m) takes energy out of the swing now.

    At attitude R it adds m g (R d)_z, less what it moves the whole swing up or down: m g d.up.
    """
    return float((to_matrix(state.q) @ shift)[2]) <= float(shift @ testbed.up)


def timely(state: tracker.State, com: Vector3, shift: Vector3, testbed: Testbed) -> bool:
    """Say whether to make a correction now.

    Corrections at any moment would pump an undamped platform; once it swings far, only those that
    calm it are made, and soon there is one.
    """
    wide = swing_amplitude(state, com, testbed) > WIDE * testbed.tilt_limit
    return not wide or calming(state, shift, testbed)


def next_goal(
    state: tracker.State, com: Vector3, displacement: Floats, testbed: Testbed, options: Aim
) -> Floats | None:
    """Return displacements (m) to go to now, or None; ``com`` is expected at the next look."""
    goal = correction(com, displacement, testbed, options)
    if goal is None:
        return None
    shift = shift_by(testbed, goal - displacement)
    pressing = bool(np.any(np.abs(com - options.target) > PRESSING * options.tolerance))
    return goal if pressing or timely(state, com, shift, testbed) else None


def nearest_offset(
    com: Vector3, displacement: Floats, testbed: Testbed, target: Vector3
) -> Vector3:
    """Return how far off its target (m) the centre of mass stays, whatever the masses do."""
    goal = displacements_for(testbed, displacement, target - com)
    return np.abs(com + shift_by(testbed, goal - displacement) - target)
