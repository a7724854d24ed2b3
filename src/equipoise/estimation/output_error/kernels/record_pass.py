"""One pass over a record in one compiled piece: the local models of all stretches at a point.

    normal_k = sum S^T S,      descent_k = sum S^T e,      of the rows of stretch k

in physical coordinates of the point in which the stretch begins, with Phi from its begin to its
end. The propagator's columns are by first moment, m times com. Each stretch is summed part by part
(``parts``), and begins where the one before it ends, plus its jump (``segments``).
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
)
from equipoise.estimation.output_error.kernels.segments import (
    Cuts,
    Pieces,
    count_free,
    jump_cost,
    pieces_for,
)
from equipoise.estimation.parameters.retraction import (
    BEHIND,
    ERROR,
    SENSOR,
    R,
    W,
    body_at_point,
    retract,
)
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.kernels.copying import copy_rows, copy_values
from equipoise.model.arrays import Floats, Ints


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
    coupling: Floats  # (9, 9) of J_P and com beside the weights; (0, 0): none
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


@kernel
def local_for(posed: Posed, point: Floats) -> Local:
    """Return a point with room for the local models there."""
    n_q, n_w = posed.observed.attitude.shape[0], posed.observed.rate.shape[0]
    n_v = posed.observed.vectors.values.shape[0]
    pieces = pieces_for(posed.cuts, posed.slots.shape[0], point.shape[0])
    return Local(point.copy(), pieces, np.zeros((n_q, 3)), np.zeros((n_w, 3)),
                 np.zeros((n_v, 3)))  # fmt: skip


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
