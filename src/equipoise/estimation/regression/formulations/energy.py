"""Energy balance (Tanygin and Williams 1997; Schwartz and Hall 2004): one row a time, no slopes.

    1/2 w^T J w - m r . g_B - E0 - sum_k c_k int w . T_k
        = int w . ( tau + dmu x g_B - h' ) - 1/2 w^T dJ w - 1/2 int w^T dJ' w

E0 is free in every piece; h' is the torque of what moves inside. (With dJ' the balance holds while
masses travel, which the printed form leaves out.) The mean square of the gyro's noise is constant
and goes into E0; its product with the motion stays, and biases J.

Uses one equation where the momentum has three, and is 5 to 10 times noisier for com; a rate
coupled from one axis to another does not disturb it. Cannot see what ``momentum`` cannot see.
"""

import numpy as np

from equipoise.estimation.regression.formulations.columns import columns, moved_masses
from equipoise.estimation.regression.formulations.momentum import by_piece
from equipoise.estimation.regression.formulations.rows import Posed, Rows
from equipoise.model.arrays import Floats
from equipoise.model.estimate import BODY


def energy(posed: Posed) -> Rows:
    """Return the rows."""
    motion, mass = posed.motion, posed.testbed.body.mass
    t, w, piece = motion.t, motion.w, motion.piece
    at = columns(posed.recording, posed.testbed, motion[:3], posed.terms)
    bend, h, _ = moved_masses(posed.recording, posed.testbed, t)
    slope_h, slope_J = (np.gradient(x, t, axis=0) for x in (h, bend))
    kinetic: Floats = 0.5 * np.einsum("ni,nij->nj", w, at.momentum)
    work = by_piece(t, np.einsum("ni,nij->nj", w, at.torque[:, :, 3:]), piece)
    A = np.concatenate([kinetic, -mass * at.g, -work], axis=1)
    given = np.sum(w * (at.shifted - slope_h), axis=1)
    given -= 0.5 * np.einsum("ni,nij,nj->n", w, slope_J, w)
    push = np.sum(0.5 * (w[1:] + w[:-1]) * np.diff(at.impulse, axis=0), axis=1)
    reported = np.append(0.0, np.cumsum(push))
    b = by_piece(t, given, piece) + reported - 0.5 * np.einsum("ni,nij,nj->n", w, bend, w)
    return Rows(t, A[:, None, :], b[:, None], (*BODY, *posed.terms), piece, notes=motion.notes)
