"""Lee's averaged integral (Eqs. 5-7): the rate replaced by a mean of rates, against noise.

As printed, with mean_k of the n rates before t_k and the first noisy rate for the momentum at t0:

    [ W(mean_k w) - W(w(t0)) + int w x W(w) ] p - int m r x g_B = -(k - k0) + int known

The mean is (n + 1) / 2 rows late while the integrals are not, which biases J (0.4 to 2.7 % at 100
Hz), and the first rate's noise is in every row. What is late is computed from the testbed's J, as
far as a mean about the row shows it, and reported (``Rows.omitted``).

Corrected: every term of the balance is averaged over the same n rows, and the constants are free.

    mean[ W(w) + int w x W(w) ] p - mean[ int m r x g_B ] - c = mean[ known side ]

Printed gravity columns lack g, and take their own first axis for the vertical (errata L1, L2): here
they are the regressor's. Cannot see what ``momentum`` cannot see.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.regression.formulations.columns import columns
from equipoise.estimation.regression.formulations.momentum import body_axes, by_piece
from equipoise.estimation.regression.formulations.rows import Posed, Rows
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.arrays import Floats, Ints
from equipoise.model.estimate import BODY

ROWS = 20  # in the mean, as methods compare


def running_means(values: Floats, n: int) -> Floats:
    """Return the mean of every n neighbouring rows."""
    total = np.cumsum(np.concatenate([np.zeros_like(values[:1]), values]), axis=0)
    return (total[n:] - total[:-n]) / n


def by_pieces(values: Floats, piece: Ints, n: int) -> Floats:
    """Return the running means within each piece, one after the other."""
    parts = [values[piece == k] for k in np.unique(piece)]
    return np.concatenate([running_means(part, n) for part in parts if len(part) >= n]
                          or [values[:0]])  # fmt: skip


def centred_means(posed: Posed) -> Rows:
    """Return the rows with every term averaged alike."""
    rows = body_axes(posed)
    assert rows.piece is not None
    A, b, t = (by_pieces(x, rows.piece, ROWS) for x in (rows.A, rows.b, rows.t))
    piece = by_pieces(rows.piece.astype(np.float64), rows.piece, ROWS)
    return replace(rows, t=t, A=A, b=b, piece=np.rint(piece).astype(np.int64))


def as_printed(posed: Posed) -> Rows:
    """Return the rows as printed, with gravity columns as they should be."""
    motion, n = posed.motion, ROWS
    at = columns(posed.recording, posed.testbed, motion[:3], posed.terms)
    gyroscopic = np.cross(motion.w[:, :, None], at.momentum, axis=1)
    push = at.shifted - np.cross(motion.w, at.known_momentum)
    parts = list[tuple[Floats, Floats, Floats, Floats]]()
    for k in np.unique(motion.piece):
        rows = np.flatnonzero(motion.piece == k)
        if len(rows) <= n:
            continue
        one = np.zeros(len(rows), np.int64)
        spun, pulled, pushed = (
            by_piece(motion.t[rows], x[rows], one) for x in (gyroscopic, at.torque, push)
        )
        means = running_means(at.momentum[rows], n)
        mean = means[:-1]  # of the n rows before each
        late = lateness(means, n) @ pack_symmetric(posed.testbed.body.inertia_P)
        left = mean - at.momentum[rows[0]] + spun[n:]
        known = at.known_momentum[rows] - at.impulse[rows]
        by_unknown = np.concatenate([left, -pulled[n:]], axis=2)
        right = pushed[n:] - (known[n:] - known[0])
        parts.append((motion.t[rows[n:]], by_unknown, right, late))
    none = np.zeros((0, 3))
    empty = (motion.t[:0], np.zeros((0, 3, 9 + len(posed.terms))), none, none)
    t, A, b, omitted = (np.concatenate([part[j] for part in parts or [empty]]) for j in range(4))
    return Rows(t, A, b, (*BODY, *posed.terms), omitted=omitted, notes=motion.notes)


def lateness(means: Floats, n: int) -> Floats:
    """Return by how much the mean of the n rows before each row lags behind the row.

    (n + 1) / n of what a mean of n rows about it is ahead; at the end, of the last one there is.
    """
    about = np.minimum(np.arange(len(means) - 1) + n // 2 + n % 2, len(means) - 1)
    return (n + 1) / n * (means[about] - means[:-1])
