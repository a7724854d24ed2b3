"""What each stretch of a cut record says, at the optimum: the fixed-interval smoother, compiled.

Backwards (``segments``) every stretch k gets P_k and p_k, the information and the score that the
rows from its beginning on carry about its unknowns. Forwards the covariance given all rows follows,

    C_(k+1) = (F - E G) C_k (F - E G)^T + E M^-1 E^T,        cov u_k = M^-1 + G C_k G^T

with G and M of the jump between them.
"""

from typing import NamedTuple

import numpy as np

from equipoise.estimation.output_error.kernels.gauss_newton import (
    Local,
    Posed,
    local_for,
    search_along,
    stop_at_commands,
)
from equipoise.estimation.output_error.kernels.normal_equations import pass_for
from equipoise.estimation.output_error.kernels.segments import (
    STATE,
    Chain,
    Cuts,
    Pieces,
    absorb_jump,
    add_stretch,
    carry,
    carry_back,
    chain_for,
    count_free,
)
from equipoise.maths.compiled import kernel
from equipoise.model.arrays import Floats


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
                out.firm[k, :m, :m] = np.linalg.inv(chain.crossed[:m, :m].copy())
            carry_back(pieces.onward[k], chain)
            carry(pieces.onward[k], chain.gain[k], m)
        add_stretch(pieces, k, chain)
        out.information[k] = chain.normal
        out.score[k] = chain.descent


@kernel
def forward_pass(cuts: Cuts, pieces: Pieces, chain: Chain, first: Floats, out: Smoothed) -> None:
    """Write the covariances, ``first`` being that of the first stretch."""
    n, inverse = first.shape[0], out.firm
    out.covariance[0] = first
    for k in range(cuts.free.shape[0]):
        m = count_free(cuts.free[k])
        F = np.eye(n)
        F[:STATE] = pieces.onward[k]
        for i in range(m):
            F[cuts.free[k, i]] -= chain.gain[k, i]
        G = np.ascontiguousarray(chain.gain[k, :m])
        before = np.ascontiguousarray(out.covariance[k])
        out.onward[:] = F @ out.onward
        out.covariance[k + 1] = F @ before @ F.T
        out.jump_covariance[k, :m, :m] = inverse[k, :m, :m] + G @ before @ G.T
        for i in range(m):
            for j in range(m):
                out.covariance[k + 1, cuts.free[k, i], cuts.free[k, j]] += inverse[k, i, j]


@kernel
def pieces_at(posed: Posed, at: Local) -> None:
    """Write the local models of all stretches at a point and its jumps."""
    n, size = posed.slots.shape[0], at.point.shape[0]
    known = posed.known.copy()
    stop_at_commands(posed, at.point, known)
    work = pass_for(posed.columns.kinds.shape[0], n)
    step, here, behind = np.empty(n), np.empty(size), np.empty(size)
    search_along(posed, known, at, work, step, here, behind)


def smooth(posed: Posed, point: Floats, jumps: Floats, first: Floats) -> Smoothed:
    """Return what is known of every stretch at an optimum; ``first`` is the covariance there."""
    at = local_for(posed, point)
    at.pieces.jumps[:] = jumps
    pieces_at(posed, at)
    n, (k, a) = len(posed.slots), posed.cuts.free.shape
    square, scores, small = np.zeros((2, k + 1, n, n)), np.zeros((k + 1, n)), np.zeros((2, k, a, a))
    out = Smoothed(square[0], scores, square[1], small[0], at.pieces.points, np.eye(n), small[1])
    chain = chain_for(posed.cuts, n)
    backward_pass(posed.cuts, at.pieces, chain, out)
    forward_pass(posed.cuts, at.pieces, chain, first, out)
    return out
