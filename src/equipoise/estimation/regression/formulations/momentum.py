"""Momentum balance integrated from the start of each piece, in body or in laboratory axes.

Body axes (da Silva 2021 Eqs. 16-21 with the t0 terms restored; Kim and Agrawal 2009; Lee Eq. 6):

    W(w) p + int w x W(w) p - int m r x g_B - int T c - H0 = -k - int w x k + int (dmu x g_B + tau)

Laboratory axes, where no gyroscopic term is left:

    R W(w) p - int R (m r x g_B) - int R T c - H0_N = -R k + int R (dmu x g_B + tau)

H0 is free in every piece: taking the first noisy rate for it would cost a factor 13 to 22 in sd.
Restarted, pieces are cut, so that neither drift nor what is left of a gyro's bias adds up.

Assumes rates good enough to stand in the regressor: their noise biases J towards zero. Cannot see
the common scale of J and com without a known change, nor J_zz and the products without spin about
more than one axis.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.regression.formulations.columns import Columns, columns
from equipoise.estimation.regression.formulations.rows import Posed, Rows
from equipoise.maths.sampled.running_integral import by_parabolas
from equipoise.model.arrays import Floats, Ints, Series1, Series3
from equipoise.model.estimate import BODY

RESTART = 20.0  # s, chosen: within the 10 to 30 s in which a gyro drifts little


def integral(t: Series1, rate: Floats) -> Floats:
    """Return the running integral of a series along its first axis."""
    if len(t) < 3:
        return np.concatenate([[0 * rate[0]], np.cumsum(np.diff(t) * rate[:-1].T, axis=-1).T])
    return by_parabolas(t, rate)


def by_piece(t: Series1, rate: Floats, piece: Ints) -> Floats:
    """Return the running integral from the start of each piece."""
    out = np.empty_like(rate)
    for k in np.unique(piece):
        rows = piece == k
        out[rows] = integral(t[rows], rate[rows])
    return out


def body_balance(t: Series1, w: Series3, piece: Ints, at: Columns) -> tuple[Floats, Floats]:
    """Return A and b in body axes."""
    gyroscopic = np.cross(w[:, :, None], at.momentum, axis=1)
    push = at.shifted - np.cross(w, at.known_momentum)
    left = at.momentum + by_piece(t, gyroscopic, piece)
    A = np.concatenate([left, -by_piece(t, at.torque, piece)], axis=2)
    return A, by_piece(t, push, piece) + at.impulse - at.known_momentum


def laboratory_balance(t: Series1, piece: Ints, at: Columns) -> tuple[Floats, Floats]:
    """Return A and b in laboratory axes."""
    k, push = (np.einsum("nij,nj->ni", at.R, x) for x in (at.known_momentum, at.shifted))
    A = np.concatenate([at.R @ at.momentum, -by_piece(t, at.R @ at.torque, piece)], axis=2)
    return A, by_piece(t, push, piece) + known_side(at) - k


def known_side(at: Columns) -> Series3:
    """Return the integral of R tau (n, 3), N m s: R is even where tau may jump."""
    middle, parts = 0.5 * (at.R[1:] + at.R[:-1]), np.diff(at.impulse, axis=0)
    total = np.cumsum(np.einsum("nij,nj->ni", middle, parts), axis=0)
    return np.concatenate([np.zeros((1, 3)), total])


def body_axes(posed: Posed) -> Rows:
    """Return the rows in body axes."""
    motion = posed.motion
    at = columns(posed.recording, posed.testbed, motion[:3], posed.terms)
    A, b = body_balance(motion.t, motion.w, motion.piece, at)
    return Rows(motion.t, A, b, (*BODY, *posed.terms), motion.piece, notes=motion.notes)


def laboratory_axes(posed: Posed) -> Rows:
    """Return the rows in laboratory axes."""
    motion = posed.motion
    at = columns(posed.recording, posed.testbed, motion[:3], posed.terms)
    A, b = laboratory_balance(motion.t, motion.piece, at)
    return Rows(motion.t, A, b, (*BODY, *posed.terms), motion.piece, notes=motion.notes)


def segments(posed: Posed) -> Rows:
    """Return the rows in body axes, with the integral restarted every ``RESTART``."""
    motion = posed.motion
    cut = replaced_pieces(motion.t, motion.piece)
    return body_axes(replace(posed, motion=motion._replace(piece=cut)))


def replaced_pieces(t: Series1, piece: Ints) -> Ints:
    """Return pieces of equal length within the given ones, none longer than ``RESTART``."""
    out = np.zeros_like(piece)
    for k in np.unique(piece):
        rows = piece == k
        span = t[rows] - t[rows][0]
        parts = max(int(np.ceil(span[-1] / RESTART)), 1)
        share = np.minimum(span / max(span[-1], 1e-12) * parts, parts - 1e-9)
        out[rows] = share.astype(np.int64) + (out.max() + 1 if k else 0)
    return out
