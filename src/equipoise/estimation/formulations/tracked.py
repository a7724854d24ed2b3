"""Torque or momentum balance, every term through the same tracking differentiators (Xu 2015).

With F one differentiator, 1 / (1 + h0 s)^2, and every term of

    W(w)' p + w x W(w) p - m r x g_B - T c = known - k' - w x k

``twice``: all terms through F F, W(w)' and k' as the slope of the second; no constants.
``integrals``: W(w) and k through F, the integral of all other terms through F as F's own integrator
gives it (extended differentiator): no w' at all, and a free constant for each piece.

F is linear at the pace chosen here and the same for every term: w and g, the known torque, momenta
and products are all 2 h0 late (4 h0), so that the equation stays true of constant J and com.
Differentiating w alone would set its slope against torques that are 4 h0 younger, and bias J. Rows
come in time order as a live record gives them, and describe the motion so much earlier. The first
``SETTLING`` h0 of each piece are left out: there the filters remember that they began at rest.

Noise pulls J towards zero as in any regression: that of w' with h0^-3 (``twice``), that of w with
1 / h0 (``integrals``). Cannot see the common scale of J and com without a known change, nor J_zz
and the products without spin about more than one axis.
"""

import numpy as np

from equipoise.estimation.formulations.differentiated import (
    balance,
    equations,
    gathered,
    momentum_noise,
    period_of,
    without_constants,
)
from equipoise.estimation.formulations.rows import Posed, Rows
from equipoise.maths.tracking_differentiator import pace_for, track, track_twice
from equipoise.model.arrays import Floats, Ints, Series, Series1, Vector3

PERIODS = 10  # chosen: h0 in rows, of Xu's 5 to 10; noise of w' falls with its cube
SETTLING = 12.0  # h0, chosen: (1 + 12) exp(-12) = 8e-5 of the start is left


def lag(t: Series1) -> float:
    """Return h0, s."""
    return PERIODS * period_of(t)


def filtered(posed: Posed, twice: bool) -> Rows:
    """Return the rows of either kind."""
    motion, terms = posed.motion, balance(posed)
    signal = np.hstack([terms.changing, terms.acting.reshape(len(motion.t), -1)])
    parts, h0 = list[tuple[Ints, Floats, Floats]](), lag(motion.t)
    for k in np.unique(motion.piece):
        rows = np.flatnonzero(motion.piece == k)
        t = motion.t[rows]
        settled = t - t[0] > SETTLING * h0 * (2 if twice else 1)
        changing, acting = through(t, signal[rows], h0, twice)
        A, b = equations(
            changing[settled], acting[settled].reshape(-1, *terms.acting.shape[1:])
        )  # fmt: skip
        parts.append((rows[settled], A, b))
    return gathered(posed, parts)


def through(t: Series1, signal: Series, h0: float, twice: bool) -> tuple[Series, Series]:
    """Return what changes (six columns) and what acts, behind one or two differentiators."""
    pace = pace_for(signal, h0)
    if twice:
        out = track_twice(pace, t, signal)
        return out.slope[:, :6], out.value[:, 6:]
    out = track(pace, t, signal)
    return out.value[:, :6], out.integral[:, 6:]


def twice(posed: Posed) -> Rows:
    """Return torque rows behind two differentiators in series."""
    return without_constants(filtered(posed, True))


def integrals(posed: Posed) -> Rows:
    """Return momentum rows behind one extended differentiator."""
    return filtered(posed, False)


def twice_noise(posed: Posed) -> Vector3:
    """Return one sd of each equation of ``twice`` (N m): white noise behind s F F."""
    t = posed.motion.t
    return np.sqrt(period_of(t) / (32.0 * lag(t) ** 3)) * momentum_noise(posed)


def integrals_noise(posed: Posed) -> Vector3:
    """Return one sd of each equation of ``integrals`` (N m s): white noise behind F."""
    t = posed.motion.t
    return np.sqrt(period_of(t) / (4.0 * lag(t))) * momentum_noise(posed)
