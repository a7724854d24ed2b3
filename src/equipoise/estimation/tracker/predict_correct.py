"""What a step of the tracker is made of, compiled: predict along the timeline, correct by a row.

    P- = Phi P Phi^T + Q dt        Phi from the propagator's sensitivities over the step
    r <- r + k dT                  before it, of a platform that becomes warmer by dT
    r <- r + v dt/2                before and after it: the centre of mass drifts at v
    K  = P- H^T (H P- H^T + R)^-1,   x = K z,   P+ = (E - K H) P- (E - K H)^T + K R K^T

H picks three rows of the error state (and the bias), so H P is a few rows of P. What carries r on
has F = E but for dT E (or dt/2 E) in the rows of r and the columns of k (or v): P <- F P F^T
(docs/derivations.md, the tracker).
"""

from typing import NamedTuple

from equipoise.dynamics.forcing import write_inertia
from equipoise.dynamics.rigid_body import ROWS, Body, Now, rate_of, times
from equipoise.dynamics.sensitivities import LANES
from equipoise.estimation.tracker.linearisation_point import AT
from equipoise.estimation.tracker.stored_covariance import (
    COM_ROW,
    DRIFT,
    ROW,
    SIZE,
    WARM_ROW,
    add_product,
    add_row,
    copy_row,
    fill,
    lanes_of,
)
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.turns import turned
from equipoise.model.arrays import Floats, Ints, Six, Triple

COM, BODY = slice(6, 9), slice(6, 15)  # rows of the error state: r; r and J
RATE_OF_COM = slice(DRIFT, WARM_ROW)  # v
WARM = slice(WARM_ROW, SIZE)  # k
DRIFTING = (*range(6, 15), *range(DRIFT, WARM_ROW))  # r, J and v


class Work(NamedTuple):
    """Arrays that a correction works in, made once; (3, 24) lie as rows of P do."""

    P: Floats  # (24, 24) covariance, see ``stored_covariance``; (29, 29) with sag
    x: Floats  # (24,) error state
    HP: Floats  # (3, 24)
    S: Floats  # (3, 3) covariance of the innovation
    inverse: Floats  # (3, 3) of S
    K: Floats  # (3, 24) gain, transposed
    left: Floats  # (3, 24) what Joseph's form adds, transposed
    A: Floats  # (6, 24)
    biased: bool  # bias, drift, warmth or sag is in use
    size: int  # of the error state


@part
def placed(body: Body, point: Floats) -> Body:
    """Return the body with the centre of mass (m) and the inertia (kg m^2) of a point."""
    m = body.mass
    moment = (m * point[0], m * point[1], m * point[2])
    inertia = (point[3], point[4], point[5], point[6], point[7], point[8])
    return Body(m, body.gravity, inertia, moment, body.torqued, body.torque)


@part
def unit_columns(now: Now, w: Triple, y: Floats) -> None:
    """Write the sensitivities to attitude, rate, moment and inertia at the beginning of a step.

    At a given rate w another inertia is another momentum: dH = W(w) dJ.
    """
    y[ROWS:] = 0.0
    for k in range(3):
        y[ROWS + k * LANES + k] = 1.0
        unit = times(now.inertia, (1.0 * (k == 0), 1.0 * (k == 1), 1.0 * (k == 2)))
        for j in range(3):
            y[ROWS + (3 + j) * LANES + 3 + k] = unit[j]
    write_inertia(w, ROWS + 3 * LANES + 9, y)


@part
def transition(now: Now, mass: float, y: Floats, f: Floats, phi: Floats) -> None:
    """Write Phi over a step from the sensitivities at its end: dw = J^-1 (dH - W(w) dJ).

    ``f`` is to hold W(w) in three rows, and comes with what a step has left there.
    """
    write_inertia(rate_of(now, y), 9, f)
    for c in range(lanes_of(y)):
        a = ROWS + c
        dw = times(now.inverse, (y[a + 3 * LANES] - f[c], y[a + 4 * LANES] - f[c + LANES],
                                 y[a + 5 * LANES] - f[c + 2 * LANES]))  # fmt: skip
        phi[c], phi[c + LANES], phi[c + 2 * LANES] = y[a], y[a + LANES], y[a + 2 * LANES]
        phi[c + 3 * LANES], phi[c + 4 * LANES], phi[c + 5 * LANES] = dw
    for j in range(6):
        for c in range(6, 9):
            phi[j * LANES + c] *= mass


@part
def ahead(phi: Floats, row: int, X: Floats, width: int, column: int) -> float:
    """Return an element of Phi X; written out, so that neighbouring columns go at once."""
    r, c, w = row * LANES, column, width
    return (phi[r] * X[c] + phi[r + 1] * X[w + c] + phi[r + 2] * X[2 * w + c]
            + phi[r + 3] * X[3 * w + c] + phi[r + 4] * X[4 * w + c] + phi[r + 5] * X[5 * w + c]
            + phi[r + 6] * X[6 * w + c] + phi[r + 7] * X[7 * w + c] + phi[r + 8] * X[8 * w + c]
            + phi[r + 9] * X[9 * w + c] + phi[r + 10] * X[10 * w + c] + phi[r + 11] * X[11 * w + c]
            + phi[r + 12] * X[12 * w + c] + phi[r + 13] * X[13 * w + c]
            + phi[r + 14] * X[14 * w + c])  # fmt: skip


@part
def predict_block(phi: Floats, first: int, P: Floats, A: Floats) -> None:
    """Write a block of columns of Phi P."""
    lanes = lanes_of(P)
    for i in range(6):
        for j in range(first, first + lanes):
            A[i * ROW + j] = ahead(phi, i, P, ROW, j)


@part
def predict_sag(work: Work) -> None:
    """Write the columns of a sag that Phi P has, if any, where they stand in P."""
    for i in range(6):
        for j in range(SIZE, work.size):
            work.P[i * ROW + j] = work.A[i * ROW + j]


@part
def predict_covariance(inertia: Six, phi: Floats, noise: Floats, dt: float, work: Work) -> None:
    """Write Phi P Phi^T + Q dt in place; torque noise reaches the rate through J.

    Below its sixth row Phi is the unit matrix, so only six rows and columns of P change.
    """
    P, A, lanes = work.P, work.A, lanes_of(work.P)
    fill(P)
    predict_block(phi, 0, P, A)
    if work.biased:
        predict_block(phi, LANES, P, A)
    for i in range(6):
        for j in range(6, SIZE):
            P[i * ROW + j] = A[i * ROW + j]
        for j in range(i, 6):
            total = 0.0
            for k in range(lanes):  # the last is one of the bias in A, and zero in Phi
                total += A[i * ROW + k] * phi[j * LANES + k]
            P[i * ROW + j] = total
    predict_sag(work)
    for j in range(SIZE):
        spread = noise[j] / inertia[j - 3] if 3 <= j < 6 else noise[j]
        P[j * ROW + j] += spread * spread * dt


@part
def carry(first: int, by: float, end: Floats, P: Floats) -> None:
    """Write r + c by, c the states from row ``first`` on, and F P F^T with F = E + by at (r, c).

    Drift carries r on by a time (s), warmth by kelvins. Of P only what is on and above the diagonal
    is read and written; ``carry_beside`` is about the columns of a sag.
    """
    if by == 0.0:
        return
    for i in range(3):
        r, c = COM_ROW + i, first + i
        end[AT + i] += by * end[1 + c]
        for j in range(COM_ROW):
            P[j * ROW + r] += by * P[j * ROW + c]
        for k in range(i, 3):
            both = P[r * ROW + first + k] + P[(COM_ROW + k) * ROW + c]
            P[r * ROW + COM_ROW + k] += by * (both + by * P[c * ROW + first + k])
    for i in range(3):
        r, c = COM_ROW + i, first + i
        for j in range(COM_ROW + 3, SIZE):
            low, high = min(j, c), max(j, c)
            P[r * ROW + j] += by * P[low * ROW + high]


@kernel
def carry_beside(first: int, by: float, work: Work) -> None:
    """Write what ``carry`` does to the covariance of r with a sag, if any."""
    P = work.P
    for i in range(3):
        r, c = COM_ROW + i, first + i
        for j in range(SIZE, work.size):
            P[r * ROW + j] += by * P[c * ROW + j]


@part
def add_stops(stop: int, node: int, stop_node: Ints, stop_added: Floats, P: Floats) -> int:
    """Add what the stops up to a node do to the covariance of r; return the next stop."""
    while stop < stop_node.shape[0] and stop_node[stop] <= node:
        for i in range(3):
            for j in range(3):
                P[(6 + i) * ROW + 6 + j] += stop_added[stop, i, j]
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


@part
def expect(first: int, second: int, R: float, work: Work) -> None:
    """Write H P, S = H P H^T + R E and its inverse."""
    P, HP, S = work.P, work.HP, work.S
    for r in range(3):
        copy_row(P, first + r, HP, r * ROW)
        if second >= 0:
            add_row(P, second + r, HP, r * ROW)
    for r in range(3):
        for c in range(3):
            at = r * ROW + c
            S[r, c] = HP[at + first] + (HP[at + second] if second >= 0 else 0.0)
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
        for i in range(ROW):
            K[r * ROW + i] = V[r, 0] * HP[i] + V[r, 1] * HP[ROW + i] + V[r, 2] * HP[2 * ROW + i]
    for i in range(ROW):
        x[i] = K[i] * z[0] + K[ROW + i] * z[1] + K[2 * ROW + i] * z[2]
    return surprise


@part
def shrink(first: int, second: int, R: float, work: Work) -> None:
    """Write P+ in Joseph's form, by parts: A = P - K H P;  P+ = A + (K R - A H^T) K^T.

    The second part is of rounding alone, and takes back along H what A was rounded by: it has to
    be found from A as it is stored.
    """
    P, K, left = work.P, work.K, work.left
    beside = work.size if work.biased else 0
    add_product(P, K, work.HP, -1.0, beside)
    for r in range(3):
        copy_row(P, first + r, left, r * ROW)
        if second >= 0:
            add_row(P, second + r, left, r * ROW)
    for j in range(3 * ROW):
        left[j] = R * K[j] - left[j]
    add_product(P, left, K, 1.0, beside)


@part
def apply(x: Floats, w: Triple, y: Floats, end: Floats) -> None:
    """Write the estimate (q, w, com, J, bias, v, k) corrected; y holds q before."""
    end[0], end[1], end[2], end[3] = turned(y, x[0], x[1], x[2])
    for m in range(3):
        end[4 + m] = w[m] + x[3 + m]
    for m in range(AT, end.shape[0]):
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
        k, n = 6 + c, LANES
        a0, a1, a2 = a0 + phi[k] * off, a1 + phi[n + k] * off, a2 + phi[2 * n + k] * off
        k += 3 * n
        b0, b1, b2 = b0 + phi[k] * off, b1 + phi[n + k] * off, b2 + phi[2 * n + k] * off
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
    """Write the row: t, q, w, com, J, bias, v, k, the sag if any, sd, surprise."""
    n, last = end.shape[0], out.shape[0] - 1
    out[0], out[last] = t, surprise
    for j in range(n):
        out[1 + j] = end[j]
    for j in range(last - 1 - n):
        out[1 + n + j] = P[j * ROW + j] ** 0.5
