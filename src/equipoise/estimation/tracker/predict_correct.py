"""What a step of the tracker is made of, compiled: predict along the timeline, correct by a row.

    P- = Phi P Phi^T + Q dt        Phi from the propagator's sensitivities over the step
    K  = P- H^T (H P- H^T + R)^-1,   x = K z,   P+ = (E - K H) P- (E - K H)^T + K R K^T

H picks three rows of the error state (and the bias), so H P is a few rows of P.
"""

from typing import NamedTuple

from equipoise.dynamics.regressor import momentum_columns
from equipoise.dynamics.rigid_body import ROWS, Body, Now, rate_of, times
from equipoise.dynamics.sensitivities import LANES
from equipoise.estimation.tracker.linearisation_point import AT
from equipoise.maths.kernels.compiled import part
from equipoise.maths.turns import turned
from equipoise.model.arrays import Floats, Ints, Six, Triple

SIZE = 18  # dth, dw, dr, dJ, db
N = 15  # of which the propagator moves these, in one block
COM, BODY = slice(6, 9), slice(6, 15)  # rows of the error state: r; r and J


@part
def placed(body: Body, point: Floats) -> Body:
    """Return the body with the centre of mass (m) and the inertia (kg m^2) of a point."""
    m = body.mass
    moment = (m * point[0], m * point[1], m * point[2])
    inertia = (point[3], point[4], point[5], point[6], point[7], point[8])
    return Body(m, body.gravity, inertia, moment, body.torqued, body.torque)


@part
def unit_columns(now: Now, w: Triple, regress: Floats, y: Floats) -> None:
    """Write the sensitivities to attitude, rate, moment and inertia at the beginning of a step.

    At a given rate w another inertia is another momentum: dH = W(w) dJ.
    """
    momentum_columns(w, regress)
    y[ROWS:] = 0.0
    for k in range(3):
        y[ROWS + k * LANES + k] = 1.0
        unit = times(now.inertia, (1.0 * (k == 0), 1.0 * (k == 1), 1.0 * (k == 2)))
        for j in range(3):
            y[ROWS + (3 + j) * LANES + 3 + k] = unit[j]
    for j in range(3):
        for k in range(6):
            y[ROWS + (3 + j) * LANES + 9 + k] = regress[j, k]


@part
def transition(now: Now, mass: float, y: Floats, regress: Floats, phi: Floats) -> None:
    """Write Phi over a step from the sensitivities at its end: dw = J^-1 (dH - W(w) dJ)."""
    momentum_columns(rate_of(now, y), regress)
    for c in range(N):
        scale = mass if 6 <= c < 9 else 1.0
        a, f0, f1, f2 = ROWS + c, 0.0, 0.0, 0.0
        if c >= 9:
            f0, f1, f2 = regress[0, c - 9], regress[1, c - 9], regress[2, c - 9]
        dH = (y[a + 3 * LANES] - f0, y[a + 4 * LANES] - f1, y[a + 5 * LANES] - f2)
        dw = times(now.inverse, dH)
        for j in range(3):
            phi[j, c] = scale * y[a + j * LANES]
            phi[3 + j, c] = scale * dw[j]


@part
def ahead(phi: Floats, row: int, X: Floats, column: int) -> float:
    """Return an element of Phi X; written out, so that neighbouring columns go at once."""
    f, c = phi[row], column
    return (f[0] * X[0, c] + f[1] * X[1, c] + f[2] * X[2, c] + f[3] * X[3, c] + f[4] * X[4, c]
            + f[5] * X[5, c] + f[6] * X[6, c] + f[7] * X[7, c] + f[8] * X[8, c] + f[9] * X[9, c]
            + f[10] * X[10, c] + f[11] * X[11, c] + f[12] * X[12, c] + f[13] * X[13, c]
            + f[14] * X[14, c])  # fmt: skip


@part
def predict_covariance(
    inertia: Six, phi: Floats, noise: Floats, dt: float, P: Floats, A: Floats
) -> None:
    """Write Phi P Phi^T + Q dt in place; torque noise reaches the rate through J.

    Below its sixth row Phi is the unit matrix, so only six rows and columns of P change.
    """
    for i in range(6):
        for j in range(SIZE):
            A[i, j] = ahead(phi, i, P, j)
    for i in range(6):
        for j in range(i + 1):
            total = 0.0
            for k in range(N):
                total += A[i, k] * phi[j, k]
            P[i, j] = P[j, i] = total
        for j in range(6, SIZE):
            P[i, j] = P[j, i] = A[i, j]
    for j in range(SIZE):
        spread = noise[j] / inertia[j - 3] if 3 <= j < 6 else noise[j]
        P[j, j] += spread * spread * dt


@part
def add_stops(stop: int, node: int, stop_node: Ints, stop_added: Floats, P: Floats) -> int:
    """Add what the stops up to a node do to the covariance of r; return the next stop."""
    while stop < stop_node.shape[0] and stop_node[stop] <= node:
        for i in range(3):
            for j in range(3):
                P[6 + i, 6 + j] += stop_added[stop, i, j]
        stop += 1
    return stop


@part
def invert3(S: Floats, out: Floats) -> None:
    """Write the inverse of a symmetric (3, 3)."""
    a = S[1, 1] * S[2, 2] - S[1, 2] * S[1, 2]
    b = S[0, 2] * S[1, 2] - S[0, 1] * S[2, 2]
    c = S[0, 1] * S[1, 2] - S[0, 2] * S[1, 1]
    k = 1.0 / (S[0, 0] * a + S[0, 1] * b + S[0, 2] * c)
    out[0, 0], out[0, 1], out[0, 2] = k * a, k * b, k * c
    out[1, 1] = k * (S[0, 0] * S[2, 2] - S[0, 2] * S[0, 2])
    out[1, 2] = k * (S[0, 1] * S[0, 2] - S[0, 0] * S[1, 2])
    out[2, 2] = k * (S[0, 0] * S[1, 1] - S[0, 1] * S[0, 1])
    out[1, 0], out[2, 0], out[2, 1] = out[0, 1], out[0, 2], out[1, 2]


class Work(NamedTuple):
    """Arrays that a correction works in, made once."""

    x: Floats  # (18,) error state
    HP: Floats  # (3, 18)
    S: Floats  # (3, 3) covariance of the innovation
    inverse: Floats  # (3, 3) of S
    K: Floats  # (3, 18) gain, transposed
    left: Floats  # (3, 18) what Joseph's form adds, transposed
    A: Floats  # (6, 18)


@part
def expect(P: Floats, first: int, second: int, R: float, work: Work) -> None:
    """Write H P, S = H P H^T + R E and its inverse."""
    HP, S = work.HP, work.S
    for r in range(3):
        for j in range(SIZE):
            HP[r, j] = P[first + r, j] + (P[second + r, j] if second >= 0 else 0.0)
    for r in range(3):
        for c in range(3):
            S[r, c] = HP[r, first + c] + (HP[r, second + c] if second >= 0 else 0.0)
        S[r, r] += R
    invert3(S, work.inverse)


@part
def weigh(z: Triple, work: Work) -> float:
    """Write K^T = S^-1 H P and x = K z; return the squared innovation over its covariance."""
    x, HP, V, K = work.x, work.HP, work.inverse, work.K
    surprise = 0.0
    for r in range(3):
        for c in range(3):
            surprise += z[r] * V[r, c] * z[c]
        for i in range(SIZE):
            K[r, i] = V[r, 0] * HP[0, i] + V[r, 1] * HP[1, i] + V[r, 2] * HP[2, i]
    for i in range(SIZE):
        x[i] = K[0, i] * z[0] + K[1, i] * z[1] + K[2, i] * z[2]
    return surprise


@part
def add_product(P: Floats, A: Floats, B: Floats, sign: float) -> None:
    """Add sign A^T B, (18, 18), which is symmetric: one half is computed, for both."""
    for i in range(SIZE):
        a, b, c = sign * A[0, i], sign * A[1, i], sign * A[2, i]
        for j in range(i + 1):
            P[i, j] = P[j, i] = P[i, j] + (a * B[0, j] + b * B[1, j] + c * B[2, j])


@part
def shrink(P: Floats, first: int, second: int, R: float, work: Work) -> None:
    """Write P+ in Joseph's form, by parts: A = P - K H P;  P+ = A + (K R - A H^T) K^T.

    The second part is of rounding alone, and takes back along H what A was rounded by: it has to
    be found from A as it is stored. P is symmetric to the last digit, as the prediction takes it.
    """
    K, left = work.K, work.left
    add_product(P, K, work.HP, -1.0)
    for r in range(3):
        for i in range(SIZE):
            AH = P[i, first + r] + (P[i, second + r] if second >= 0 else 0.0)
            left[r, i] = R * K[r, i] - AH
    add_product(P, left, K, 1.0)


@part
def apply(x: Floats, w: Triple, y: Floats, end: Floats) -> None:
    """Write the estimate (q, w, com, J, bias) corrected by the error state; y holds q before."""
    end[0], end[1], end[2], end[3] = turned(y, x[0], x[1], x[2])
    for m in range(3):
        end[4 + m] = w[m] + x[3 + m]
    for m in range(AT, AT + 12):
        end[m] += x[m - 1]


@part
def begin(now: Now, end: Floats, y: Floats) -> None:
    """Write attitude and momentum of an estimate (q, w, ...)."""
    H = times(now.inertia, (end[4], end[5], end[6]))
    for j in range(4):
        y[j] = end[j]
    for j in range(3):
        y[4 + j] = H[j] + now.momentum[j]


@part
def lean(now: Now, phi: Floats, point: Floats, y: Floats, end: Floats) -> None:
    """Write the estimate after a step from the point: Phi (estimate - point)."""
    a0, a1, a2 = 0.0, 0.0, 0.0
    b0, b1, b2 = rate_of(now, y)
    for c in range(9):
        off = end[AT + c] - point[c]
        a0, a1, a2 = a0 + phi[0, 6 + c] * off, a1 + phi[1, 6 + c] * off, a2 + phi[2, 6 + c] * off
        b0, b1, b2 = b0 + phi[3, 6 + c] * off, b1 + phi[4, 6 + c] * off, b2 + phi[5, 6 + c] * off
    end[0], end[1], end[2], end[3] = turned(y, a0, a1, a2)
    end[4], end[5], end[6] = b0, b1, b2


@part
def innovation(now: Now, y: Floats, bias: Floats, observed: Floats) -> Triple:
    """Return measured minus predicted rate."""
    w = rate_of(now, y)
    return (
        observed[0] - w[0] - bias[0],
        observed[1] - w[1] - bias[1],
        observed[2] - w[2] - bias[2],
    )


@part
def note(t: float, end: Floats, P: Floats, surprise: float, out: Floats) -> None:
    """Write the row: t, q, w, com, J, bias, sd, surprise."""
    n = end.shape[0]
    out[0], out[1 + n + SIZE] = t, surprise
    for j in range(n):
        out[1 + j] = end[j]
    for j in range(SIZE):
        out[1 + n + j] = P[j, j] ** 0.5
