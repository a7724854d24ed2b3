"""Whether runs agree: the scatter between them against the sd that each of them states.

At the joint optimum x, run i alone has information S_i and descent g_i by what is shared, priors
left out. By its local model its own optimum is d_i = S_i^-1 g_i away, within the directions that it
shows. With C the joint covariance, d_i of data that are part of all data (Hausman 1978)

    cov d_i = C_i - C,      C_i = S_i^-1 + Delta_i

Delta_i is what else a run's intervals count: when its events happened, how masses hang. Scaled to
C_i = E,

    z_i = C_i^-1/2 d_i,     W_i = C_i^-1/2 C C_i^-1/2
    chi_i^2 = z_i (E - W_i)^-1 z_i          a run, of as many degrees of freedom as E - W_i has
    Q = sum z_i^2                           all runs, of sum trace (E - W_i) degrees (Cochran 1954)

Without a prior the latter are the directions that the runs show, less those of the joint fit. The
root of Q over them is the factor by which sd are too small (Birge 1932).

Cannot see what errs alike in all runs, nor in which of two runs the error is.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from equipoise.estimation.parameters.observability import OBSERVABLE
from equipoise.maths.chi_square import chi_square_chance
from equipoise.maths.linalg import symmetrise
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import COM, INERTIA, Estimate, Parameter
from equipoise.model.joint_estimate import Deviation, RunScatter, Spread
from equipoise.model.reasons.reason import Reason
from equipoise.model.reasons.verdict_reasons import VerdictReason as Why
from equipoise.model.verdict import Verdict

UNLIKELY = 0.01  # chosen: a probability below which scatter is larger than stated
OWN = 1e-3  # chosen: a smaller share of a run's variance is its own: it is the joint fit there
MOST_OF = 0.5  # chosen: of the greatest deviation, what is named beside it
FEWEST = 0.5  # degrees of freedom below which runs have nothing in common


@dataclass(frozen=True, slots=True, eq=False)
class OwnShare:
    """What a run alone shows, by its own part of what is shared in natural sizes."""

    information: Square  # S
    descent: Floats  # g
    beside: Square  # of when its events happened
    sagged: Floats  # change of g by masses that hang, one sd
    joint: Square  # C


def scaled(run: OwnShare) -> tuple[Floats, Square]:
    """Return z and W of a run, in the directions that it shows."""
    values, vectors = np.linalg.eigh(symmetrise(run.information))
    shown = values > OBSERVABLE
    V, known = vectors[:, shown], values[shown]
    away = (V.T @ run.descent) / known
    hung = (V.T @ run.sagged) / known
    own = np.diag(1.0 / known) + V.T @ run.beside @ V + np.outer(hung, hung)
    to_own: Square = np.linalg.inv(np.linalg.cholesky(own)).astype(np.float64, copy=False)
    return to_own @ away, symmetrise(to_own @ V.T @ run.joint @ V @ to_own.T)


def deviation(source: str, z: Floats, W: Square) -> Deviation:
    """Return how much a run deviates from all runs together."""
    values, vectors = np.linalg.eigh(np.eye(len(z)) - W)
    common = values > OWN
    along = vectors[:, common].T @ z
    square, freedom = float(np.sum(along**2 / values[common])), float(np.sum(common))
    return Deviation(source, square, freedom, probability_of(square, freedom))


def probability_of(chi_square: float, freedom: float) -> float:
    """Return the probability of a chi-square as large; 1 where there is nothing to compare."""
    return chi_square_chance(freedom, chi_square) if freedom >= FEWEST else 1.0


def scatter_of(
    runs: Sequence[OwnShare],
    sources: Sequence[str],
    estimates: Sequence[Estimate],
    held: tuple[str, ...] = (),
) -> RunScatter:
    """Return the scatter of runs whose own estimates are given, too, and what these hold."""
    each = [scaled(run) for run in runs]
    square = sum(float(z @ z) for z, _ in each)
    freedom = sum(len(z) - float(np.trace(W)) for z, W in each)
    deviations = (deviation(source, *one) for source, one in zip(sources, each, strict=True))
    return RunScatter(
        square,
        freedom,
        probability_of(square, freedom),
        tuple(deviations),
        spreads_of(estimates, held),
    )


def spreads_of(estimates: Sequence[Estimate], held: tuple[str, ...] = ()) -> tuple[Spread, ...]:
    """Return each parameter of the body over the runs that show it, if two do."""
    found: list[Spread] = []
    for name in (name for name in (*COM, *INERTIA) if name not in held):
        shown = [e.parameters[e.index(name)] for e in estimates if e.sees((name,))]
        if len(shown) > 1:
            found.append(spread_of(shown))
    return tuple(found)


def spread_of(shown: Sequence[Parameter]) -> Spread:
    """Return one parameter over the runs."""
    values, sd = np.array([p.value for p in shown]), np.array([p.sd for p in shown])
    return Spread(
        shown[0].name,
        shown[0].unit,
        len(shown),
        float(np.mean(values)),
        float(np.std(values, ddof=1)),
        float(np.sqrt(np.mean(sd**2))),
    )


def exceeds(scatter: RunScatter) -> bool:
    """Say whether runs scatter more than their sd lead to expect."""
    return scatter.probability < UNLIKELY


def verdict_of(scatter: RunScatter) -> Verdict:
    """Return whether the runs agree, and which of them do not."""
    numbers = {"count": len(scatter.deviations), "chi_square": scatter.chi_square,
               "freedom": scatter.freedom, "probability": scatter.probability,
               "factor": scatter.factor}  # fmt: skip
    if scatter.freedom < FEWEST:
        return Verdict((Reason(Why.RUNS_INCOMPARABLE, (), numbers),))
    if not exceeds(scatter):
        return Verdict((Reason(Why.RUNS_AGREE, (), numbers),))
    return Verdict(
        (Reason(Why.RUNS_SCATTER, (), numbers), Reason(Why.RUNS_DEVIATE, deviating(scatter)))
    )


def deviating(scatter: RunScatter) -> tuple[str, ...]:
    """Return which runs deviate most: one that errs pulls all others a little, too."""
    greatest = max(d.chi_square for d in scatter.deviations)
    return tuple(d.source for d in scatter.deviations if d.chi_square > MOST_OF * greatest)
