"""Which terms beside gravity and a rigid body a record supports: sensors' errors and torques.

A group of terms is looked at when, by its score at the present optimum,

    gain = b_B^T (A_BB - A_BA A_AA^-1 A_AB)^-1 b_B  >  m ln(rows)          [Schwarz 1978, BIC]

and kept when it also predicts: fitted with blocks of the record left out, the model with the group
is nearer to the rows of these blocks than the one without. A term that merely bends to fit loses
where it has not seen.

Cannot tell apart terms that do the same within the record: the first that predicts is kept.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.believed_model import (
    Believed,
    active,
    jumps_of,
    width,
)
from equipoise.estimation.fitted import settle
from equipoise.estimation.jumps import carried
from equipoise.estimation.trajectory import problem_of
from equipoise.estimation.trajectory_problem import Problem, changes, evaluate
from equipoise.model import sensor_terms, torque_terms
from equipoise.model.arrays import Bools, Floats
from equipoise.model.recording import Recording, Samples

CAMERA, GYRO = ("plumb", "heading2", "heading3"), ("gyro_scale", "gyro_cross")
EVALUATIONS = 8  # chosen: from the optimum of all rows it takes three or four
BLOCKS = 8  # chosen: enough that each is short against the record


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


def without(channel: Samples | None, held: Bools, edges: Floats) -> Samples | None:
    """Return a channel without its rows in the blocks ``held``; its first and last row stay."""
    if channel is None or not len(channel):
        return channel
    block = np.clip(np.searchsorted(edges, channel.t, side="right") - 1, 0, BLOCKS - 1)
    keep = ~held[block]
    keep[[0, -1]] = True
    return Samples(channel.t[keep], channel.values[keep])


def missed(belief: Believed, held: Bools, edges: Floats) -> float:
    """Return the sum of squared residuals (sd) of held-out blocks, fitted to the other rows."""
    recording = belief.recording
    attitude, rate = (without(c, held, edges) for c in (recording.attitude, recording.rate))
    problem, jumps = posed_in(belief, replace(recording, attitude=attitude, rate=rate))
    found = settle(problem, belief.fitted.point, jumps, EVALUATIONS)
    problem, _ = posed_in(belief, recording)
    at, total = evaluate(problem, found.point, found.jumps), 0.0
    for channel, left in ((recording.attitude, at.left_q), (recording.rate, at.left_w)):
        if channel is not None and len(channel):
            block = np.clip(np.searchsorted(edges, channel.t, side="right") - 1, 0, BLOCKS - 1)
            total += float(np.sum(left[held[block]] ** 2))
    return total


def predicts_better(poorer: Believed, richer: Believed) -> bool:
    """Say whether the richer model of two is nearer to rows that it has not seen.

    The record is cut into blocks; each fold leaves out two, half a record apart, so that what is
    left spans it all. The blocks left out are bridged by the motion itself.
    """
    edges = np.linspace(*poorer.recording.span, BLOCKS + 1)
    costs: list[float] = []
    for belief in (poorer, richer):
        folds = [np.arange(BLOCKS) % (BLOCKS // 2) == fold for fold in range(BLOCKS // 2)]
        costs.append(sum(missed(belief, held, edges) for held in folds))
    return costs[1] < costs[0]
