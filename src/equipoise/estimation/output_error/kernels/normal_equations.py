"""Normal equations of the trajectory residuals, in one compiled pass along the record.

    e_q = log( q_said^-1 (x) q_meas ) / sd,      de_q/dp = -dth/dp / sd
    e_w = ( w_meas - w_said ) / sd,              de_w/dp = -(E + M) dw/dp / sd,  de_w/db = -1 / sd
                                                 de_w/dc = (E + M) (t - t0) w' / sd
    e_v = ( v_meas - v_said ) / sd               of sensors of vectors, see ``vector_rows``

q_said and w_said are what ``sensors.camera`` and ``sensors.gyro`` make of the attitude and rate.

The attitude residual is the rotation vector from prediction to measurement, in body axes: it keeps
the sign that Ivanov 2021 Eq. 3.1 loses by squaring quaternion differences. With equal noise about
all axes its gradient is exact although the Jacobian leaves out terms in e_q itself.

A record is summed stretch by stretch: each begins at a state of its own.

Robust: a residual vector longer than ``limit`` counts linearly (Huber), not with its square.
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.propagation import (
    advance,
    evaluate,
    hermite,
    interpolate,
    slope,
    start,
    steady,
)
from equipoise.dynamics.regressor import WIDTH
from equipoise.dynamics.rigid_body import (
    ROWS,
    Body,
    Now,
    body_at,
    body_within,
    drifts,
    motion,
    rate_of,
    times,
)
from equipoise.dynamics.sensitivities import BLOCK, LANES, SPAN, Inputs, Work, dot, room_for, spot
from equipoise.estimation.output_error.kernels.vector_rows import (
    Vectors,
    acceleration_columns,
    by_turning,
    error_columns,
    is_aside,
    mounted,
    mounted_columns,
    mounting_of,
    plus,
    row_at,
    turn_columns,
    vector_in_body,
    vector_residual,
)
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.turns import to_body, turn
from equipoise.model.arrays import Floats, Ints, Nine, Six, Triple
from equipoise.sensors.camera import CLOCK, DELAY, column, less_cross, said, seeing
from equipoise.sensors.gyro import entry, gyro_matrix


class Measurements(NamedTuple):
    """What the sensors reported, and at which nodes of the timeline."""

    attitude: Floats  # (n_q, 4)
    attitude_node: Ints
    attitude_share: Floats  # of the step behind the node
    attitude_sd: float  # rad
    attitude_spread: float  # s^2, variance of the moments of which a row is the mean
    rate: Floats  # (n_w, 3) rad/s
    rate_node: Ints
    rate_share: Floats
    rate_sd: float  # rad/s
    rate_spread: float  # s^2
    forward: Triple  # body axis whose heading counts
    terms: Ints  # coefficients of the sensors that are sought
    vectors: Vectors


@part
def huber(e: Triple, limit: float) -> tuple[float, float]:
    """Return weight and half-square cost of a residual vector; ``limit`` 0 means least squares."""
    square = e[0] * e[0] + e[1] * e[1] + e[2] * e[2]
    if limit <= 0 or square <= limit * limit:
        return 1.0, 0.5 * square
    size = square**0.5
    return limit / size, limit * (size - 0.5 * limit)


class Pass(NamedTuple):
    """Arrays that a pass works in, and its sums; made once."""

    y: Floats  # state and sensitivities
    y0: Floats
    dy0: Floats
    dy1: Floats
    step: Work
    S_q: Floats  # three rows of sensitivities, in blocks of LANES columns
    S_w: Floats
    S_v: Floats
    normal: Floats  # (unknowns lanes,), row by row, the lower triangle
    descent: Floats  # (lanes,)


@kernel
def pass_for(columns: int, unknowns: int) -> Pass:
    """Return the arrays for so many sensitivities and unknowns."""
    m, lanes = ROWS + room_for(columns), (unknowns + LANES - 1) // LANES * LANES
    return Pass(
        np.empty(m), np.empty(m), np.empty(m), np.empty(m),
        Work(np.empty(m), np.empty(m), np.empty(m), np.zeros((3, WIDTH)), np.zeros(m - ROWS)),
        np.zeros(3 * lanes), np.zeros(3 * lanes), np.zeros(3 * lanes), np.zeros(unknowns * lanes),
        np.zeros(lanes),
    )  # fmt: skip


@part
def narrowed(work: Pass, columns: int, unknowns: int) -> Pass:
    """Return the arrays for fewer sensitivities and unknowns, and bring to zero what must be."""
    m, lanes = ROWS + room_for(columns), (unknowns + LANES - 1) // LANES * LANES
    step = work.step
    step.fb[:], work.S_q[:], work.S_w[:], work.S_v[:] = 0.0, 0.0, 0.0, 0.0
    work.normal[:], work.descent[:] = 0.0, 0.0
    return Pass(
        work.y[:m], work.y0[:m], work.dy0[:m], work.dy1[:m],
        Work(step.at[:m], step.dy[:m], step.total[:m], step.regress, step.fb[: m - ROWS]),
        work.S_q[: 3 * lanes], work.S_w[: 3 * lanes], work.S_v[: 3 * lanes],
        work.normal[: unknowns * lanes], work.descent[:lanes],
    )  # fmt: skip


@part
def add_row(S: Floats, e: Triple, weight: float, normal: Floats, descent: Floats) -> None:
    """Add three rows of sensitivities S, already in units of the noise, and their residual."""
    lanes = descent.shape[0]
    # a count that the compiler does not know: a short known loop it writes out, one by one
    width = min(LANES, lanes)
    for first in range(0, lanes, LANES):
        x, sums = S[3 * first : 3 * first + SPAN], descent[first : first + LANES]
        for c in range(width):
            sums[c] += weight * (e[0] * x[c] + e[1] * x[c + LANES] + e[2] * x[c + 2 * LANES])
    for a in range(normal.shape[0] // lanes):
        i, row = spot(a), normal[a * lanes : (a + 1) * lanes]
        s0, s1, s2 = weight * S[i], weight * S[i + LANES], weight * S[i + 2 * LANES]
        for first in range(0, a + 1, LANES):
            x, sums = S[3 * first : 3 * first + SPAN], row[first : first + LANES]
            for c in range(width):
                sums[c] += s0 * x[c] + s1 * x[c + LANES] + s2 * x[c + 2 * LANES]


@part
def turn_rows(work: Pass, h: float, share: float, spread: float, scale: float, S: Floats) -> None:
    """Write dth/dp within a step of h seconds, times ``scale``."""
    a, b, c, d = hermite(h, share, spread)
    a, b, c, d = scale * a, scale * b, scale * c, scale * d
    for k in range(work.step.fb.shape[0] // BLOCK):
        i, S_k = ROWS + k * BLOCK, S[k * SPAN : (k + 1) * SPAN]
        y0, dy0 = work.y0[i : i + SPAN], work.dy0[i : i + SPAN]
        y1, dy1 = work.y[i : i + SPAN], work.dy1[i : i + SPAN]
        for j in range(SPAN):
            S_k[j] = a * y0[j] + b * dy0[j] + c * y1[j] + d * dy1[j]


@part
def camera_rows(
    data: Measurements, sensor: Floats, w: Triple, n: int, scale: float, q: Floats, S: Floats
) -> None:
    """Turn q into what the camera says, and the rows behind n columns into those of q_said."""
    for j in range(data.terms.shape[0]):
        if data.terms[j] == DELAY:
            i = spot(n + j)
            S[i], S[i + LANES], S[i + 2 * LANES] = -scale * w[0], -scale * w[1], -scale * w[2]
    now = seeing(q, data.forward, sensor)
    along, by_turn = less_cross(now.by_heading, now.turn, 0.5), to_body(q, now.heading_by_turn)
    for c in range(n + data.terms.shape[0]):
        i = spot(c)
        x = (S[i], S[i + LANES], S[i + 2 * LANES])
        size = x[0] * by_turn[0] + x[1] * by_turn[1] + x[2] * by_turn[2]
        x = less_cross(x, now.turn, 1.0)
        S[i] = x[0] + size * along[0]
        S[i + LANES] = x[1] + size * along[1]
        S[i + 2 * LANES] = x[2] + size * along[2]
    for j in range(data.terms.shape[0]):
        if data.terms[j] < DELAY:
            i, x = spot(n + j), column(data.terms[j], q, sensor, now)
            S[i], S[i + LANES], S[i + 2 * LANES] = scale * x[0], scale * x[1], scale * x[2]
    q[0], q[1], q[2], q[3] = said(q, sensor, now.turn)


@part
def rate_rows(
    inverse: Six, y: Floats, fb: Floats, w: Triple, late: Triple, by: Nine, data: Measurements,
    scale: float, n: int, S: Floats,
) -> None:  # fmt: skip
    """Write (E + M) dw/dp of n columns, dw = J^-1 (dH - f), and w and b behind them, scaled.

    ``late``: what the rate changes by a clock that is fast by one.
    """
    for k in range(fb.shape[0] // BLOCK):
        S_k, f = S[k * SPAN : (k + 1) * SPAN], fb[k * BLOCK : (k + 1) * BLOCK]
        dH = y[ROWS + k * BLOCK + SPAN : ROWS + (k + 1) * BLOCK]
        for c in range(LANES):
            x = (dH[c] - f[c], dH[c + LANES] - f[c + LANES], dH[c + 2 * LANES] - f[c + 2 * LANES])
            dw = dot(by, times(inverse, x))
            S_k[c], S_k[c + LANES] = scale * dw[0], scale * dw[1]
            S_k[c + 2 * LANES] = scale * dw[2]
    for j in range(data.terms.shape[0]):
        row, other = entry(data.terms[j])
        if row >= 0:
            size = w[0] if other == 0 else (w[1] if other == 1 else w[2])
            S[spot(n + j) + row * LANES] = scale * size
        elif data.terms[j] == CLOCK:
            i, x = spot(n + j), dot(by, late)
            S[i], S[i + LANES], S[i + 2 * LANES] = scale * x[0], scale * x[1], scale * x[2]
    for j in range(3):
        S[spot(n + data.terms.shape[0] + j) + j * LANES] = scale


@part
def weigh(e: Triple, limit: float, S: Floats, work: Pass, left: Floats) -> float:
    """Add a residual to the normal equations, keep it, and return its half-square cost."""
    left[0], left[1], left[2] = e
    weight, cost = huber(e, limit)
    add_row(S, e, weight, work.normal, work.descent)
    return cost


@part
def see_attitude(
    work: Pass, data: Measurements, sensor: Floats, now: Now, h: float, share: float, n: int,
    row: int, limit: float, left: Floats,
) -> float:  # fmt: skip
    """Add a row of the camera, measured within a step; return its cost."""
    sensing = data.terms.shape[0] > 0
    scale, spread = 1.0 / data.attitude_sd, data.attitude_spread
    at = share - sensor[DELAY] / h
    q = work.step.at[:ROWS]
    interpolate(work.y0, work.dy0, work.y, work.dy1, h, at, spread, q)
    turn_rows(work, h, at, spread, scale, work.S_q)
    if sensing:
        camera_rows(data, sensor, rate_of(now, q), n, scale, q, work.S_q)
    e = turn(q, data.attitude[row])
    return weigh((scale * e[0], scale * e[1], scale * e[2]), limit, work.S_q, work, left)


@part
def see_rate(
    work: Pass, now: Now, by: Nine, w: Triple, late: Triple, bias: Floats, data: Measurements,
    row: int, n: int, limit: float, left: Floats,
) -> float:  # fmt: skip
    """Add a row of the gyro, the state and the forcing being those of its time; return its cost."""
    scale, x, r = 1.0 / data.rate_sd, dot(by, w), data.rate[row]
    rate_rows(now.inverse, work.step.at, work.step.fb, w, late, by, data, scale, n, work.S_w)
    e = (
        scale * (r[0] - x[0] - bias[0]),
        scale * (r[1] - x[1] - bias[1]),
        scale * (r[2] - x[2] - bias[2]),
    )
    return weigh(e, limit, work.S_w, work, left)


@part
def see_vector(
    work: Pass, body: Body, now: Now, inputs: Inputs, i: int, share: float, w: Triple, g: Triple,
    data: Measurements, sensor: Floats, row: int, limit: float, left: Floats,
) -> float:  # fmt: skip
    """Add a row of a sensor of a vector, as ``see_rate`` does with one of the gyro."""
    vectors, step, S, n = data.vectors, work.step, work.S_v, inputs.columns.kinds.shape[0]
    k = int(vectors.sensor[row])
    p, u, scale = (row_at(vectors.place, k), vector_in_body(vectors, row, step.at),
                   1.0 / float(vectors.sd[k]))  # fmt: skip
    turn_columns(u, n, scale, step.at, S)
    if is_aside(p):
        slope(body, now, w, g, step.at, step, step.dy)
        turning = acceleration_columns(now, inputs, i, share, p, w, step, scale, S)
        u = plus(u, by_turning(p, w, turning))
    m = mounting_of(vectors, k, sensor)
    if vectors.mounting[k] >= 0:
        mounted_columns(m, n, S)
    error_columns(vectors, k, data.terms, m, u, n, scale, S)
    said = mounted(m, u)
    return weigh(vector_residual(vectors, row, sensor, said, scale), limit, S, work, left)


@part
def lateness(
    body: Body, now: Now, w: Triple, g: Triple, age: float, data: Measurements, step: Work
) -> Triple:
    """Return -(t - t0) w', w' = J^-1 H' but for what travels; zero where no clock is sought."""
    sought = False
    for j in range(data.terms.shape[0]):
        sought |= data.terms[j] == CLOCK
    if not sought:
        return (0.0, 0.0, 0.0)
    motion(body, now, step.at, w, g, step.regress, step.dy)
    a = times(now.inverse, (step.dy[4], step.dy[5], step.dy[6]))
    return (-age * a[0], -age * a[1], -age * a[2])


@part
def step_behind(node: int) -> tuple[int, float]:
    """Return the step that ends at a node, and its share there: all; the first step has none."""
    return (node - 1, 1.0) if node > 0 else (node, 0.0)


@part
def accumulate(
    body: Body, inputs: Inputs, q0: Floats, w0: Floats, sensor: Floats, bias: Floats,
    data: Measurements, limit: float, stretch: tuple[int, int], rows: tuple[int, int, int],
    work: Pass, left_q: Floats, left_w: Floats, left_v: Floats,
) -> tuple[float, int, int, int]:  # fmt: skip
    """Sum the normal equations of the steps from one node to another (``stretch``).

    The state at the first is as the step that ends there sees it. ``rows`` are the first rows of
    camera, gyro and vectors from there on. Write the residuals in units of sd; return half the cost
    and the first rows of what follows. ``work.y`` is left at the end.
    """
    (maps, t, known, _, columns), (y, y0, dy0, dy1, step) = inputs[:5], work[:5]
    n, last = columns.kinds.shape[0], t.shape[0] - 2
    q_node, w_node, q_share, w_share = (data.attitude_node, data.rate_node, data.attitude_share,
                                        data.rate_share)  # fmt: skip
    cost, moving, was_steady, by = 0.0, drifts(body), False, gyro_matrix(sensor)
    v_node, v_share = data.vectors.node, data.vectors.share
    iq, iw, iv = rows
    first, since = step_behind(stretch[0])
    start(body, body_at(body, maps, t, known, first, since), inputs, first, since, q0, w0, y, step)
    for i in range(stretch[0], stretch[1]):
        is_steady = steady(known, i)
        fixed, here = is_steady and not moving, body_at(body, maps, t, known, i, 0.0)
        sloped, was_steady, h = was_steady and is_steady, is_steady, t[i + 1] - t[i]
        now = advance(body, here, fixed, sloped, inputs, i, y, (y0, dy0, dy1), step)
        while iq < q_node.shape[0] and (q_node[iq] == i or i == last):
            share = q_share[iq] if q_node[iq] == i else 1.0
            cost += see_attitude(work, data, sensor, now, h, share, n, iq, limit, left_q[iq])
            iq += 1
        while iw < w_node.shape[0] and (w_node[iw] == i or i == last):
            share = w_share[iw] if w_node[iw] == i else 1.0
            age = t[i] - t[0] + share * h
            at = share - sensor[CLOCK] * age / h
            interpolate(y0, dy0, y, dy1, h, at, data.rate_spread, step.at)
            now = body_within(body, maps, t, known, i, share, fixed, here)
            w, g = evaluate(body, now, inputs, i, share, step.at, step)
            late = lateness(body, now, w, g, age, data, step)
            cost += see_rate(work, now, by, w, late, bias, data, iw, n, limit, left_w[iw])
            iw += 1
        while iv < v_node.shape[0] and (v_node[iv] == i or i == last):
            share = v_share[iv] if v_node[iv] == i else 1.0
            interpolate(y0, dy0, y, dy1, h, share, 0.0, step.at)
            now = body_within(body, maps, t, known, i, share, fixed, here)
            w, g = evaluate(body, now, inputs, i, share, step.at, step)
            cost += see_vector(work, body, now, inputs, i, share, w, g, data, sensor, iv, limit,
                               left_v[iv])  # fmt: skip
            iv += 1
    return cost, iq, iw, iv
