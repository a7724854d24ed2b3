"""How far a centre of mass wanders, by the record itself: the size of its walk, axis by axis.

Between nodes dt apart a walk of size w (m/sqrt(s)) has steps of sd s = w sqrt(dt). With A_k, b_k of
the stretches, and everything linear about a fit whose jumps are j, rows and unknowns are normal
together; all unknowns integrated out (``segments`` has M and the promises, beta the right side of
the first stretch, A its matrix with the priors),

    -2 ln p(rows | w) = sum j^2/s^2 - promised - beta A^-1 beta + ln det A
                        + sum_k ln det (s^2 M_k)

but for a constant (restricted likelihood; Patterson and Thompson 1971, for a chain: Schweppe 1965).
Nothing is integrated anew: a size costs one elimination.

What is taken is the mean of w^2, weighed by this and by what was expected: with even odds no walk
to speak of, or ln w normal about the expected size, with an sd of ``DECADES_SD``. A record without
drift says no more than that w is below what it would show; the mean keeps what cannot be excluded,
where the likeliest size, often none, would promise too much. Variances are concave in w^2: one at
the mean is at least their mean.

Cannot see a walk from what else bends a motion as slowly: torques, a gyro's bias that wanders.
"""

import numpy as np

from equipoise.estimation.output_error.kernels.gauss_newton import add_priors
from equipoise.estimation.output_error.kernels.record_pass import Local, Posed
from equipoise.estimation.output_error.kernels.segments import (
    Chain,
    Cuts,
    Pieces,
    absorb_jump,
    add_stretch,
    carry_back,
    chain_for,
    count_free,
)
from equipoise.estimation.output_error.problem import posed
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.parameters.retraction import coordinates_of
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.scaled_solve import factorise, solve
from equipoise.model.arrays import Floats, Series1

DECADES = np.arange(-24, 17) / 8  # chosen: from nothing to a drift that anybody sees
DECADES_SD = 1.0  # chosen: what thermal drift of one laboratory differs by from another's
STILL = 0.5  # chosen: share of records without any drift
SWEEPS = 2  # chosen: axes hardly depend on each other


@part
def log_det(scale: Floats, factors: Floats, n: int) -> float:
    """Return ln det of a matrix of n rows that ``factorise`` has factorised."""
    total = 0.0
    for i in range(n):
        total += np.log(factors[i, i]) - 2.0 * np.log(scale[i])
    return total


@part
def price_jumps(cuts: Cuts, pieces: Pieces, chain: Chain) -> float:
    """Return what the jumps add to the above, and write P and p of the first stretch."""
    total, last = 0.0, cuts.free.shape[0]
    chain.normal[:], chain.descent[:] = 0.0, 0.0
    add_stretch(pieces, last, chain)
    for k in range(last - 1, -1, -1):
        a = count_free(cuts.free[k])
        total -= absorb_jump(cuts, pieces, k, 0.0, chain)
        for i in range(a):
            weight, jump = cuts.weight[k, i], pieces.jumps[k, i]
            total += weight * jump * jump - np.log(weight)
        total += log_det(chain.scale, chain.factors, a)
        carry_back(pieces.onward[k], chain)
        add_stretch(pieces, k, chain)
    return total


@kernel
def improbability(posed: Posed, at: Local, weight: Floats) -> float:
    """Return -2 ln of how probable the rows are with jumps of these weights, but for a constant."""
    n = posed.slots.shape[0]
    cuts = Cuts(posed.cuts.nodes, posed.cuts.free, weight)
    chain, x, step = chain_for(cuts, n), np.empty(n), np.empty(n)
    scale, factors = np.empty(n), np.empty((n, n))
    total = price_jumps(cuts, at.pieces, chain)
    coordinates_of(at.point, posed.mass, posed.slots, x)
    add_priors(posed, x, chain)
    factorise(chain.normal, 0.0, scale, factors)
    solve(scale, factors, chain.descent, step)
    for i in range(n):
        total -= step[i] * chain.descent[i]
    return total + log_det(scale, factors, n)


def linear_at(fitted: Fitted) -> tuple[Posed, Local]:
    """Return the local models of all stretches where a fit ended."""
    at = fitted.at
    return posed(fitted.problem), Local(fitted.point.flat, at.pieces, at.left_q, at.left_w,
                                        at.left_v)  # fmt: skip


def improbability_of(problem: Posed, at: Local, sd: Floats) -> float:
    """Return the above for steps of these sd (m), one an axis; infinite if it is no number."""
    weight = np.tile(sd**-2.0, (len(problem.cuts.free), 1))
    value = improbability(problem, at, weight)
    return value if np.isfinite(value) else np.inf


def expected_shares() -> Series1:
    """Return the prior probability of each size; the least of them is none."""
    share = np.exp(-0.5 * (DECADES / DECADES_SD) ** 2)
    share *= (1 - STILL) / share.sum()
    share[0] += STILL
    return share


def mean_size(improbable: Series1, sizes: Series1) -> float:
    """Return the root of the mean square of sizes that stand ``DECADES`` from what is expected."""
    share = expected_shares()
    if np.any(np.isfinite(improbable)):
        share *= np.exp(-0.5 * (improbable - improbable.min()))
    return float(np.sqrt(share @ sizes**2 / share.sum()))


def likely_steps(problem: Posed, at: Local, expected: float) -> Floats:
    """Return the sd (m) of the steps, one an axis that walks; ``expected`` is that expected."""
    sizes: Series1 = expected * 10.0**DECADES
    sd: Floats = np.full(count_free(problem.cuts.free[0]), expected)
    for axis in np.tile(np.arange(len(sd)), SWEEPS):
        trials = np.tile(sd, (len(sizes), 1))
        trials[:, axis] = sizes
        sd[axis] = mean_size(np.array([improbability_of(problem, at, s) for s in trials]), sizes)
    return sd


def gain(problem: Posed, at: Local, sd: Floats, expected: float) -> float:
    """Return by how much -2 ln p falls from next to no walk to one with steps of these sd (m)."""
    still = np.full(len(sd), expected * 10.0 ** DECADES[0])
    return improbability_of(problem, at, still) - improbability_of(problem, at, sd)
