"""Carrying a belief over a step: Runge-Kutta of order 4 on q and H, errors with it.

    extended     Phi = E + dt/2 (F_0 + F_1) + dt^2/2 F_1 F_0,    P- = Phi P Phi^T + Q dt
    unscented    2n points x +- columns of L,  L L^T = n P,  each carried over the step and weighing
                 1/(2n); P- = sum of e e^T / (2n) + Q dt,  e = point - mean

F_0 and F_1 are F at both ends of the step. Of the simplified model F_1 F_0 is nought, and Phi the
trapezoid -(m T/2) J^-1 ([g_k x] + [g_k+1 x]) of the review's Eqs. 28 to 30 (R11, R12). Where the
attitude is an input g_B is a straight line between the nodes: the rate does not turn it.

Parameters are the same after a step as before, so their block of P is not touched but by the walk,
and only the rows of attitude and rate are worked out. Points of an attitude lie about it in
rotation vectors, and their mean is taken there (Simon's points; the error of the attitude is
multiplicative).

The belief has H, not w: H goes on steadily where a mass sets off, and w does not.
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.propagation import steady, to_unit
from equipoise.dynamics.regressor import WIDTH
from equipoise.dynamics.rigid_body import (
    Body,
    Now,
    Six,
    between,
    body_at,
    body_within,
    gravity_of,
    motion,
    rate_of,
    times,
)
from equipoise.estimation.filters.jacobian import change_of, write_jacobian
from equipoise.estimation.filters.model import Model
from equipoise.estimation.tracker_step import placed
from equipoise.maths.compiled import part
from equipoise.maths.turns import Triple, turn, turned
from equipoise.model.arrays import Floats

COM, INERTIA = 7, 10  # where they stand in a belief: q, H, com, J
NULL = 1e-14  # of a variance, chosen: what is left of it is rounding


class Drive(NamedTuple):
    """The grid of steps, and what is known at its nodes."""

    t: Floats  # (g,) s
    known: Floats  # (g, 6 + k) stored momentum, torque, displacements
    q: Floats  # (g, 4) the attitude, where it is an input; where it is seen, at rows
    stopped: Floats  # (g, 3, 3) m^2, what masses that stopped add to the covariance of r


class Work(NamedTuple):
    """Arrays that the steps work in, made once."""

    y: Floats  # (7,) q, H
    at: Floats
    dy: Floats
    total: Floats
    point: Floats  # (16,)
    regress: Floats  # (3, WIDTH)
    Y: Floats  # (3, 6)
    Z: Floats
    F0: Floats  # (6, n)
    F1: Floats
    D: Floats
    A: Floats
    L: Floats  # (n, n)
    E: Floats  # (2n, 6) errors of the points
    Q: Floats  # (2n, 4) their attitudes
    K: Floats  # (n, 3)
    left: Floats  # (n, 3)
    B: Floats  # (n, n)
    S: Floats  # (3, 3)
    inverse: Floats
    x: Floats  # (n,)


@part
def placed_at(model: Model, belief: Floats) -> Body:
    """Return the body with the centre of mass and the inertia of a belief."""
    return placed(model.body, belief[COM:])


@part
def gravity_at(model: Model, y: Floats, g0: Triple, g1: Triple, share: float) -> Triple:
    """Return g_B of the state, or of the input at ``share`` of a step."""
    if model.attitude:
        return gravity_of(y, model.body.gravity)
    return (between(g0[0], g1[0], share), between(g0[1], g1[1], share),
            between(g0[2], g1[2], share))  # fmt: skip


@part
def slope(
    model: Model, rigid: Body, now: Now, g: Triple, y: Floats, regress: Floats, dy: Floats
) -> None:
    """Write q' and H'; of the simplified model without w x H."""
    w = rate_of(now, y)
    if not model.gyroscopic:
        w = (0.0, 0.0, 0.0)
    motion(rigid, now, y, w, g, regress, dy)


@part
def stride(
    model: Model, drive: Drive, i: int, rigid: Body, ends: tuple[Now, Now], work: Work
) -> None:
    """Take work.y over step i, between the platforms at its ends."""
    t, h, y, at, dy, total = (drive.t, drive.t[i + 1] - drive.t[i], work.y, work.at, work.dy,
                              work.total)  # fmt: skip
    g0, g1 = (gravity_of(drive.q[i], model.body.gravity),
              gravity_of(drive.q[i + 1], model.body.gravity))  # fmt: skip
    still = steady(drive.known, i)
    middle = body_within(rigid, model.maps, t, drive.known, i, 0.5, still, ends[0])
    for j in range(7):
        at[j] = y[j]
        total[j] = 0.0
    for k in range(4):
        share, weight = 0.5 * ((k + 1) // 2), 1.0 if k in (0, 3) else 2.0
        ahead = h if k == 2 else 0.5 * h
        now = ends[0] if k == 0 else ends[1] if k == 3 else middle
        slope(model, rigid, now, gravity_at(model, at, g0, g1, share), at, work.regress, dy)
        for j in range(7):
            total[j] += weight * dy[j]
            at[j] = y[j] + ahead * dy[j]
    for j in range(7):
        y[j] += h / 6 * total[j]
    to_unit(y)


@part
def ends_of(model: Model, drive: Drive, i: int, rigid: Body) -> tuple[Now, Now]:
    """Return the platform at both ends of step i."""
    here = body_at(rigid, model.maps, drive.t, drive.known, i, 0.0)
    still = steady(drive.known, i)
    return here, body_within(rigid, model.maps, drive.t, drive.known, i, 1.0, still, here)


@part
def jacobian_at(
    model: Model, drive: Drive, i: int, rigid: Body, ends: tuple[Now, Now], last: int, work: Work
) -> None:
    """Write F at one end of step i, of the state in work.y, into F0 or F1."""
    now = ends[1] if last else ends[0]
    g = gravity_of(drive.q[i + last], model.body.gravity)
    g = gravity_at(model, work.y, g, g, 0.0)
    slope(model, rigid, now, g, work.y, work.regress, work.dy)
    push = (work.dy[4], work.dy[5], work.dy[6])
    change = change_of(ends[0], ends[1], drive.t[i + 1] - drive.t[i])
    F = work.F1 if last else work.F0
    write_jacobian(model, now, change, rate_of(now, work.y), push, g, work.Y, work.Z, F)


@part
def transition(dt: float, rows: int, work: Work) -> None:
    """Write D = Phi - E."""
    F0, F1, D = work.F0, work.F1, work.D
    n = D.shape[1]
    for i in range(rows):
        for j in range(n):
            D[i, j] = 0.5 * dt * (F0[i, j] + F1[i, j])
        for k in range(rows):
            share = 0.5 * dt * dt * F1[i, k]
            for j in range(n):
                D[i, j] += share * F0[k, j]


@part
def add_walks(model: Model, inverse: Six, dt: float, P: Floats) -> None:
    """Add Q dt: torque noise reaches the rate through J."""
    row = 3 if model.attitude else 0
    for k in range(3):
        e = times(inverse, (1.0 * (k == 0), 1.0 * (k == 1), 1.0 * (k == 2)))
        v = times(inverse, e)
        for j in range(3):
            P[row + j, row + k] += model.torque_walk**2 * dt * v[j]
    for j in range(row + 3, min(row + 6, P.shape[0])):
        P[j, j] += model.com_walk**2 * dt


@part
def ahead_of(rows: int, P: Floats, work: Work) -> None:
    """Write A = the first rows of Phi P."""
    D, A, n = work.D, work.A, P.shape[0]
    for i in range(rows):
        for j in range(n):
            A[i, j] = P[i, j]
        for k in range(n):
            d = D[i, k]
            for j in range(n):
                A[i, j] += d * P[k, j]


@part
def carry(rows: int, P: Floats, work: Work) -> None:
    """Write Phi P Phi^T in place; below its first rows Phi is the unit matrix."""
    D, A, n = work.D, work.A, P.shape[0]
    ahead_of(rows, P, work)
    for i in range(rows):
        for j in range(i + 1):
            total = A[i, j]
            for k in range(n):
                total += A[i, k] * D[j, k]
            P[i, j] = P[j, i] = total
        for j in range(rows, n):
            P[i, j] = P[j, i] = A[i, j]


@part
def write_back(model: Model, drive: Drive, i: int, belief: Floats, y: Floats) -> None:
    """Write q and H after step i."""
    for j in range(7):
        belief[j] = y[j]
    if not model.attitude:
        for j in range(4):
            belief[j] = drive.q[i + 1, j]


@part
def extended(model: Model, drive: Drive, i: int, belief: Floats, P: Floats, work: Work) -> None:
    """Carry belief and covariance over step i by the linearised model."""
    rigid = placed_at(model, belief)
    ends = ends_of(model, drive, i, rigid)
    dt, rows = drive.t[i + 1] - drive.t[i], 6 if model.attitude else 3
    for j in range(7):
        work.y[j] = belief[j]
    for last in range(2):
        if last:
            stride(model, drive, i, rigid, ends, work)
        jacobian_at(model, drive, i, rigid, ends, last, work)
    transition(dt, rows, work)
    carry(rows, P, work)
    add_walks(model, ends[1].inverse, dt, P)
    write_back(model, drive, i, belief, work.y)


@part
def root(P: Floats, weight: float, L: Floats) -> None:
    """Write the lower L with L L^T = weight P; a column without variance of its own is nought."""
    n = P.shape[0]
    for j in range(n):
        total = weight * P[j, j]
        for k in range(j):
            total -= L[j, k] * L[j, k]
        pivot = total**0.5 if total > NULL * weight * P[j, j] else 0.0
        L[j, j] = pivot
        for i in range(j + 1, n):
            total = weight * P[i, j]
            for k in range(j):
                total -= L[i, k] * L[j, k]
            L[i, j] = total / pivot if pivot > 0.0 else 0.0


@part
def shifted(model: Model, belief: Floats, column: int, sign: float, work: Work) -> None:
    """Write the belief moved by a column of L into work.point, its rate in place of H.

    ``work.point`` holds the mean rate there beforehand.
    """
    L, point, n = work.L, work.point, work.L.shape[0]
    row = 3 if model.attitude else 0
    for j in range(4):
        point[j] = belief[j]
    if model.attitude:
        point[0], point[1], point[2], point[3] = turned(
            belief, sign * L[0, column], sign * L[1, column], sign * L[2, column]
        )
    for j in range(3):
        point[4 + j] = work.x[j] + sign * L[row + j, column]
        point[COM + j] = belief[COM + j]
        for k in range(min(3, n - row - 3)):
            point[COM + j] += model.axes[j, k] * sign * L[row + 3 + k, column]
    for j in range(6):
        point[INERTIA + j] = belief[INERTIA + j]
        if row + 6 + j < n:
            point[INERTIA + j] += sign * L[row + 6 + j, column]


@part
def carry_point(model: Model, drive: Drive, i: int, which: int, work: Work) -> None:
    """Take work.point over step i; write its attitude and rate there."""
    rigid, row = placed_at(model, work.point), 3 if model.attitude else 0
    ends = ends_of(model, drive, i, rigid)
    p, y, h = work.point, work.y, ends[0].momentum
    H = times(ends[0].inertia, (p[4], p[5], p[6]))
    for j in range(4):
        y[j] = p[j]
    for j in range(3):
        y[4 + j] = H[j] + h[j]
    stride(model, drive, i, rigid, ends, work)
    w = rate_of(ends[1], y)
    for j in range(4):
        work.Q[which, j] = y[j]
    for j in range(3):
        work.E[which, row + j] = w[j]


@part
def centre(model: Model, points: int, work: Work) -> Triple:
    """Take the mean from the points, leaving errors; write the mean attitude, return the rate."""
    E, Q, row = work.E, work.Q, 3 if model.attitude else 0
    m0, m1, m2 = 0.0, 0.0, 0.0
    for s in range(points):
        m0, m1, m2 = m0 + E[s, row], m1 + E[s, row + 1], m2 + E[s, row + 2]
    w = (m0 / points, m1 / points, m2 / points)
    for s in range(points):
        for j in range(3):
            E[s, row + j] -= w[j]
    if model.attitude:
        m0, m1, m2 = 0.0, 0.0, 0.0
        for s in range(points):
            e = turn(Q[0], Q[s])
            m0, m1, m2 = m0 + e[0], m1 + e[1], m2 + e[2]
        y = work.y
        y[0], y[1], y[2], y[3] = turned(Q[0], m0 / points, m1 / points, m2 / points)
        for s in range(points):
            E[s, 0], E[s, 1], E[s, 2] = turn(y, Q[s])
    return w


@part
def gather(rows: int, P: Floats, work: Work) -> None:
    """Write the covariance of attitude and rate, and with the rest, from the points' errors."""
    E, L, n = work.E, work.L, P.shape[0]
    weight = 0.5 / n
    for i in range(rows):
        for j in range(i + 1):
            total = 0.0
            for s in range(2 * n):
                total += E[s, i] * E[s, j]
            P[i, j] = P[j, i] = weight * total
        for j in range(rows, n):
            total = 0.0
            for c in range(n):
                total += (E[2 * c, i] - E[2 * c + 1, i]) * L[j, c]
            P[i, j] = P[j, i] = weight * total


@part
def unscented(model: Model, drive: Drive, i: int, belief: Floats, P: Floats, work: Work) -> None:
    """Carry belief and covariance over step i by points."""
    n, rows = P.shape[0], 6 if model.attitude else 3
    here, end = ends_of(model, drive, i, placed_at(model, belief))
    root(P, 1.0 * n, work.L)
    work.x[0], work.x[1], work.x[2] = rate_of(here, belief)
    for which in range(2 * n):
        shifted(model, belief, which // 2, 1.0 - 2.0 * (which % 2), work)
        carry_point(model, drive, i, which, work)
    w = centre(model, 2 * n, work)
    gather(rows, P, work)
    add_walks(model, end.inverse, drive.t[i + 1] - drive.t[i], P)
    H = times(end.inertia, w)
    for j in range(3):
        work.y[4 + j] = H[j] + end.momentum[j]
    write_back(model, drive, i, belief, work.y)


def work_of(n: int) -> Work:
    """Return room for a filter of n elements."""
    sevens = [np.zeros(7) for _ in range(4)]
    tables = [np.zeros((6, n)) for _ in range(4)]
    return Work(
        *sevens, np.zeros(16), np.zeros((3, WIDTH)), np.zeros((3, 6)), np.zeros((3, 6)), *tables,
        np.zeros((n, n)), np.zeros((2 * n, 6)), np.zeros((2 * n, 4)), np.zeros((n, 3)),
        np.zeros((n, 3)), np.zeros((n, n)), np.zeros((3, 3)), np.zeros((3, 3)), np.zeros(n),
    )  # fmt: skip
