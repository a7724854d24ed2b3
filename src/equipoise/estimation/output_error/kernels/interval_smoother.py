"""What each stretch of a cut record says, at the optimum: the fixed-interval smoother, compiled.

Backwards (``segments``) every stretch k gets P_k and p_k, the information and the score that the
rows from its beginning on carry about its unknowns. Forwards the covariance given all rows follows,

    C_(k+1) = (F - E G) C_k (F - E G)^T + E M^-1 E^T,        cov u_k = M^-1 + G C_k G^T

with G and M of the jump between them.
"""

from typing import NamedTuple

import numpy as np

from equipoise.estimation.output_error.kernels.segments import (
    STATE,
    Chain,
    Cuts,
    Pieces,
    absorb_jump,
    add_scaled,
    add_stretch,
    carry,
    carry_back,
    chain_for,
    count_free,
)
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.kernels.copying import copy_rows, copy_values
from equipoise.model.arrays import Floats, Ints


class Smoothed(NamedTuple):
    """What is known of every stretch."""

    information: Floats  # (K, n, n) of the rows from here on, about the unknowns here
    score: Floats  # (K, n)
    covariance: Floats  # (K, n, n) given all rows
    jump_covariance: Floats  # (K - 1, a, a)
    points: Floats  # (K, ...) where each stretch begins, as the kernels keep it
    onward: Floats  # (n, n) of the unknowns at the beginning, those at the last stretch
    firm: Floats  # (K - 1, a, a) M^-1: covariance of a jump when all before it is known


@kernel
def backward_pass(cuts: Cuts, pieces: Pieces, chain: Chain, out: Smoothed) -> None:
    """Write information and score of every stretch, and M^-1 of every jump."""
    last = cuts.free.shape[0]
    chain.normal[:], chain.descent[:] = 0.0, 0.0
    for k in range(last, -1, -1):
        if k < last:
            absorb_jump(cuts, pieces, k, 0.0, chain)
            m = count_free(cuts.free[k])
            if m:
                inverse = np.linalg.inv(chain.crossed[:m, :m].copy())
                copy_rows(inverse, out.firm[k])  # pyright: ignore # of doubles
            carry_back(pieces.onward[k], chain)
            carry(pieces.onward[k], chain.gain[k], m)
        add_stretch(pieces, k, chain)
        copy_rows(chain.normal, out.information[k])
        copy_values(chain.descent, out.score[k])


@part
def multiply_rows(F: Floats, M: Floats, count: int, out: Floats) -> None:
    """Write the first rows of F M."""
    n = M.shape[0]
    for i in range(count):
        out[i] = 0.0
        for j in range(n):
            add_scaled(F[i, j], M[j], out[i], n)


@part
def carried(F: Floats, changed: Ints, count: int, M: Floats, rows: Floats, out: Floats) -> None:
    """Write F M, F being the unit matrix but for the rows ``changed``; ``rows`` is worked in."""
    multiply_rows(F, M, count, rows)
    copy_rows(M, out)
    for i in range(count):
        copy_values(rows[i], out[changed[i]])


@part
def onto_both(F: Floats, changed: Ints, count: int, C: Floats, rows: Floats, out: Floats) -> None:
    """Write F C F^T of a symmetric C, in the same way."""
    n = C.shape[0]
    carried(F, changed, count, C, rows, out)
    for a in range(n):
        for i in range(count):
            total = 0.0
            for j in range(n):
                total += F[i, j] * out[a, j]
            rows[i, a] = total
    for i in range(count):
        for a in range(n):
            out[a, changed[i]] = rows[i, a]


@part
def congruent(G: Floats, C: Floats, rows: Floats, m: int, out: Floats) -> None:
    """Write G C G^T, of the first m rows of G; ``rows`` is worked in."""
    n = C.shape[0]
    multiply_rows(G, C, m, rows)
    for i in range(m):
        for j in range(m):
            total = 0.0
            for c in range(n):
                total += rows[i, c] * G[j, c]
            out[i, j] = total


@kernel
def forward_pass(cuts: Cuts, pieces: Pieces, chain: Chain, first: Floats, out: Smoothed) -> None:
    """Write the covariances, ``first`` being that of the first stretch."""
    n, inverse, most = first.shape[0], out.firm, STATE + cuts.free.shape[1]
    F, rows, changed = np.zeros((most, n)), np.zeros((most, n)), np.zeros(most, dtype=np.int64)
    whole, place = np.empty((n, n)), np.empty(n, dtype=np.int64)
    copy_rows(first, out.covariance[0])
    for k in range(cuts.free.shape[0]):
        m, count = count_free(cuts.free[k]), STATE
        place[:] = -1
        for i in range(STATE):
            changed[i], place[i] = i, i
            copy_values(pieces.onward[k, i], F[i])
        for i in range(m):
            at = cuts.free[k, i]
            if place[at] < 0:
                place[at], changed[count], F[count] = count, at, 0.0
                F[count, at] = 1.0
                count += 1
            add_scaled(-1.0, chain.gain[k, i], F[place[at]], n)
        G, before = chain.gain[k], out.covariance[k]
        carried(F, changed, count, out.onward, rows, whole)
        copy_rows(whole, out.onward)
        onto_both(F, changed, count, before, rows, out.covariance[k + 1])
        congruent(G, before, rows, m, out.jump_covariance[k])
        for i in range(m):
            for j in range(m):
                out.jump_covariance[k, i, j] += inverse[k, i, j]
                out.covariance[k + 1, cuts.free[k, i], cuts.free[k, j]] += inverse[k, i, j]


def smooth(cuts: Cuts, pieces: Pieces, first: Floats) -> Smoothed:
    """Return what is known of every stretch at an optimum; ``first`` is the covariance there."""
    n, (k, a) = len(first), cuts.free.shape
    square, scores, small = np.zeros((2, k + 1, n, n)), np.zeros((k + 1, n)), np.zeros((2, k, a, a))
    out = Smoothed(square[0], scores, square[1], small[0], pieces.points, np.eye(n), small[1])
    chain = chain_for(cuts, n)
    backward_pass(cuts, pieces, chain, out)
    forward_pass(cuts, pieces, chain, first, out)
    return out
