"""Euler's equations without gyroscopic term and products of inertia (Young 1998; review 8-9).

    w' = J_d^-1 ( m r x g_B + known - h' ),        J_d = diag J, taken as known

in increments, as printed, or summed from the start of each piece with a free constant:

    dw_k = Phi_k r + ...,    Phi_k = -(m T / 2) J_d^-1 ( [g_k x] + [g_(k+1) x] )

Differences of neighbouring rates are the noisiest data there are; the sums use the same model and
are 9 to 18 times better. What is left out, J_d^-1 ( w x J w + (J - J_d) w' ), moves r by some
|w|^2 dJ / (m g), 5 um at 3 deg/s: it is computed from the testbed's J and reported (``omitted``).

Cannot see J at all; com only as well as J is known.
"""

import numpy as np

from equipoise.estimation.regression.formulations.columns import Columns, columns
from equipoise.estimation.regression.formulations.momentum import by_piece
from equipoise.estimation.regression.formulations.rows import Posed, Rows
from equipoise.model.arrays import Floats, Matrix3, Series3
from equipoise.model.estimate import COM


def left_out(posed: Posed, w: Series3, inertia_P: Matrix3) -> Series3:
    """Return the integral of the torque that the model leaves out (n, 3), N m s."""
    t, piece = posed.motion.t, posed.motion.piece
    gyroscopic = by_piece(t, np.cross(w, w @ inertia_P), piece)
    products = w @ (inertia_P - np.diag(np.diag(inertia_P)))
    return -(gyroscopic + products)


def summed(posed: Posed) -> tuple[Columns, Rows]:
    """Return the rows with free constants."""
    motion, inertia_P = posed.motion, posed.testbed.body.inertia_P
    at = columns(posed.recording, posed.testbed, motion[:3], posed.terms)
    per = 1.0 / np.diag(inertia_P)
    A: Floats = by_piece(motion.t, at.torque, motion.piece) * per[:, None]
    known = by_piece(motion.t, at.shifted, motion.piece) + at.impulse - at.known_momentum
    omitted = left_out(posed, motion.w, inertia_P) * per
    names = (*COM, *posed.terms)
    return at, Rows(motion.t, A, motion.w - known * per, names, motion.piece, None, omitted,
                    motion.notes)  # fmt: skip


def integrated(posed: Posed) -> Rows:
    """Return the summed rows."""
    return summed(posed)[1]


def increments(posed: Posed) -> Rows:
    """Return the rows of neighbouring rates, as printed: by trapezes, without constants."""
    _, rows = summed(posed)
    motion = posed.motion
    within = np.diff(motion.piece) == 0
    assert rows.omitted is not None
    A, b, omitted = (np.diff(x, axis=0)[within] for x in (rows.A, rows.b, rows.omitted))
    middle = (0.5 * (motion.t[1:] + motion.t[:-1]))[within]
    return Rows(middle, A, b, rows.names, None, None, omitted, rows.notes)
