"""How far the platform will tilt if the masses go where a plan says."""

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.dynamics.propagation import body_of, propagate
from equipoise.dynamics.timeline import timeline
from equipoise.maths.attitude import tilt
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.arrays import Floats, Quaternion, Series1, Vector3
from equipoise.model.recording import Samples
from equipoise.model.testbed import Testbed
from equipoise.procedure.knowledge import Knowledge

HORIZON = 40.0  # s, chosen: a swing of a platform whose centre of mass is 100 um low
GRID = 0.25  # s


def travel(now: Floats, targets: Floats, testbed: Testbed, wait: float) -> tuple[Series1, Floats]:
    """Return the corners of a move that begins after ``wait`` (s): times and displacements."""
    speed = np.array([mass.speed for mass in testbed.masses])
    ends = wait + np.abs(targets - now) / speed
    t = np.unique(np.concatenate([[0.0, wait, wait + HORIZON], ends]))
    share = np.clip((t[:, None] - wait) / np.maximum(ends - wait, 1e-9), 0.0, 1.0)
    return t, now + share * (targets - now)


def state_now(knowledge: Knowledge, testbed: Testbed) -> tuple[Quaternion, Vector3]:
    """Return attitude and rate at the end of the record, from the fit."""
    fitted = knowledge.fitted
    point, line = fitted.point, fitted.problem.line
    body = point.body(testbed.body.mass)
    rigid = body_of(body.mass, testbed.gravity, pack_symmetric(body.inertia_P), body.first_moment,
                    point.torque)  # fmt: skip
    motion = propagate(rigid, mass_maps(testbed.masses), line, point.q0, point.w0)
    return motion.q[-1], motion.rate[-1]


def peak_tilt(
    knowledge: Knowledge,
    testbed: Testbed,
    state: tuple[Quaternion, Vector3],
    targets: Floats,
    wait: float,
) -> float:
    """Return the greatest tilt (rad) over the horizon if the move begins after ``wait`` (s)."""
    maps, total = mass_maps(testbed.masses), testbed.body.mass
    now = knowledge.displacement
    t, d = travel(now, targets, testbed, wait)
    line = timeline(np.arange(0.0, wait + HORIZON, GRID), np.zeros(0), Samples(t, d),
                    len(testbed.masses), 1.0)  # fmt: skip
    body = knowledge.fitted.point.body(total)
    moment = total * knowledge.com - now @ maps.first_moment  # as if the masses stood at home
    rigid = body_of(total, testbed.gravity, pack_symmetric(body.inertia_P), moment)
    motion = propagate(rigid, maps, line, *state)
    return float(tilt(motion.q, testbed.up).max())

