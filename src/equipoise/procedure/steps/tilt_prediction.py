"""The predicted tilt of the platform for planned targets of the masses."""

from dataclasses import dataclass

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.dynamics.propagation import body_of, propagate, rigid_body
from equipoise.dynamics.timeline import timeline
from equipoise.maths.attitude import tilt
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.arrays import Floats, Quaternion, Series1, Vector3
from equipoise.model.recording import Samples
from equipoise.model.testbed import Testbed
from equipoise.procedure.steps.joint_fit import Knowledge

HORIZON = 25.0  # s, chosen: a swing of a platform whose centre of mass is 100 um low
GRID = 0.5  # s
GUARD = 0.85  # of the tilt limit, chosen
BRINK = 0.95  # of the tilt limit, chosen: the rest is for errors of the prediction


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
    rigid = rigid_body(point.body(testbed.body.mass), testbed.gravity, point.torque)
    motion = propagate(rigid, mass_maps(testbed.masses), line, point.q0, point.w0)
    return motion.q[-1], motion.rate[-1]


def likely_coms(knowledge: Knowledge, testbed: Testbed) -> list[Vector3]:
    """Return the centre of mass and, one sd off to either side, the worst sideways directions."""
    across = np.eye(3) - np.outer(testbed.up, testbed.up)
    values, vectors = np.linalg.eigh(across @ knowledge.covariance @ across)
    offsets = [sign * np.sqrt(values[k]) * vectors[:, k] for k in (1, 2) for sign in (1.0, -1.0)]
    return [knowledge.com, *(knowledge.com + offset for offset in offsets)]


@dataclass(frozen=True, slots=True, eq=False)
class Outlook:
    """The state from which a move would start, and how it is judged."""

    knowledge: Knowledge
    testbed: Testbed
    state: tuple[Quaternion, Vector3]  # attitude, rate (rad/s)
    cautious: bool = True  # judge by the worst of the likely centres of mass
    wait: float = 0.0  # s, until the move begins

    @property
    def guard(self) -> float:
        """Return the tilt (rad) that no plan should pass."""
        return GUARD * self.testbed.tilt_limit

    @property
    def brink(self) -> float:
        """Return the tilt (rad) that the safest move must still keep within."""
        return BRINK * self.testbed.tilt_limit

    @property
    def coms(self) -> list[Vector3]:
        """Return the centres of mass (m) to reckon with."""
        if self.cautious:
            return likely_coms(self.knowledge, self.testbed)
        return [self.knowledge.com]

    def peak(self, targets: Floats) -> float:
        """Return the greatest tilt (rad) to expect with the masses going to ``targets`` (m)."""
        masses, total = self.testbed.masses, self.testbed.body.mass
        maps, now = mass_maps(masses), self.knowledge.displacement
        t, d = travel(now, targets, self.testbed, self.wait)
        grid = np.arange(0.0, self.wait + HORIZON, GRID)
        line = timeline(grid, np.zeros(0), Samples(t, d), len(masses), 1.0)
        inertia = pack_symmetric(self.knowledge.fitted.point.body(total).inertia_P)
        worst = 0.0
        for com in self.coms:
            moment = total * com - now @ maps.first_moment  # as if the masses stood at home
            rigid = body_of(total, self.testbed.gravity, inertia, moment)
            motion = propagate(rigid, maps, line, *self.state)
            worst = max(worst, float(tilt(motion.q, self.testbed.up).max()))
        return worst
