"""Recursive least squares on rows that are linear in the unknowns, each row used once, as it comes.

    K = P H^T (lam R + H P H^T)^-1,   x += K (b - H x),   P = (P - K H P) / lam

H = [A, E] where a piece has free constants (they are states beside the unknowns, and restart
with each piece), lam = exp(-dt / forget). R is diagonal; the equations of a row are therefore taken
one after the other, which is the same and needs no inverse. (da Silva 2021 Eqs. 22-25 are the
scalar case, printed with Phi where Phi^T belongs: this is their matrix form. By the matrix
inversion lemma it is also Lee's Eq. 8, P^-1 += H^T W H with W = R^-1.)

Without forgetting (the default) x is the least-squares solution of all rows so far and of the
start, whose sd should be wide. With it, rows weigh exp(-age / forget): for a centre of mass that
drifts or steps. What is constant is known best without.

Forgetting without excitation would let P grow until noise alone moves x (wind-up). Two guards, each
for every unknown by itself, P_ij becoming d_i d_j P_ij with d_i between 1 and lam^-1/2:

- nothing is forgotten of an unknown that the recent rows do not show: d_i = 1 while its column,
  times ``limit``, stays below ``still`` times the rows' noise. Recent is what lies within
  ``forget``; where constants are free only what changes of a column counts. Forgetting J at rest,
  one would learn it from noise, which says that it is zero.
- no sd grows beyond ``limit`` by forgetting: d_i <= limit_i / sqrt(P_ii). So P stays bounded
  whatever comes, also along directions that no single column betrays (com along gravity).

P takes rows for independent and columns for exact. Neither is so: it is not the uncertainty.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from equipoise.estimation.regression.formulations.rows import Rows
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.linalg import inverse_spd, unit_eigenvalues
from equipoise.model.arrays import Floats, Ints, Series, Square

WORST = 1e-9  # chosen: least eigenvalue, of a normal matrix of unit diagonal, that is solved


@dataclass(frozen=True, slots=True, eq=False)
class Recursion:
    """Where to begin, what rows are worth, and what to forget. SI, in the order of the rows."""

    start: Floats  # (c,)
    sd: Floats  # (c,) of the start
    noise: Floats  # (m,) one sd of each equation of a row
    free: float  # sd of the constants that a new piece begins with
    limit: Floats  # (c,) sd beyond which an unknown is not forgotten
    forget: float = np.inf  # s
    still: float = 3.0  # chosen: sd of noise that an error of ``limit`` must make to be shown


class State(NamedTuple):
    """The estimate after a row."""

    x: Floats  # (s,) unknowns, then free constants
    P: Square  # (s, s)
    recent: Floats  # (m + 1, c) mean of each column; then its mean square, over the noise's
    last: Floats  # (3,) s, piece, rows that count as recent; piece -1: none came yet


@part
def _restart(x: Floats, P: Floats, first: int, variance: float) -> None:
    """Begin the states from ``first`` on anew, known to nobody."""
    for i in range(first, x.shape[0]):
        x[i] = 0.0
        for j in range(x.shape[0]):
            P[i, j] = P[j, i] = 0.0
        P[i, i] = variance


@part
def _update(
    A: Floats, noise: Floats, varying: bool, lam: float, recent: Floats, last: Floats
) -> None:
    """Count a row among the recent ones."""
    m, c = A.shape
    last[2] = lam * last[2] + 1.0
    share = 1.0 / last[2]
    for i in range(c):
        square = 0.0
        for a in range(m):
            off = A[a, i] - recent[a, i]
            if varying:
                recent[a, i] += share * off
            square += off * (A[a, i] - recent[a, i]) / noise[a] ** 2
        recent[m, i] += share * (square - recent[m, i])


@part
def _widen(
    P: Floats, square: Floats, limit: Floats, free: float, still: float, lam: float, d: Floats
) -> None:
    """Forget: widen P by d on both sides."""
    s, c = P.shape[0], square.shape[0]
    for i in range(s):
        most = limit[i] if i < c else free
        shown = i >= c or square[i] * limit[i] ** 2 >= still**2
        grown = min(lam**-0.5, most * P[i, i] ** -0.5) if P[i, i] > 0.0 else 1.0
        d[i] = max(grown, 1.0) if shown else 1.0
    for i in range(s):
        for j in range(s):
            P[i, j] *= d[i] * d[j]


@part
def _learn(x: Floats, P: Floats, h: Floats, b: float, variance: float, gain: Floats) -> None:
    """Take one equation h x = b."""
    s, left, spread = x.shape[0], b, variance
    for i in range(s):
        total = 0.0
        for j in range(s):
            total += P[i, j] * h[j]
        gain[i] = total
    for i in range(s):
        spread += h[i] * gain[i]
        left -= h[i] * x[i]
    for i in range(s):
        share = gain[i] / spread
        x[i] += share * left
        for j in range(s):
            P[i, j] -= share * gain[j]


@part
def _equation(A: Floats, a: int, h: Floats) -> None:
    """Write equation ``a`` of a row, [A, E]."""
    c = A.shape[0]
    for i in range(h.shape[0]):
        h[i] = A[i] if i < c else (1.0 if i - c == a else 0.0)


@part
def _symmetrise(P: Floats) -> None:
    """Remove what rounding made of P."""
    for i in range(P.shape[0]):
        for j in range(i):
            P[i, j] = P[j, i] = 0.5 * (P[i, j] + P[j, i])


@kernel
def _advance(
    t: Floats, A: Floats, b: Floats, piece: Ints, noise: Floats, free: float, limit: Floats,
    forget: float, still: float, x: Floats, P: Floats, recent: Floats, last: Floats, out: Floats,
) -> None:  # fmt: skip
    """Go through the rows, the state in place; write values and sd, shape (n, 2, c)."""
    n, m, c = A.shape
    s = x.shape[0]
    h, gain = np.zeros(s), np.zeros(s)
    for k in range(n):
        lam = 1.0 if last[1] < 0.0 else np.exp((last[0] - t[k]) / forget)
        new = s > c and last[1] != piece[k]
        if new:
            recent[:], last[2] = 0.0, 0.0
        last[0], last[1] = t[k], piece[k]
        if lam < 1.0:
            _update(A[k], noise, s > c, lam, recent, last)
            _widen(P, recent[m], limit, free, still, lam, gain)
        if new:
            _restart(x, P, c, free**2)
        for a in range(m):
            _equation(A[k, a], a, h)
            _learn(x, P, h, b[k, a], noise[a] ** 2, gain)
        _symmetrise(P)
        for i in range(c):
            out[k, 0, i], out[k, 1, i] = x[i], P[i, i] ** 0.5


def begin(recursion: Recursion, constants: bool) -> State:
    """Return the state before any row; with free constants, or rows that have none."""
    c, m = len(recursion.start), len(recursion.noise)
    extra = m if constants else 0
    x = np.append(recursion.start, np.zeros(extra))
    P = np.diag(np.append(recursion.sd, np.full(extra, recursion.free)) ** 2)
    return State(x, P, np.zeros((m + 1, c)), np.array([0.0, -1.0, 0.0]))


def advance(recursion: Recursion, state: State, rows: Rows) -> tuple[State, Series, Series]:
    """Return the state after some rows, and values and sd (n, c) after each of them.

    Row by row or all at once comes to the same.
    """
    now, out = State(*(a.copy() for a in state)), np.empty((len(rows.t), 2, len(rows.names)))
    piece = np.zeros(len(rows.t), np.int64) if rows.piece is None else rows.piece
    A, b = np.ascontiguousarray(rows.A), np.ascontiguousarray(rows.b)
    r = recursion
    _advance(
        rows.t, A, b, piece, r.noise, r.free, r.limit, float(r.forget), r.still, *now, out
    )  # fmt: skip
    return now, out[:, 0], out[:, 1]


def begin_with(recursion: Recursion, first: Rows) -> State | None:
    """Return the state that least squares on the first rows alone begin with; None: unobservable.

    There is no prior: this is the batch that Lee begins with.
    """
    columns, pieces = written_out(first)
    weight = 1.0 / np.tile(recursion.noise, len(first.t))
    known, columns = first.b.reshape(-1) * weight, columns * weight[:, None]
    normal = columns.T @ columns
    if unit_eigenvalues(normal)[0] < WORST:
        return None
    P = inverse_spd(normal)
    c, m = len(first.names), len(recursion.noise)
    keep = np.r_[:c, columns.shape[1] - m : columns.shape[1]] if pieces else np.arange(c)
    last = np.array([first.t[-1], 0.0 if first.piece is None else first.piece[-1], 0.0])
    return State((P @ (columns.T @ known))[keep], P[np.ix_(keep, keep)], np.zeros((m + 1, c)), last)


def written_out(rows: Rows) -> tuple[Floats, int]:
    """Return the equations one below the other, a column for each constant, and the pieces."""
    n, m, c = rows.A.shape
    flat = rows.A.reshape(n * m, c)
    if rows.piece is None:
        return flat, 0
    kinds, which = np.unique(rows.piece, return_inverse=True)
    constants = np.zeros((n, m, len(kinds), m))
    for a in range(m):
        constants[np.arange(n), a, which, a] = 1.0
    return np.hstack([flat, constants.reshape(n * m, -1)]), len(kinds)
