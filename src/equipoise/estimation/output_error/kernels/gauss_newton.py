"""The descent of the trajectory fit as one compiled kernel: from a first point to the optimum.

    cost = 1/2 sum |e|^2 + 1/2 sum weight (mean - x)^2,      A = S^T S + weight,
    b = S^T e + weight (mean - x)

in physical coordinates x. The propagator's columns are by first moment, m times com. A held
coordinate has no row and no column in A but its own, and does not move.

A record may be cut into stretches with jumps between them (``segments``); the point is that of the
first, and each further stretch begins where the one before it ends, plus its jump.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.dynamics.forcing import groups_of
from equipoise.dynamics.propagation import evaluate
from equipoise.dynamics.rigid_body import KNOWN_D, ROWS, Body, body_at, times
from equipoise.dynamics.sensitivities import LANES, Columns, Inputs, place
from equipoise.estimation.output_error.kernels.normal_equations import (
    Measurements,
    Pass,
    accumulate,
    narrowed,
    step_behind,
)
from equipoise.estimation.output_error.kernels.parts import (
    Parts,
    Share,
    add_part,
    begin_part,
    begin_stretch,
    columns_within,
    count_errors,
    express,
    pass_on,
    share_for,
)
from equipoise.estimation.output_error.kernels.segments import (
    Chain,
    Cuts,
    Pieces,
    chain_for,
    condense,
    count_free,
    follow,
    jump_cost,
    pieces_for,
)
from equipoise.estimation.parameters.retraction import (
    BEHIND,
    ERROR,
    SENSOR,
    R,
    StepWork,
    W,
    body_at_point,
    coordinates_of,
    possible_step,
    retract,
    step_work_for,
)
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.kernels.copying import copy_rows, copy_values
from equipoise.maths.levenberg_marquardt import FREE, NEAR, judge, promise, tolerated
from equipoise.model.arrays import Floats, Ints

HELD = 1e-9  # relative sd reported of a value that the user holds


class Posed(NamedTuple):
    """A least-squares problem as the kernel sees it."""

    mass: float
    gravity: float
    maps: Floats
    t: Floats
    known: Floats
    owners: Ints
    columns: Columns
    observed: Measurements
    limit: float  # Huber's, in sd; 0: none
    mean: Floats  # of the priors
    weight: Floats
    held: NDArray[np.bool_]
    slots: Ints  # where a point keeps each coordinate
    cuts: Cuts
    parts: Parts


class Local(NamedTuple):
    """A point, and the local models of all stretches there in physical coordinates."""

    point: Floats  # of the first stretch
    pieces: Pieces
    left_q: Floats  # (n, 3) residuals in sd
    left_w: Floats
    left_v: Floats


class Ended(NamedTuple):
    """How a descent ended."""

    cost: float
    converged: bool  # the step promises to lower twice the cost by less than is tolerated
    evaluations: int
    damping: float  # with which it goes on, and by what that grows
    growth: float


@part
def stop_at_commands(posed: Posed, point: Floats, out: Floats) -> None:
    """Write the known inputs with the masses where they really are."""
    first = KNOWN_D + posed.maps.shape[0]
    for i in range(out.shape[0] if posed.owners.shape[0] else 0):
        for c in range(KNOWN_D, first):
            out[i, c] = posed.known[i, c]
        for j in range(posed.owners.shape[0]):
            mass, error = posed.owners[j, 0], posed.owners[j, 1]
            out[i, KNOWN_D + mass] += point[ERROR + error] * posed.known[i, first + j]


@part
def by_com(column: int, mass: float) -> float:
    """Return d(first moment)/d(com) for a column of com, 1 for any other."""
    return mass if R <= column < BEHIND else 1.0


@part
def unpack(work: Pass, mass: float, normal: Floats, descent: Floats) -> bool:
    """Write A and b of the data by com instead of first moment; say whether all is finite."""
    lanes, check = work.descent.shape[0], 0.0
    for a in range(work.normal.shape[0] // lanes):
        scale = by_com(a, mass)
        descent[a] = scale * work.descent[a]
        for b in range(a + 1):
            value = scale * by_com(b, mass) * work.normal[a * lanes + b]
            normal[a, b], normal[b, a] = value, value
            check += value
    return bool(np.isfinite(check))


@part
def arrive(
    mass: float, body: Body, inputs: Inputs, node: int, work: Pass, phi: Floats, here: Floats
) -> None:
    """Write attitude and rate at a node, as the step that ends there sees them, and Phi."""
    y, fb = work.y, work.step.fb
    i, share = step_behind(node)
    now = body_at(body, inputs.maps, inputs.t, inputs.known, i, share)
    w, _ = evaluate(body, now, inputs, i, share, y, work.step)
    for j in range(4):
        here[j] = y[j]
    for j in range(3):
        here[W + j] = w[j]
    for c in range(inputs.columns.kinds.shape[0]):
        scale, i = by_com(c, mass), place(c)
        k = ROWS + i
        dw = times(now.inverse, (y[k + 3 * LANES] - fb[i], y[k + 4 * LANES] - fb[i + LANES],
                                 y[k + 5 * LANES] - fb[i + 2 * LANES]))  # fmt: skip
        for j in range(3):
            phi[j, c] = scale * y[k + j * LANES]
            phi[3 + j, c] = scale * dw[j]


@part
def jump(posed: Posed, k: int, jumps: Floats, step: Floats, here: Floats, out: Floats) -> None:
    """Write the point behind inner cut k from the one before it."""
    step[:] = 0.0
    for i in range(count_free(posed.cuts.free[k])):
        step[posed.cuts.free[k, i]] = jumps[k, i]
    retract(here, step, posed.mass, posed.slots, out)


@part
def along_part(
    posed: Posed, body: Body, known: Floats, p: int, here: Floats, rows: tuple[int, int, int],
    at: Local, share: Share,
) -> tuple[float, int, int, int, bool]:  # fmt: skip
    """Sum a part into the arrays of ``share``, and write the state at its end into ``here``.

    Return half the cost, the first rows of what follows, and whether all is finite.
    """
    parts, sensor, bias = posed.parts, here[SENSOR:ERROR], here[-3:]
    columns, _ = columns_within(parts, p)
    m, total = columns.kinds.shape[0], posed.columns.kinds.shape[0]
    inputs = Inputs(posed.maps, posed.t, known, posed.owners, columns, groups_of(columns))
    work = narrowed(share.own, m, m + posed.slots.shape[0] - total)
    q0, w0, nodes = here[:W], here[W : W + 3], (parts.nodes[p], parts.nodes[p + 1])
    cost, iq, iw, iv = accumulate(body, inputs, q0, w0, sensor, bias, posed.observed, posed.limit,
                                  nodes, rows, work, at.left_q, at.left_w, at.left_v)  # fmt: skip
    finite = unpack(work, posed.mass, share.square, share.right)
    arrive(posed.mass, body, inputs, nodes[1], work, share.phi, here)
    return cost, iq, iw, iv, finite


@part
def along_stretch(
    posed: Posed, known: Floats, k: int, here: Floats, rows: tuple[int, int, int], at: Local,
    share: Share,
) -> tuple[float, int, int, int, bool]:  # fmt: skip
    """Write the local model of a stretch that begins at ``here``, which is its end then."""
    parts, total, pieces = posed.parts, posed.columns.kinds.shape[0], at.pieces
    normal, descent = pieces.normal[k], pieces.descent[k]
    errors_at = total - count_errors(posed.columns)
    body, cost, finite = body_at_point(here, posed.mass, posed.gravity), 0.0, True
    iq, iw, iv = rows
    normal[:], descent[:] = 0.0, 0.0
    begin_stretch(share)
    for p in range(parts.stretch[k], parts.stretch[k + 1]):
        of_part, iq, iw, iv, is_finite = along_part(posed, body, known, p, here, (iq, iw, iv), at,
                                                    share)  # fmt: skip
        cost, finite = cost + of_part, finite and is_finite
        _, places = columns_within(parts, p)
        nodes = (parts.nodes[p], parts.nodes[p + 1])
        begin_part(places, errors_at, share)
        lacking = express(known, posed.owners, posed.maps, nodes, posed.mass, errors_at, share)
        add_part(places, total, lacking, share, normal, descent)
        pass_on(places, total, lacking, share)
    return cost, iq, iw, iv, finite


@part
def search_along(
    posed: Posed, known: Floats, at: Local, share: Share, step: Floats, here: Floats, behind: Floats
) -> float:
    """Write the local models of all stretches, and return half the cost of data and jumps.

    Infinite where the motion is no number. ``step``, ``here`` and ``behind`` are worked in.
    """
    cuts, pieces, finite = posed.cuts, at.pieces, True
    cost, iq, iw, iv, last = jump_cost(cuts, pieces.jumps), 0, 0, 0, cuts.free.shape[0]
    copy_values(at.point, here)
    for k in range(last + 1):
        if k > 0:
            jump(posed, k - 1, pieces.jumps, step, here, behind)
            copy_values(behind, here)
        copy_values(here, pieces.points[k])
        of_data, iq, iw, iv, is_finite = along_stretch(posed, known, k, here, (iq, iw, iv), at,
                                                       share)  # fmt: skip
        cost, finite = cost + of_data, finite and is_finite
        if k < last:
            copy_rows(share.onward, pieces.onward[k])
    return cost if finite else np.inf


@part
def prior_cost(posed: Posed, x: Floats) -> float:
    """Return the priors' part of the cost."""
    cost = 0.0
    for k in range(x.shape[0]):
        off = posed.mean[k] - x[k]
        cost += 0.5 * posed.weight[k] * off * off
    return cost


@part
def add_priors(posed: Posed, x: Floats, chain: Chain) -> None:
    """Add the priors to A and b, and keep what is held."""
    normal, descent, n = chain.normal, chain.descent, x.shape[0]
    for k in range(n):
        normal[k, k] += posed.weight[k]
        descent[k] += posed.weight[k] * (posed.mean[k] - x[k])
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


@kernel
def local_for(posed: Posed, point: Floats) -> Local:
    """Return a point with room for the local models there."""
    n_q, n_w = posed.observed.attitude.shape[0], posed.observed.rate.shape[0]
    n_v = posed.observed.vectors.values.shape[0]
    pieces = pieces_for(posed.cuts, posed.slots.shape[0], point.shape[0])
    return Local(point.copy(), pieces, np.zeros((n_q, 3)), np.zeros((n_w, 3)),
                 np.zeros((n_v, 3)))  # fmt: skip


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
