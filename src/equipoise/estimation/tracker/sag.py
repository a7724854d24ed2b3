"""Elastic sag as the tracker carries it, compiled: over a step it displaces the centre of mass.

    lever         r + C n,   n = g_B / g half-way through the step,   C n = sum c_k B_k(n)
    before it     r <- r + B(n) (c - c0),    P <- F P F^T,   F = E + B(n) at (r, c)
    after it      the same with -B(n)

So Phi need not know of C: dth and dw follow from those to r. What c0 does, the sag of the point
that is linearised about, the propagator integrates with n as it turns; c - c0 acts to
(w dt)^2 / 12 of itself, w being the rate: 8e-4 at the longest step (docs/derivations.md).

The coefficients are constant: a structure does not change its stiffness in a day.

These are kernels of their own, not merged into the walk, which most platforms take without them.

Cannot tell C from r where the platform does not tilt: at one n only r + C n turns it.
"""

from equipoise.dynamics.regressor import SAG
from equipoise.dynamics.rigid_body import gravity_of
from equipoise.estimation.tracker.event_signatures import COLUMNS
from equipoise.estimation.tracker.kernel_records import Moving
from equipoise.estimation.tracker.linearisation_point import AT
from equipoise.estimation.tracker.predict_correct import Work
from equipoise.estimation.tracker.stored_covariance import COM_ROW, ROW, SAG_ROW
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.turns import turned
from equipoise.model.arrays import Floats, Triple


@kernel
def halfway_down(end: Floats, lapse: float, moving: Moving) -> None:
    """Write n half-way through a step of ``lapse`` seconds, at the rate of its beginning."""
    y, half = moving.y, 0.5 * lapse
    y[0], y[1], y[2], y[3] = turned(end, half * end[4], half * end[5], half * end[6])
    moving.down[0], moving.down[1], moving.down[2] = gravity_of(y, 1.0)


@part
def bending(n: Floats, k: int) -> Triple:
    """Return B_k(n), the displacement by the k-th of the coefficients xx yy xy xz yz."""
    x, y, z = n[0], n[1], n[2]
    if k < 2:
        return (x, 0.0, -z) if k == 0 else (0.0, y, -z)
    if k == 2:
        return (y, x, 0.0)
    return (z, 0.0, x) if k == 3 else (0.0, z, y)


@part
def add_to_row(r: int, c: int, by: float, work: Work) -> None:
    """Write F P F^T with F = E + by at (r, c), r before c, on and above the diagonal."""
    P = work.P
    for j in range(r):
        P[j * ROW + r] += by * P[j * ROW + c]
    P[r * ROW + r] += by * (2.0 * P[r * ROW + c] + by * P[c * ROW + c])
    for j in range(r + 1, work.size):
        P[r * ROW + j] += by * P[min(j, c) * ROW + max(j, c)]


@kernel
def bend(n: Floats, sign: float, torque: tuple[float, ...], end: Floats, work: Work) -> None:
    """Write r + sign B(n) (c - c0), c0 among the coefficients of ``torque``, and its covariance."""
    for k in range(5):
        c, column = SAG_ROW + k, bending(n, k)
        off = sign * (end[1 + c] - torque[SAG + k])
        for i in range(3):
            end[AT + i] += column[i] * off
            add_to_row(COM_ROW + i, c, sign * column[i], work)


@kernel
def bend_signatures(n: Floats, sign: float, X: Floats) -> None:
    """Write F X, as events would have changed r and C."""
    for k in range(5):
        column = bending(n, k)
        for i in range(3):
            by, r, c = sign * column[i], (COM_ROW + i) * COLUMNS, (SAG_ROW + k) * COLUMNS
            for j in range(COLUMNS):
                X[r + j] += by * X[c + j]
