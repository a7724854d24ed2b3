"""A step of the unscented filter: errors go as points about the estimate do.

    points x +- columns of L,  L L^T = n P,  2n of them, each weighing 1/(2n)
    mean of the carried points;  P- = sum of e e^T / (2n) + Q dt,  e = point - mean

(Simon 2006.) The error of an attitude is multiplicative: points lie about it
in rotation vectors, and their mean is taken there. What is considered has points too.
"""

from equipoise.dynamics.rigid_body import rate_of, times
from equipoise.estimation.filters.model import Model
from equipoise.estimation.filters.predict import (
    COM,
    INERTIA,
    Drive,
    Work,
    add_walks,
    ends_of,
    placed_at,
    stride,
    write_back,
)
from equipoise.maths.kernels.compiled import part
from equipoise.maths.turns import turn, turned
from equipoise.model.arrays import Floats, Triple

NULL = 1e-14  # of a variance, chosen: what is left of it is rounding


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
def shifted(model: Model, mean: Floats, column: int, sign: float, work: Work) -> None:
    """Write the estimate moved by a column of L into work.point, its rate in place of H.

    ``work.x`` holds the mean rate.
    """
    L, point, n = work.L, work.point, work.L.shape[0]
    row = 3 if model.attitude else 0
    for j in range(4):
        point[j] = mean[j]
    if model.attitude:
        point[0], point[1], point[2], point[3] = turned(
            mean, sign * L[0, column], sign * L[1, column], sign * L[2, column]
        )
    for j in range(3):
        point[4 + j] = work.x[j] + sign * L[row + j, column]
        point[COM + j] = mean[COM + j]
        for k in range(min(3, n - row - 3)):
            point[COM + j] += model.axes[j, k] * sign * L[row + 3 + k, column]
    for j in range(6):
        point[INERTIA + j] = mean[INERTIA + j]
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
def unscented(model: Model, drive: Drive, i: int, mean: Floats, P: Floats, work: Work) -> None:
    """Carry estimate and covariance over step i by points."""
    n, rows = P.shape[0], 6 if model.attitude else 3
    here, end = ends_of(model, drive, i, placed_at(model, mean))
    root(P, 1.0 * n, work.L)
    work.x[0], work.x[1], work.x[2] = rate_of(here, mean)
    for which in range(2 * n):
        shifted(model, mean, which // 2, 1.0 - 2.0 * (which % 2), work)
        carry_point(model, drive, i, which, work)
    w = centre(model, 2 * n, work)
    gather(rows, P, work)
    add_walks(model, end.inverse, drive.t[i + 1] - drive.t[i], P)
    H = times(end.inertia, w)
    for j in range(3):
        work.y[4 + j] = H[j] + end.momentum[j]
    write_back(model, drive, i, mean, work.y)
