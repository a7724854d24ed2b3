"""Normal equations of the trajectory residuals, in one compiled pass along the record.

    e_q = log( q_pred^-1 (x) q_meas ) / sd,      de_q/dp = -dth/dp / sd
    e_w = ( w_meas - w_pred - b ) / sd,          de_w/dp = -dw/dp / sd,  de_w/db = -1 / sd

The attitude residual is the rotation vector from prediction to measurement, in body axes: it keeps
the sign that Ivanov 2021 Eq. 3.1 loses by squaring quaternion differences. With equal noise about
all axes its gradient is exact although the Jacobian leaves out terms in e_q itself.

Robust: a residual vector longer than ``limit`` counts linearly (Huber), not with its square.
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.propagation import (
    Columns,
    interpolate,
    look,
    rate_sensitivity,
    slope_at,
    start,
    steady,
    step_from,
)
from equipoise.dynamics.regressor import WIDTH, Triple
from equipoise.dynamics.rigid_body import ROWS, Body
from equipoise.maths.compiled import kernel, part
from equipoise.maths.local_motion import turn
from equipoise.model.arrays import Floats, Ints


class Seen(NamedTuple):
    """What the sensors reported, and at which nodes of the timeline."""

    attitude: Floats  # (n_q, 4)
    attitude_node: Ints
    attitude_share: Floats  # of the step behind the node
    attitude_sd: float  # rad
    rate: Floats  # (n_w, 3) rad/s
    rate_node: Ints
    rate_share: Floats
    rate_sd: float  # rad/s


@part
def huber(e: Triple, limit: float) -> tuple[float, float]:
    """Return weight and half-square cost of a residual vector; ``limit`` 0 means least squares."""
    square = e[0] * e[0] + e[1] * e[1] + e[2] * e[2]
    if limit <= 0 or square <= limit * limit:
        return 1.0, 0.5 * square
    size = square**0.5
    return limit / size, limit * (size - 0.5 * limit)


@part
def add_row(S: Floats, e: Triple, weight: float, normal: Floats, descent: Floats) -> None:
    """Add three rows of sensitivities S, already in units of the noise, and their residual."""
    for a in range(S.shape[1]):
        s0, s1, s2 = weight * S[0, a], weight * S[1, a], weight * S[2, a]
        descent[a] += s0 * e[0] + s1 * e[1] + s2 * e[2]
        for b in range(a + 1):
            normal[a, b] += s0 * S[0, b] + s1 * S[1, b] + s2 * S[2, b]


@part
def attitude_rows(y: Floats, q: Floats, sd: float, n: int, S: Floats) -> Triple:
    """Return e_q and write dth/dp / sd."""
    e, scale = turn(y, q), 1.0 / sd
    for j in range(3):
        for c in range(S.shape[1]):
            S[j, c] = scale * y[ROWS + j * n + c] if c < n else 0.0
    return (scale * e[0], scale * e[1], scale * e[2])


@part
def rate_rows(w: Triple, bias: Floats, seen: Floats, sd: float, n: int, S: Floats) -> Triple:
    """Return e_w and bring dw/dp in S to units of the noise; the last columns are the bias."""
    scale = 1.0 / sd
    for j in range(3):
        for c in range(S.shape[1]):
            S[j, c] = scale * S[j, c] if c < n else scale * (c - n == j)
    return (
        scale * (seen[0] - w[0] - bias[0]),
        scale * (seen[1] - w[1] - bias[1]),
        scale * (seen[2] - w[2] - bias[2]),
    )


@part
def weigh(
    e: Triple, limit: float, S: Floats, normal: Floats, descent: Floats, left: Floats
) -> float:
    """Add a residual to the normal equations, keep it, and return its half-square cost."""
    left[0], left[1], left[2] = e
    weight, cost = huber(e, limit)
    add_row(S, e, weight, normal, descent)
    return cost


@kernel
def accumulate(
    body: Body,
    maps: Floats,
    t: Floats,
    known: Floats,
    owners: Ints,
    columns: Columns,
    q0: Floats,
    w0: Floats,
    bias: Floats,
    seen: Seen,
    limit: float,
    normal: Floats,
    descent: Floats,
    left_q: Floats,
    left_w: Floats,
) -> float:
    """Add to the normal equations, write the residuals in units of sd, return half the cost."""
    n, last = columns.kinds.shape[0], t.shape[0] - 2
    m = ROWS + 6 * n
    y, y0, dy0, dy1 = np.empty(m), np.empty(m), np.empty(m), np.empty(m)
    at, dy, total = np.empty(m), np.empty(m), np.empty(m)
    regress, fb, S = np.zeros((3, WIDTH)), np.zeros((6, n)), np.zeros((3, normal.shape[0]))
    attitude, rate = seen.attitude, seen.rate
    q_node, w_node, q_share, w_share = (seen.attitude_node, seen.rate_node, seen.attitude_share,
                                        seen.rate_share)  # fmt: skip
    start(body, maps, t, known, owners, columns, q0, w0, y, regress, fb)
    cost, iq, iw = 0.0, 0, 0
    for i in range(last + 1):
        if i == 0 or not (steady(known, i - 1) and steady(known, i)):
            slope_at(body, maps, t, known, owners, columns, i, 0.0, y, regress, fb, dy1)
        for j in range(m):
            y0[j], dy0[j] = y[j], dy1[j]
        step_from(body, maps, t, known, owners, columns, i, y, dy0, regress, fb, at, dy, total)
        slope_at(body, maps, t, known, owners, columns, i, 1.0, y, regress, fb, dy1)
        h = t[i + 1] - t[i]
        while iq < q_node.shape[0] and (q_node[iq] == i or i == last):
            share = q_share[iq] if q_node[iq] == i else 1.0
            interpolate(y0, dy0, y, dy1, h, share, at)
            e = attitude_rows(at, attitude[iq], seen.attitude_sd, n, S)
            cost += weigh(e, limit, S, normal, descent, left_q[iq])
            iq += 1
        while iw < w_node.shape[0] and (w_node[iw] == i or i == last):
            share = w_share[iw] if w_node[iw] == i else 1.0
            interpolate(y0, dy0, y, dy1, h, share, at)
            now, w, _ = look(body, maps, t, known, owners, columns, i, share, at, regress, fb)
            rate_sensitivity(now, at, fb, S)
            e = rate_rows(w, bias, rate[iw], seen.rate_sd, n, S)
            cost += weigh(e, limit, S, normal, descent, left_w[iw])
            iw += 1
    return cost
