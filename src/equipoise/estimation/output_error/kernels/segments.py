"""A record cut into stretches that may jump between them: from many states to the first, compiled.

Stretch k has unknowns x_k, all coordinates of a point at its beginning, and a local model A_k, b_k
of its own rows. At a cut some coordinates may jump by u, with sd given:

    x_(k+1) = F_k x_k + E u_k,     F = [ Phi ; 0 E ]        Phi: its end by its beginning

An impulse is a jump of the rate; a part that shifts, one of com; process noise, a small jump at
every cut; a gap that nobody watched, one of attitude and rate. Eliminating from the end backwards
(dynamic programming, the information form of the fixed-interval smoother of Rauch, Tung and
Striebel 1965)

    M = P_uu + 1/sd^2,   c = p_u - u/sd^2,   G = M^-1 P_u:
    P <- A_k + F^T (P - P_u^T G) F,          p <- b_k + F^T (p - P_u^T M^-1 c)

leaves the normal equations of the first stretch's unknowns. The cost grows with the number of
stretches, not with its cube.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.scaled_solve import factorise, solve
from equipoise.model.arrays import Floats, Ints, Six

STATE = 6  # coordinates that a stretch changes: attitude and rate; all others are handed on


class Cuts(NamedTuple):
    """Where a record is cut, and what may jump there."""

    nodes: Ints  # (K + 1,) where each stretch begins, and the last node
    free: Ints  # (K - 1, a) coordinates that may jump at each inner cut; -1: none
    weight: Floats  # (K - 1, a) 1 / sd^2 of each jump


class Pieces(NamedTuple):
    """The local models of all stretches."""

    normal: Floats  # (K, n, n) A
    descent: Floats  # (K, n) b
    onward: Floats  # (K - 1, 6, n) Phi
    jumps: Floats  # (K - 1, a) where the models were made
    points: Floats  # (K, ...) the point at which each stretch begins


class Chain(NamedTuple):
    """Arrays in which stretches are eliminated, made once."""

    normal: Floats  # (n, n) P
    descent: Floats  # (n,) p
    rows: Floats  # (6 or a, n)
    crossed: Floats  # (a, a) M
    scale: Floats  # (a,)
    factors: Floats  # (a, a)
    right: Floats  # (a,)
    column: Floats  # (a,)
    firm: Floats  # (K - 1, a) M^-1 c
    gain: Floats  # (K - 1, a, n) M^-1 P_u, then times F
    ahead: Floats  # (n,)


@kernel
def chain_for(cuts: Cuts, n: int) -> Chain:
    """Return the arrays for so many unknowns."""
    k, a = cuts.free.shape
    return Chain(np.empty((n, n)), np.empty(n), np.empty((max(STATE, a), n)), np.empty((a, a)),
                 np.empty(a), np.empty((a, a)), np.empty(a), np.empty(a), np.zeros((k, a)),
                 np.zeros((k, a, n)), np.empty(n))  # fmt: skip


@kernel
def pieces_for(cuts: Cuts, n: int, size: int) -> Pieces:
    """Return room for the local models by n unknowns of a point of that size."""
    k, a = cuts.free.shape
    return Pieces(np.zeros((k + 1, n, n)), np.zeros((k + 1, n)), np.zeros((k, STATE, n)),
                  np.zeros((k, a)), np.zeros((k + 1, size)))  # fmt: skip


@part
def count_free(free: Ints) -> int:
    """Return how many coordinates may jump at a cut; they come first."""
    count = 0
    while count < free.shape[0] and free[count] >= 0:
        count += 1
    return count


@part
def pose_jump(cuts: Cuts, pieces: Pieces, k: int, a: int, damping: float, chain: Chain) -> None:
    """Factorise M of the jump at inner cut k, of ``a`` coordinates, and write c behind it."""
    M, free = chain.crossed[:a, :a], cuts.free[k]
    for i in range(a):
        for j in range(a):
            M[i, j] = chain.normal[free[i], free[j]]
        M[i, i] += cuts.weight[k, i]
        pulled = cuts.weight[k, i] * pieces.jumps[k, i]
        chain.right[i] = chain.descent[free[i]] - pulled
    factorise(M, damping, chain.scale, chain.factors)


@part
def write_gain(free: Ints, a: int, chain: Chain, gain: Floats) -> None:
    """Write M^-1 P_u, column by column."""
    for j in range(gain.shape[1]):
        for i in range(a):
            chain.column[i] = chain.normal[free[i], j]
        solve(chain.scale, chain.factors, chain.column[:a], chain.ahead[:a])
        for i in range(a):
            gain[i, j] = chain.ahead[i]


@part
def absorb_jump(cuts: Cuts, pieces: Pieces, k: int, damping: float, chain: Chain) -> float:
    """Take the jump at inner cut k out of P and p; return what it promises of twice the cost."""
    a, n, P, p = count_free(cuts.free[k]), chain.descent.shape[0], chain.normal, chain.descent
    if a == 0:
        return 0.0
    free, firm, gain = cuts.free[k], chain.firm[k], chain.gain[k]
    pose_jump(cuts, pieces, k, a, damping, chain)
    solve(chain.scale, chain.factors, chain.right[:a], firm[:a])
    write_gain(free, a, chain, gain)
    promised = 0.0
    for i in range(a):
        promised += chain.right[i] * firm[i]
        for j in range(n):
            chain.rows[i, j] = P[free[i], j]
    for i in range(a):
        add_scaled(-firm[i], chain.rows[i], p, n)
        for j in range(n):
            add_scaled(-chain.rows[i, j], gain[i], P[j], n)
    return promised


@part
def carry(onward: Floats, rows: Floats, count: int) -> None:
    """Write rows F, in place."""
    n = rows.shape[1]
    for r in range(count):
        row = rows[r]
        s = (row[0], row[1], row[2], row[3], row[4], row[5])
        for c in range(STATE):
            row[c] = 0.0
        add_six(s, onward, row, n)


@part
def add_six(sizes: Six, sources: Floats, out: Floats, n: int) -> None:
    """Write out + sum of sizes_i sources_i; at once, so that ``out`` is read and written once."""
    a, b, c, d, e, f = (sources[0], sources[1], sources[2], sources[3], sources[4],
                        sources[5])  # fmt: skip
    for k in range(n):
        out[k] += (sizes[0] * a[k] + sizes[1] * b[k] + sizes[2] * c[k]
                   + sizes[3] * d[k] + sizes[4] * e[k] + sizes[5] * f[k])  # fmt: skip


@part
def add_scaled(size: float, source: Floats, out: Floats, n: int) -> None:
    """Write out + size source; a loop of its own, so that the compiler vectorises it."""
    for c in range(n):
        out[c] += size * source[c]


@part
def carry_back(onward: Floats, chain: Chain) -> None:
    """Write F^T P F and F^T p, in place."""
    P, p, n = chain.normal, chain.descent, chain.descent.shape[0]
    carry(onward, P, n)
    for i in range(STATE):
        for c in range(n):
            chain.rows[i, c] = P[i, c]
            P[i, c] = 0.0
    s = (p[0], p[1], p[2], p[3], p[4], p[5])
    for i in range(STATE):
        p[i] = 0.0
    add_six(s, onward, p, n)
    for r in range(n):
        add_six((onward[0, r], onward[1, r], onward[2, r], onward[3, r], onward[4, r],
                 onward[5, r]), chain.rows, P[r], n)  # fmt: skip


@part
def add_stretch(pieces: Pieces, k: int, chain: Chain) -> None:
    """Add the local model of a stretch to P and p."""
    n = chain.descent.shape[0]
    for i in range(n):
        chain.descent[i] += pieces.descent[k, i]
        for j in range(n):
            chain.normal[i, j] += pieces.normal[k, i, j]


@part
def condense(cuts: Cuts, pieces: Pieces, damping: float, chain: Chain) -> float:
    """Write P and p of the first stretch, all later ones and their jumps taken out.

    Return what the jumps promise of twice the cost.
    """
    promised, last = 0.0, cuts.free.shape[0]
    chain.normal[:], chain.descent[:] = 0.0, 0.0
    for k in range(last, -1, -1):
        if k < last:
            promised += absorb_jump(cuts, pieces, k, damping, chain)
            carry_back(pieces.onward[k], chain)
            carry(pieces.onward[k], chain.gain[k], count_free(cuts.free[k]))
        add_stretch(pieces, k, chain)
    return promised


@part
def follow(cuts: Cuts, pieces: Pieces, step: Floats, chain: Chain, jumps: Floats) -> None:
    """Write the jumps that go with a step of the first stretch."""
    x, n = chain.ahead, step.shape[0]
    for i in range(n):
        x[i] = step[i]
    for k in range(cuts.free.shape[0]):
        a = count_free(cuts.free[k])
        for i in range(a):
            total = chain.firm[k, i]
            for j in range(n):
                total -= chain.gain[k, i, j] * x[j]
            chain.column[i] = total
            jumps[k, i] = pieces.jumps[k, i] + total
        onto_next(pieces.onward[k], x)
        for i in range(a):
            x[cuts.free[k, i]] += chain.column[i]


@part
def onto_next(onward: Floats, x: Floats) -> None:
    """Write F x, in place."""
    total = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for j in range(x.shape[0]):
        v = x[j]
        total = (total[0] + onward[0, j] * v, total[1] + onward[1, j] * v,
                 total[2] + onward[2, j] * v, total[3] + onward[3, j] * v,
                 total[4] + onward[4, j] * v, total[5] + onward[5, j] * v)  # fmt: skip
    for i in range(STATE):
        x[i] = total[i]


@part
def jump_cost(cuts: Cuts, jumps: Floats) -> float:
    """Return half the sum of squared jumps in sd."""
    cost = 0.0
    for k in range(cuts.free.shape[0]):
        for i in range(count_free(cuts.free[k])):
            cost += 0.5 * cuts.weight[k, i] * jumps[k, i] * jumps[k, i]
    return cost
