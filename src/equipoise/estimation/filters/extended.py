"""A step of the extended filter: errors go as the linearised model has it.

    Phi = E + dt/2 (F_0 + F_1) + dt^2/2 F_1 F_0,    P- = Phi P Phi^T + Q dt

F_0 and F_1 are F at both ends of the step (Heun's rule: good to dt^2). Of the simplified model
F_1 F_0 is nought, and Phi the trapezoid -(m T/2) J^-1 ([g_k x] + [g_k+1 x]) of the review's
Eqs. 28 to 30 with R11 and R12: then this is the linear filter.
"""

from equipoise.dynamics.rigid_body import Body, Now, gravity_of, rate_of
from equipoise.estimation.filters.jacobian import change_of, write_jacobian
from equipoise.estimation.filters.model import Model
from equipoise.estimation.filters.predict import (
    Drive,
    Work,
    add_walks,
    ends_of,
    gravity_at,
    placed_at,
    slope,
    stride,
    write_back,
)
from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats


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
def extended(model: Model, drive: Drive, i: int, mean: Floats, P: Floats, work: Work) -> None:
    """Carry estimate and covariance over step i by the linearised model."""
    rigid = placed_at(model, mean)
    ends = ends_of(model, drive, i, rigid)
    dt, rows = drive.t[i + 1] - drive.t[i], 6 if model.attitude else 3
    for j in range(7):
        work.y[j] = mean[j]
    for last in range(2):
        if last:
            stride(model, drive, i, rigid, ends, work)
        jacobian_at(model, drive, i, rigid, ends, last, work)
    transition(dt, rows, work)
    carry(rows, P, work)
    add_walks(model, ends[1].inverse, dt, P)
    write_back(model, drive, i, mean, work.y)
