"""Which terms beside gravity and a rigid body a record supports: sensors' errors and torques.

A group of terms is looked at when, by its score at the present optimum,

    gain = b_B^T (A_BB - A_BA A_AA^-1 A_AB)^-1 b_B  >  m ln(rows)          [Schwarz 1978, BIC]

and kept when it also predicts: mass properties, torques and sensors fitted in one half of the
record explain the other half better with the group than without, only state, events and process
noise being free there. A term that merely bends to fit one half loses on the other.

Cannot tell apart terms that do the same within the record: the first that predicts is kept.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.believed_model import (
    Believed,
    active,
    jumps_of,
    smoothed,
    width,
)
from equipoise.estimation.jumps import carried
from equipoise.estimation.trajectory import at_rest, problem_of
from equipoise.estimation.trajectory_problem import Problem, changes, descend, evaluate
from equipoise.estimation.unknowns import RATE, TURN, Unknowns, unknowns_of
from equipoise.maths.attitude import exponential, multiply
from equipoise.model import sensor_terms, torque_terms
from equipoise.model.arrays import Floats
from equipoise.model.recording import Recording, window

CAMERA, GYRO = ("plumb", "heading2", "heading3"), ("gyro_scale", "gyro_cross")
EVALUATIONS = 30


def candidates(belief: Believed) -> list[tuple[str, ...]]:
    """Return the groups of terms that this record could show and that are not sought yet."""
    recording, params = belief.recording, belief.params
    groups: list[str] = []
    if recording.attitude is not None and len(recording.attitude):
        groups += CAMERA
        if recording.rate is not None or changes(recording):
            groups.append("camera_delay")
    if recording.rate is not None and recording.attitude is not None:
        groups += GYRO
    found = [sensor_terms.GROUPS[name] for name in groups]
    found += list(torque_terms.GROUPS.values())
    sought = {*params.sensor, *params.terms}
    return [group for group in found if not sought.issuperset(group)]


def with_group(belief: Believed, group: tuple[str, ...]) -> Believed:
    """Return the model with a group of terms more."""
    params = belief.params
    if set(group) <= set(sensor_terms.TERMS):
        wanted = {*params.sensor, *group}
        sensor = tuple(term for term in sensor_terms.TERMS if term in wanted)
        return replace(belief, params=replace(params, sensor=sensor))
    wanted = {*params.terms, *group}
    terms = tuple(term for term in torque_terms.TERMS if term in wanted)
    return replace(belief, params=replace(params, terms=terms))


def posed_in(belief: Believed, recording: Recording) -> tuple[Problem, Floats]:
    """Return the problem of a model on a record or a part of it, and where its jumps stand."""
    whole = replace(belief, recording=recording)
    params = replace(belief.params, jumps=jumps_of(whole, active(belief)))
    problem = problem_of(recording, belief.testbed, params)
    before = belief.fitted
    wide = width(problem.jumps)
    return problem, carried(before.problem.jumps, before.jumps, problem.jumps, wide)


def gain(belief: Believed, group: tuple[str, ...]) -> float:
    """Return by how much a group would lower twice the cost, by the local model."""
    problem, jumps = posed_in(with_group(belief, group), belief.recording)
    at = evaluate(problem, belief.fitted.point, jumps)
    B = np.array([name in group for name in problem.layout.names])
    unit = 1 / np.sqrt(np.diag(at.normal))
    A, b = at.normal * np.outer(unit, unit), at.descent * unit
    rest = np.linalg.solve(A[np.ix_(~B, ~B)], A[np.ix_(~B, B)])
    told = A[np.ix_(B, B)] - A[np.ix_(B, ~B)] @ rest
    b_B = b[B] - rest.T @ b[~B]
    return float(b_B @ np.linalg.lstsq(told, b_B, rcond=1e-9)[0])


def price(belief: Believed, group: tuple[str, ...]) -> float:
    """Return the gain below which a group is not worth its coefficients: m ln(rows)."""
    recording = belief.recording
    rows = sum(3 * len(c) for c in (recording.attitude, recording.rate) if c is not None)
    return len(group) * float(np.log(rows))


def best_group(belief: Believed, refused: set[tuple[str, ...]]) -> tuple[tuple[str, ...], float]:
    """Return the group that gains most above its price, and that surplus."""
    open_to = [group for group in candidates(belief) if group not in refused]
    surplus = [gain(belief, group) - price(belief, group) for group in open_to]
    most = int(np.argmax(surplus)) if surplus else 0
    return (open_to[most], surplus[most]) if surplus else ((), -np.inf)


def halves(belief: Believed) -> tuple[tuple[Recording, Unknowns], ...]:
    """Return both halves of the record, each with a state near its beginning."""
    fit, after = smoothed(belief)
    start, end = belief.recording.span
    k = len(fit.problem.jumps) // 2
    middle = fit.problem.jumps[k].t
    first, second = (window(belief.recording, *ends) for ends in ((start, middle), (middle, end)))
    there = unknowns_of(after.points[k + 1])
    late = float(problem_of(second, belief.testbed, belief.params).line.t[0]) - middle
    there = replace(there, q0=multiply(there.q0, exponential(late * there.w0)))
    return (first, belief.fitted.point), (second, there)


def unexplained(
    belief: Believed, learnt: tuple[Recording, Unknowns], asked: tuple[Recording, Unknowns]
) -> float:
    """Return twice the cost of one part with everything but state and jumps learnt from another."""
    problem, jumps = posed_in(belief, learnt[0])
    known = descend(problem, at_rest(problem, learnt[1]), EVALUATIONS, jumps).point
    problem, jumps = posed_in(belief, asked[0])
    held = np.ones(problem.layout.size, dtype=bool)
    held[TURN], held[RATE], held[problem.layout.size - 3 * problem.layout.bias :] = (
        False,
        False,
        False,
    )
    problem = replace(problem, prior=replace(problem.prior, held=held))
    guess = replace(known, q0=asked[1].q0, w0=asked[1].w0)
    return 2.0 * descend(problem, at_rest(problem, guess), EVALUATIONS, jumps).at.cost


def predicts_better(poorer: Believed, richer: Believed) -> bool:
    """Say whether the richer model of two learns in each half what helps in the other."""
    costs: list[float] = []
    for belief in (poorer, richer):
        first, second = halves(belief)
        costs.append(unexplained(belief, first, second) + unexplained(belief, second, first))
    return costs[1] < costs[0]
