"""Whether a richer model of two is nearer to rows that were held out.

Without process noise blocks of rows are left out, two at a time and half a record apart, so that
what is left spans it all; the motion itself bridges them. With process noise no motion bridges a
block: there, mass properties, torques and sensors are learnt in one half of the record, and asked
how well they explain the other, where only state, events and process noise are free.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.events.record_model import (
    RecordModel,
    active,
    jumping,
    jumps_of,
    smoothed,
)
from equipoise.estimation.output_error.growing_horizon import at_rest
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.output_error.solution import evaluate, settle
from equipoise.estimation.output_error.trajectory import problem_of
from equipoise.estimation.parameters.fit_parameters import RATE, TURN, Unknowns, unknowns_of
from equipoise.estimation.search_budget import Stage
from equipoise.maths.attitude import turned_on
from equipoise.model.arrays import Bools, Floats
from equipoise.model.recording import Recording, Samples, window

EVALUATIONS = 8  # chosen: from the optimum of all rows it takes three or four
BLOCKS = 8  # chosen: enough that each is short against the record


def posed_in(model: RecordModel, recording: Recording) -> tuple[Problem, Floats]:
    """Return the problem of a model on a record or a part of it, and where its jumps stand."""
    whole = replace(model, recording=recording)
    return jumping(model, recording, jumps_of(whole, active(model)))


def without(channel: Samples | None, held: Bools, edges: Floats) -> Samples | None:
    """Return a channel without its rows in the blocks ``held``; its first and last row stay."""
    if channel is None or not len(channel):
        return channel
    block = np.clip(np.searchsorted(edges, channel.t, side="right") - 1, 0, BLOCKS - 1)
    keep = ~held[block]
    keep[[0, -1]] = True
    return channel.where(keep)


def missed(model: RecordModel, held: Bools, edges: Floats) -> float:
    """Return the sum of squared residuals (sd) of held-out blocks, fitted to the other rows."""
    recording = model.recording
    attitude, rate = (without(c, held, edges) for c in (recording.attitude, recording.rate))
    problem, jumps = posed_in(model, replace(recording, attitude=attitude, rate=rate))
    found = settle(problem, model.fitted.point, jumps, EVALUATIONS)
    problem, _ = posed_in(model, recording)
    at, total = evaluate(problem, found.point, found.jumps), 0.0
    for channel, left in ((recording.attitude, at.left_q), (recording.rate, at.left_w)):
        if channel is not None and len(channel):
            block = np.clip(np.searchsorted(edges, channel.t, side="right") - 1, 0, BLOCKS - 1)
            total += float(np.sum(left[held[block]] ** 2))
    return total


def bridged(model: RecordModel) -> float:
    """Return the sum of squared residuals (sd) of all blocks, each bridged by what is around it."""
    edges = np.linspace(*model.recording.span, BLOCKS + 1)
    folds = [np.arange(BLOCKS) % (BLOCKS // 2) == fold for fold in range(BLOCKS // 2)]
    return sum(missed(model, held, edges) for held in folds)


def halves(model: RecordModel) -> tuple[tuple[Recording, Unknowns], ...]:
    """Return both halves of the record, each with a state near its beginning."""
    fit, after = smoothed(model)
    start, end = model.recording.span
    k = len(fit.problem.jumps) // 2
    middle = fit.problem.jumps[k].t
    first, second = (window(model.recording, *ends) for ends in ((start, middle), (middle, end)))
    there = unknowns_of(after.points[k + 1])
    late = float(problem_of(second, model.testbed, model.params).line.t[0]) - middle
    there = replace(there, q0=turned_on(there.q0, there.w0, late))
    return (first, model.fitted.point), (second, there)


def unexplained(
    model: RecordModel, learnt: tuple[Recording, Unknowns], requested: tuple[Recording, Unknowns]
) -> float:
    """Return twice the cost of one part with everything but state and jumps learnt from another."""
    problem, jumps = posed_in(model, learnt[0])
    known = settle(problem, at_rest(problem, learnt[1]), jumps, EVALUATIONS).point
    problem, jumps = posed_in(model, requested[0])
    held = np.ones(problem.layout.size, dtype=bool)
    for free in (TURN, RATE, problem.layout.gyro_bias):
        held[free] = False
    problem = replace(problem, prior=replace(problem.prior, held=held))
    guess = replace(known, q0=requested[1].q0, w0=requested[1].w0)
    return 2.0 * settle(problem, at_rest(problem, guess), jumps, EVALUATIONS).at.cost


def carried_over(model: RecordModel) -> float:
    """Return twice the cost of both halves, each with what the other has taught."""
    first, second = halves(model)
    return unexplained(model, first, second) + unexplained(model, second, first)


def predicts_better(poorer: RecordModel, richer: RecordModel) -> bool:
    """Say whether the richer model is nearer to rows that were held out."""
    score = carried_over if poorer.wanders else bridged
    found = score(richer)
    return poorer.may(Stage.TERMS) and found < score(poorer)
