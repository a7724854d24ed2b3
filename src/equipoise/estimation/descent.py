"""The descent of the trajectory fit as one compiled kernel: from a first point to the optimum.

    cost = 1/2 sum |e|^2 + 1/2 sum weight (mean - x)^2,      A = S^T S + weight,
    b = S^T e + weight (mean - x)

in physical coordinates x. The propagator's columns are by first moment, m times com. A held
coordinate has no row and no column in A but its own, and does not move.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.dynamics.propagation import Columns
from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.estimation.normal_equations import Pass, Seen, accumulate, pass_for
from equipoise.estimation.point_steps import (
    BEHIND,
    ERROR,
    R,
    StepWork,
    W,
    body_at_point,
    coordinates_of,
    possible_step,
    retract,
    step_work_for,
)
from equipoise.maths.compiled import kernel, part
from equipoise.maths.levenberg_marquardt import FIRST, FREE, NEAR, judge, promise, tolerated
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
    seen: Seen
    limit: float  # Huber's, in sd; 0: none
    mean: Floats  # of the priors
    weight: Floats
    held: NDArray[np.bool_]
    slots: Ints  # where a point keeps each coordinate


class Local(NamedTuple):
    """A point, and the local model there in physical coordinates."""

    point: Floats
    normal: Floats
    descent: Floats
    left_q: Floats  # (n, 3) residuals in sd
    left_w: Floats


class Ended(NamedTuple):
    """How a descent ended."""

    cost: float
    converged: bool  # the step promises to lower twice the cost by less than is tolerated
    evaluations: int


@part
def stop_where_told(posed: Posed, point: Floats, out: Floats) -> None:
    """Write the known inputs with the masses where they really stop."""
    first = KNOWN_D + posed.maps.shape[0]
    for i in range(out.shape[0] if posed.owners.shape[0] else 0):
        for c in range(KNOWN_D, first):
            out[i, c] = posed.known[i, c]
        for j in range(posed.owners.shape[0]):
            out[i, KNOWN_D + posed.owners[j]] += point[ERROR + j] * posed.known[i, first + j]


@part
def unpack(work: Pass, mass: float, out: Local) -> bool:
    """Write A and b of the data by com instead of first moment; say whether all is finite."""
    n, finite = out.descent.shape[0], True
    for a in range(n):
        scale = mass if R <= a < BEHIND else 1.0
        out.descent[a] = scale * work.descent[a]
        for b in range(a + 1):
            value = scale * (mass if R <= b < BEHIND else 1.0) * work.normal[a, b]
            out.normal[a, b], out.normal[b, a] = value, value
            finite &= bool(np.isfinite(value))
    return finite


@part
def add_priors(posed: Posed, x: Floats, out: Local) -> float:
    """Add the priors to A and b, keep what is held; return their part of the cost."""
    cost, n = 0.0, x.shape[0]
    for k in range(n):
        off = posed.mean[k] - x[k]
        cost += 0.5 * posed.weight[k] * off * off
        out.normal[k, k] += posed.weight[k]
        out.descent[k] += posed.weight[k] * off
    for k in range(n):
        if posed.held[k]:
            for j in range(n):
                out.normal[k, j], out.normal[j, k] = 0.0, 0.0
            out.descent[k] = 0.0
            out.normal[k, k] = (HELD * max(abs(posed.mean[k]), 1e-9)) ** -2
    return cost


@part
def nowhere(out: Local) -> None:
    """Write a local model that says nothing."""
    out.normal[:], out.descent[:] = 0.0, 0.0
    for k in range(out.descent.shape[0]):
        out.normal[k, k] = 1.0


@part
def local_model(posed: Posed, cost: float, work: Pass, x: Floats, out: Local) -> float:
    """Write the local model of data and priors and return its cost; infinite where there is none.

    ``cost`` and ``work`` are those of the data.
    """
    if not (unpack(work, posed.mass, out) and np.isfinite(cost)):
        nowhere(out)
        return np.inf
    coordinates_of(out.point, posed.mass, posed.slots, x)
    return cost + add_priors(posed, x, out)


@part
def copy_rows(source: Floats, out: Floats) -> None:
    """Write a matrix into another."""
    for i in range(source.shape[0]):
        for j in range(source.shape[1]):
            out[i, j] = source[i, j]


@part
def keep(trial: Local, best: Local) -> None:
    """Make the trial the best."""
    for k in range(best.point.shape[0]):
        best.point[k] = trial.point[k]
    for k in range(best.descent.shape[0]):
        best.descent[k] = trial.descent[k]
    copy_rows(trial.normal, best.normal)
    copy_rows(trial.left_q, best.left_q)
    copy_rows(trial.left_w, best.left_w)


@kernel  # not a part: it is called twice, and need not be compiled twice
def propose(
    mass: float, slots: Ints, best: Local, damping: float, work: StepWork, step: Floats,
    point: Floats,
) -> float:  # fmt: skip
    """Write the next point to look at for a damping, and return its promise."""
    possible_step(best.point, mass, best.normal, best.descent, damping, work, step)
    retract(best.point, step, mass, slots, point)
    return promise(best.normal, best.descent, step)


@kernel
def descend(posed: Posed, best: Local, rows: int, most: int) -> Ended:
    """Go from ``best.point`` to the optimum, in place, in at most so many evaluations.

    ``rows`` is the number of residuals. With one evaluation this is the local model at a point.
    """
    n, mass, slots = best.descent.shape[0], posed.mass, posed.slots
    point = best.point.copy()
    trial = Local(point, np.empty((n, n)), np.empty(n), np.empty_like(best.left_q),
                  np.empty_like(best.left_w))  # fmt: skip
    known = posed.known.copy() if posed.owners.shape[0] else posed.known
    work, step_work = pass_for(posed.columns.kinds.shape[0], n), step_work_for(n)
    step, x = np.empty(n), np.empty(n)
    q0, w0, bias = point[:W], point[W : W + 3], point[point.shape[0] - 3 :]
    cost, damping, growth, promised = np.inf, FIRST, 2.0, np.inf
    evaluations = 0
    while evaluations < most:
        evaluations += 1
        stop_where_told(posed, point, known)
        of_data = accumulate(
            body_at_point(point, mass, posed.gravity), posed.maps, posed.t, known, posed.owners,
            posed.columns, q0, w0, bias, posed.seen, posed.limit, work, trial.left_q, trial.left_w,
        )  # fmt: skip
        there = local_model(posed, of_data, work, x, trial)
        taken = True
        if evaluations > 1:
            taken, damping, growth = judge(2.0 * (cost - there), promised, damping, growth)
        if taken:
            keep(trial, best)
            cost = there
        if not np.isfinite(cost) or evaluations == most:
            break
        promised, allowed = (propose(mass, slots, best, damping, step_work, step, point),
                             tolerated(cost, rows))  # fmt: skip
        if promised < allowed:
            if damping >= FREE:
                promised = propose(mass, slots, best, FREE, step_work, step, point)
            return Ended(cost, abs(promised) < NEAR * allowed, evaluations)
    return Ended(cost, False, evaluations)
