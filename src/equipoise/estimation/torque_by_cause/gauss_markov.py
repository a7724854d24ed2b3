"""The unmodelled torque as a Gauss-Markov process beside all other unknowns, smoothed.

Stretch k of a record has unknowns x_k at its beginning, d_k their deviation from the point about
which the motion is linear, and the local model A_k, b_k of its own rows (``segments``). Onward

    d_(k+1) = F_k d_k + o_k + E u_k,      u_k ~ N(0, Q),       F = [ Phi ; 0 diag(a) ]

    a = exp(-dt / T),    Q = s^2 (1 - a^2)      of the torque's three coordinates, s its sd
    o                    gap from the end of the motion of k to the point of k + 1; a x_k - x_(k+1)
                         of the torque. What an event changes has a wide Q beside.

Backwards, with M = P_uu + Q^-1, the information and score of all rows from k on follow,

    P' = P - P_u^T M^-1 P_u,     p' = p - P_u^T M^-1 p_u
    P <- A_k + F^T P' F,         p <- b_k + F^T (p' - P' o)

then forwards the mean and the covariance given all rows (Rauch, Tung and Striebel 1965). The same
pass gives -2 ln p(rows | s, T) (Schweppe 1965), all unknowns integrated out.

Rows show a torque only as torque / J. A torque of stated size would pull J small, so that it takes
fewer sd (``drift_scale`` says the same of jumps of com). The process is therefore one of

    nu = tau / c,     c = 1 + l^T d,     l = d(ln tr J across)/dx

and x = (I + E tau_k l^T) z of the coordinates z in which the torque's three are nu: rows say
nothing of c then but by what is known to change.

Cannot see the torque from a term that moves alike: a constant torque from com across gravity where
the platform stays level. The covariance says so.
"""

from typing import NamedTuple

import numpy as np

from equipoise.estimation.events.record_model import log_det
from equipoise.maths.linalg import inverse_spd, symmetrise
from equipoise.model.arrays import Floats, Ints, Series, Square


class Chain(NamedTuple):
    """The stretches of a record, linear about a point each."""

    normal: Floats  # (K, n, n) A
    descent: Floats  # (K, n) b
    onward: Floats  # (K - 1, 6, n) Phi
    seconds: Floats  # (K - 1,) from each beginning to the next
    carrier: Ints  # (3,) coordinates of the unmodelled torque
    torque: Series  # (K, 3) N m, nu of the points about which it is linear
    gaps: Floats  # (K - 1, n) o, but for the torque's coordinates
    events: tuple[Ints, ...]  # (K - 1) coordinates that an event may change at each cut
    event_sd: tuple[float, ...]  # (K - 1) of these, as wide as events are
    prior: Square  # (n, n) information, without the torque's
    prior_score: Floats  # (n,)
    height: float = 0.0  # -2 ln of how high the prior is at the points, less what models share


class Process(NamedTuple):
    """A Gauss-Markov torque, the same about each axis."""

    sd: float  # N m
    correlation: float  # s


class Step(NamedTuple):
    """One cut: what changes there by itself, and how."""

    F: Square  # (n, n)
    free: Ints  # (a,) coordinates of u
    offset: Floats  # (n,) o
    weight: Floats  # (a,) 1 / Q


class Steps(NamedTuple):
    """What the pass backwards leaves of each cut."""

    gain: list[Floats]  # M^-1 P_u F
    firm: list[Floats]  # M^-1 (p_u - P_u o)
    spread: list[Square]  # M^-1


class Course(NamedTuple):
    """Deviations given all rows, stretch by stretch."""

    mean: Series  # (K, n)
    covariance: Floats  # (K, n, n)
    onward: Floats  # (K - 1, n, n) F - E G: of d_k, what d_(k+1) keeps
    fresh: Floats  # (K - 1, n, n) covariance of what is new in d_(k+1)


def step_at(chain: Chain, k: int, process: Process) -> Step:
    """Return what happens at a cut."""
    n, events = chain.normal.shape[-1], chain.events[k]
    stay = float(np.exp(-chain.seconds[k] / process.correlation))
    F = np.eye(n)
    F[:6] = chain.onward[k]
    F[chain.carrier, chain.carrier] = stay
    offset = chain.gaps[k].copy()
    offset[chain.carrier] = stay * chain.torque[k] - chain.torque[k + 1]
    spread = process.sd**2 * -np.expm1(-2 * chain.seconds[k] / process.correlation)
    weight = np.append(np.full(3, 1 / spread), np.full(len(events), chain.event_sd[k] ** -2))
    return Step(F, np.append(chain.carrier, events), offset, weight)


def with_torque(chain: Chain, process: Process) -> tuple[Square, Floats]:
    """Return information and score of the priors of the first stretch, the torque's included."""
    information, score = chain.prior.copy(), chain.prior_score.copy()
    information[chain.carrier, chain.carrier] += process.sd**-2
    score[chain.carrier] -= chain.torque[0] / process.sd**2
    return information, score


def backward(chain: Chain, process: Process) -> tuple[Square, Floats, float, Steps]:
    """Return P, p of the first stretch with its priors, -2 ln p but for a constant, and the steps.

    LinAlgError where the information is not positive definite.
    """
    kept = Steps([], [], [])
    info, score, total = chain.normal[-1].copy(), chain.descent[-1].copy(), 0.0
    for k in range(len(chain.onward) - 1, -1, -1):
        at = step_at(chain, k, process)
        P_u, p_u = info[at.free], score[at.free]
        M = P_u[:, at.free] + np.diag(at.weight)
        spread = inverse_spd(M)
        total -= float(p_u @ spread @ p_u) + log_det(spread) + float(np.sum(np.log(at.weight)))
        info, score = info - P_u.T @ spread @ P_u, score - P_u.T @ (spread @ p_u)
        moved = info @ at.offset
        total += float(at.offset @ moved) - 2 * float(score @ at.offset)
        kept.gain.append(spread @ P_u @ at.F)
        kept.firm.append(spread @ (p_u - P_u @ at.offset))
        kept.spread.append(spread)
        info = symmetrise(chain.normal[k] + at.F.T @ info @ at.F)
        score = chain.descent[k] + at.F.T @ (score - moved)
    prior, pull = with_torque(chain, process)
    info, score = info + prior, score + pull
    mean = inverse_spd(info) @ score
    total += float(np.sum(chain.torque[0] ** 2)) / process.sd**2 - float(mean @ score)
    return info, score, total - log_det(inverse_spd(info)) + 6 * float(np.log(process.sd)), kept


def improbability(chain: Chain, process: Process) -> float:
    """Return -2 ln of how probable the rows are with this torque, but for a constant."""
    try:
        return backward(chain, process)[2] + chain.height
    except np.linalg.LinAlgError:
        return np.inf


def smoothed(chain: Chain, process: Process) -> Course:
    """Return the deviations of all stretches given all rows."""
    P, p, _, kept = backward(chain, process)
    count, n = chain.descent.shape
    mean, covariance = np.zeros((count, n)), np.zeros((count, n, n))
    onward, fresh = np.zeros((2, count - 1, n, n))
    covariance[0] = inverse_spd(P)
    mean[0] = covariance[0] @ p
    for k in range(count - 1):
        at, j = step_at(chain, k, process), count - 2 - k
        onward[k] = at.F
        onward[k][at.free] -= kept.gain[j]
        fresh[k][np.ix_(at.free, at.free)] = kept.spread[j]
        mean[k + 1] = onward[k] @ mean[k] + at.offset
        mean[k + 1, at.free] += kept.firm[j]
        covariance[k + 1] = symmetrise(onward[k] @ covariance[k] @ onward[k].T + fresh[k])
    return Course(mean, covariance, onward, fresh)
