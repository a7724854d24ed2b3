"""The events of a survey as a person wants them: impulses in N m s, steps in m, and where.

A jump dw of the rate is an impulse R J dw about P in laboratory axes. One whose horizontal part is
most of it can come of an upward push at a place of the body, which lies along

    z x L_h                           (a push along z at rho gives L = rho x z dt)
"""

import numpy as np

from equipoise.estimation.believed_model import Believed
from equipoise.estimation.fitted import Fitted
from equipoise.estimation.smoothing import Smoothed
from equipoise.estimation.trajectory_problem import forward_of
from equipoise.estimation.unknowns import unknowns_of
from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.event import Event

SURE = 3.0  # chosen: sd by which a horizontal part must stand out to be placed
MOSTLY = 0.5  # chosen: share of the impulse that is horizontal


def azimuth_of(impulse_N: Vector3, sd: float, R: Matrix3, up: Vector3) -> float | None:
    """Return where an upward push would have given this impulse, rad about ``up``; None: unsure."""
    level = impulse_N * [1.0, 1.0, 0.0]
    size = float(np.linalg.norm(level))
    if size < SURE * sd or size < MOSTLY * float(np.linalg.norm(impulse_N)):
        return None
    place = R.T @ np.cross([0.0, 0.0, 1.0], level)
    forward = np.array(forward_of(up))
    return float(np.arctan2(place @ np.cross(up, forward), place @ forward))


def told(belief: Believed, fit: Fitted, after: Smoothed) -> tuple[Event, ...]:
    """Return the events of a belief in order of time."""
    at = {round(jump.t, 9): k for k, jump in enumerate(fit.problem.jumps)}
    found: list[Event] = []
    for event in sorted(belief.events, key=lambda e: e.t):
        k = at[round(event.t, 9)]
        jump, spread = fit.jumps[k, :3], after.jump_covariance[k, :3, :3]
        surprise = float(jump @ np.linalg.solve(spread, jump))
        if event.kind == "com_step":
            found.append(Event("com_step", event.t, jump.copy(), spread.copy(), surprise))
            continue
        point = unknowns_of(after.points[k + 1])
        R = to_matrix(point.q0)
        turn: Matrix3 = R @ point.body(belief.testbed.body.mass).inertia_P
        size, covariance = turn @ jump, turn @ spread @ turn.T
        sd = float(np.sqrt(np.trace(covariance) / 3))
        where = azimuth_of(size, sd, R, belief.testbed.up)
        found.append(Event("impulse", event.t, size, covariance, surprise, where))
    return tuple(found)
