"""The descent of the trajectory fit as one compiled kernel: from a first point to the optimum.

    cost = 1/2 sum |e|^2 + 1/2 sum weight (mean - x)^2,      A = S^T S + weight,
    b = S^T e + weight (mean - x)

and with priors of inertia and com that are coupled, weight + coupling in place of weight,

in physical coordinates x, data by one pass over the record (``record_pass``). A held
coordinate has no row and no column in A but its own, and does not move.

A record may be cut into stretches with jumps between them (``segments``); the point is that of the
first, and each further stretch begins where the one before it ends, plus its jump.
"""

from typing import NamedTuple

import numpy as np

from equipoise.estimation.output_error.kernels.parts import Share, share_for
from equipoise.estimation.output_error.kernels.record_pass import (
    Local,
    Posed,
    local_for,
    search_along,
    stop_at_commands,
)
from equipoise.estimation.output_error.kernels.segments import Chain, chain_for, condense, follow
from equipoise.estimation.parameters.retraction import (
    J,
    StepWork,
    coordinates_of,
    possible_step,
    retract,
    step_work_for,
)
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.kernels.copying import copy_rows, copy_values
from equipoise.maths.levenberg_marquardt import FREE, NEAR, judge, promise, tolerated
from equipoise.model.arrays import Floats

HELD = 1e-9  # relative sd reported of a value that the user holds


class Ended(NamedTuple):
    """How a descent ended."""

    cost: float
    converged: bool  # the step promises to lower twice the cost by less than is tolerated
    evaluations: int
    damping: float  # with which it goes on, and by what that grows
    growth: float


@part
def prior_cost(posed: Posed, x: Floats) -> float:
    """Return the priors' part of the cost."""
    cost = 0.0
    for k in range(x.shape[0]):
        off = posed.mean[k] - x[k]
        cost += 0.5 * posed.weight[k] * off * off
    for i in range(posed.coupling.shape[0]):
        for j in range(posed.coupling.shape[0]):
            off, other = posed.mean[J + i] - x[J + i], posed.mean[J + j] - x[J + j]
            cost += 0.5 * posed.coupling[i, j] * off * other
    return cost


@part
def add_priors(posed: Posed, x: Floats, chain: Chain) -> None:
    """Add the priors to A and b, and keep what is held."""
    normal, descent, n = chain.normal, chain.descent, x.shape[0]
    for k in range(n):
        normal[k, k] += posed.weight[k]
        descent[k] += posed.weight[k] * (posed.mean[k] - x[k])
    for i in range(posed.coupling.shape[0]):
        for j in range(posed.coupling.shape[0]):
            normal[J + i, J + j] += posed.coupling[i, j]
            descent[J + i] += posed.coupling[i, j] * (posed.mean[J + j] - x[J + j])
    for k in range(n):
        if posed.held[k]:
            for j in range(n):
                normal[k, j], normal[j, k] = 0.0, 0.0
            descent[k] = 0.0
            normal[k, k] = (HELD * max(abs(posed.mean[k]), 1e-9)) ** -2


@part
def keep(trial: Local, best: Local) -> None:
    """Make the trial the best."""
    copy_values(trial.point, best.point)
    copy_rows(trial.pieces.jumps, best.pieces.jumps)
    copy_rows(trial.pieces.points, best.pieces.points)
    copy_rows(trial.pieces.descent, best.pieces.descent)
    for k in range(best.pieces.normal.shape[0]):
        copy_rows(trial.pieces.normal[k], best.pieces.normal[k])
        if k < best.pieces.onward.shape[0]:
            copy_rows(trial.pieces.onward[k], best.pieces.onward[k])
    copy_rows(trial.left_q, best.left_q)
    copy_rows(trial.left_w, best.left_w)
    copy_rows(trial.left_v, best.left_v)


@kernel  # not a part: it is called three times, and need not be compiled so often
def model_at(posed: Posed, at: Local, damping: float, x: Floats, chain: Chain) -> float:
    """Write A and b of the first stretch's unknowns; return what the jumps alone promise."""
    promised = condense(posed.cuts, at.pieces, damping, chain)
    coordinates_of(at.point, posed.mass, posed.slots, x)
    add_priors(posed, x, chain)
    return promised


@kernel
def propose(
    posed: Posed, best: Local, damping: float, chain: Chain, x: Floats, work: StepWork,
    step: Floats, trial: Local,
) -> float:  # fmt: skip
    """Write the next point to try for a damping, and return its promise."""
    promised = model_at(posed, best, damping, x, chain)
    possible_step(best.point, posed.mass, chain.normal, chain.descent, damping, work, step)
    promised += promise(chain.normal, chain.descent, step)
    retract(best.point, step, posed.mass, posed.slots, trial.point)
    follow(posed.cuts, best.pieces, step, chain, trial.pieces.jumps)
    return promised


@part
def report(
    posed: Posed, best: Local, x: Floats, chain: Chain, normal: Floats, descent: Floats
) -> None:
    """Write A and b of the first stretch's unknowns, undamped."""
    model_at(posed, best, 0.0, x, chain)
    copy_rows(chain.normal, normal)
    copy_values(chain.descent, descent)


@kernel  # not a part: it is most of the code, and is called twice
def cost_at(
    posed: Posed, known: Floats, at: Local, share: Share, x: Floats, step: Floats, here: Floats,
    behind: Floats,
) -> float:  # fmt: skip
    """Write the local models at a point, and return the cost, infinite where that is no number.

    All but the first three are worked in.
    """
    stop_at_commands(posed, at.point, known)
    cost = search_along(posed, known, at, share, step, here, behind)
    coordinates_of(at.point, posed.mass, posed.slots, x)
    return cost + prior_cost(posed, x) if cost < np.inf else cost


@kernel
def descend(
    posed: Posed, best: Local, most: int, normal: Floats, descent: Floats,
    damping: float, growth: float,
) -> Ended:  # fmt: skip
    """Go from ``best`` to the optimum, in place, in at most so many evaluations.

    Write A and b of the first stretch's unknowns there, all jumps taken out. With one evaluation
    this is the local model at a point. A descent goes on where it ended with the damping and growth
    that it had; its first evaluation is then once more that of ``best``.
    """
    n = posed.slots.shape[0]
    rows = 3 * (best.left_q.shape[0] + best.left_w.shape[0] + best.left_v.shape[0])
    known = posed.known.copy() if posed.owners.shape[0] else posed.known
    work, step_work = share_for(posed.columns.kinds.shape[0], n), step_work_for(n)
    chain, step, x = chain_for(posed.cuts, n), np.empty(n), np.empty(n)
    here, behind = np.empty_like(best.point), np.empty_like(best.point)
    cost = cost_at(posed, known, best, work, x, step, here, behind)
    evaluations, converged, is_elsewhere, kept, trial = 1, False, False, best, best
    if most > 1 and np.isfinite(cost):
        trial = local_for(posed, best.point)
    while evaluations < most and np.isfinite(cost):
        promised, allowed = (propose(posed, kept, damping, chain, x, step_work, step, trial),
                             tolerated(cost, rows))  # fmt: skip
        if promised < allowed:
            bold = min(damping, FREE)
            promised = propose(posed, kept, bold, chain, x, step_work, step, trial)
            converged = abs(promised) < NEAR * allowed
            break
        there = cost_at(posed, known, trial, work, x, step, here, behind)
        evaluations += 1
        taken, damping, growth = judge(2.0 * (cost - there), promised, damping, growth)
        if taken:
            kept, trial, is_elsewhere, cost = trial, kept, not is_elsewhere, there
    if is_elsewhere:
        keep(kept, best)
    if np.isfinite(cost):
        report(posed, best, x, chain, normal, descent)
    return Ended(cost, converged, evaluations, damping, growth)
