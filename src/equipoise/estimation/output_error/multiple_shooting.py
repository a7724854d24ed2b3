"""Multiple shooting: a start for the trajectory fit from the measured motion, whatever the body.

A single trajectory from a wrong body leaves the data within a swing, and from there no local step
leads back. So the record is cut into short stretches that each begin at the measured attitude and
rate; what is missing between the end of one and the beginning of the next counts as a jump with an
sd, and the sd shrinks from one search to the next until the stretches join (Bock 1983, with the
joints softened; cost grows with the number of stretches).

Needs attitudes: rates alone give no states to begin with.
"""

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from equipoise.dynamics.propagation import propagate, rigid_body
from equipoise.estimation.motion.sampled_motion import SampledMotion, sampled_motion
from equipoise.estimation.output_error.kernels.segments import Cuts
from equipoise.estimation.output_error.problem import Problem, posed
from equipoise.estimation.output_error.segment_jumps import Jump
from equipoise.estimation.output_error.solution import settle
from equipoise.estimation.parameters.fit_parameters import Unknowns
from equipoise.estimation.search_budget import Stage
from equipoise.maths.attitude import difference, turned_on
from equipoise.model.arrays import Floats, Quaternion, Series1, Vector3
from equipoise.model.estimate import ATTITUDE, RATE
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

STRETCHES = 40  # chosen: each a small part of a swing that the record shows
FIRST = (0.2, 0.2)  # rad, and of the greatest rate: sd of the first joints, chosen
SLOWEST = 0.01  # rad/s, chosen: a platform that hardly moves
TIGHTENED = tuple(0.2**stage for stage in range(6))  # chosen: to a ten-thousandth of the first sd
EACH = 30  # evaluations
TINY = 1e-9  # rad, rad/s: no joint is without an sd
Joints = tuple[Jump, ...]


def state_near(motion: SampledMotion, t: float) -> tuple[Quaternion, Vector3]:
    """Return the measured attitude and rate at a time: those of the nearest row, turned on."""
    k = int(np.argmin(np.abs(motion.t - t)))
    return turned_on(motion.q[k], motion.w[k], t - motion.t[k]), motion.w[k]


def joints(times: Series1, attitude_sd: float, rate_sd: float) -> Joints:
    """Return jumps of attitude and rate at these times."""
    sd = (attitude_sd,) * 3 + (rate_sd,) * 3
    return tuple(Jump(float(t), (*ATTITUDE, *RATE), sd) for t in times)


def missing(problem: Problem, point: Unknowns, motion: SampledMotion, cuts: Cuts) -> Floats:
    """Return the jumps from the end of each stretch to the measured beginning of the next."""
    rigid = rigid_body(point.body(problem.mass), problem.gravity, point.torque)
    out = np.zeros((len(cuts.nodes) - 2, 6))
    q, w, line = point.q0, point.w0, problem.line
    for k in range(len(out)):
        nodes = slice(int(cuts.nodes[k]), int(cuts.nodes[k + 1]) + 1)
        part = line._replace(t=line.t[nodes], known=line.known[nodes])
        end = propagate(rigid, problem.maps, part, q, w)
        q, w = state_near(motion, float(part.t[-1]))
        out[k, :3], out[k, 3:] = difference(q, end.q[-1]), w - end.rate[-1]
    return out


def first_joined(motion: SampledMotion, cut: Problem, body: Unknowns) -> tuple[Unknowns, Floats]:
    """Return a body that begins as measured, and its jumps to each measured state."""
    q0, w0 = state_near(motion, float(cut.line.t[0]))
    point = replace(body, q0=q0, w0=w0)
    return point, missing(cut, point, motion, posed(cut).cuts)


def shot(
    recording: Recording, testbed: Testbed, posed_with: Callable[[Joints], Problem], body: Unknowns
) -> Unknowns:
    """Return a point near the optimum; ``body`` gives the first one, ``posed_with`` adds joints."""
    motion = sampled_motion(recording, testbed)
    times = np.linspace(*recording.span, STRETCHES + 1)[1:-1]
    fastest = max(float(np.linalg.norm(motion.w, axis=1).max()), SLOWEST)
    first = first_joined(motion, posed_with(joints(times, *FIRST)), body)
    stages = (joints(times, tight * FIRST[0], tight * FIRST[1] * fastest) for tight in TIGHTENED)
    return tightened(first, map(posed_with, stages))[0]


def tightened(first: tuple[Unknowns, Floats], stages: Iterable[Problem]) -> tuple[Unknowns, Floats]:
    """Return a point and its jumps after some searches, each from where the one before ended."""
    point, jumps = first
    for cut in stages:
        if not cut.budget.allows(Stage.MOTION):
            break
        found = settle(cut, point, jumps, EACH)
        point, jumps = found.point, found.jumps
    return point, jumps


def shot_driven(
    recording: Recording,
    testbed: Testbed,
    posed_with: Callable[[Joints], Problem],
    body: Unknowns,
    times: Series1,
) -> tuple[Unknowns, Floats]:
    """Return a point near the motion of a platform that something drives, and its jumps of rate.

    Only the attitude's joints close; rates (rad/s, (K, 3)) go on to jump at ``times``, by what
    drives the platform and, to begin with, by what the measured rates err.
    """
    motion = sampled_motion(recording, testbed)
    first = first_joined(motion, posed_with(joints(times, *FIRST)), body)
    turn_sd, rate_sd = (max(rms(part), TINY) for part in (first[1][:, :3], first[1][:, 3:]))
    stages = (joints(times, turn_sd * tight, rate_sd) for tight in TIGHTENED)
    point, jumps = tightened(first, map(posed_with, stages))
    return point, jumps[:, 3:]


def rms(values: Floats) -> float:
    """Return the root of the mean square."""
    return float(np.sqrt(np.mean(values**2)))
