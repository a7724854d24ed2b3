"""Increments of the rate in the simplified model: com alone (da Silva 2021 Eqs. 8-9; Young 1998).

    w_(k+1) - w_k = J_d^-1 (dt/2) sum of (m r x g_B + T c + known) at k and k + 1,  less J_d^-1 dk

J_d is the diagonal of the testbed's J. The gyroscopic torque and the products of inertia are left
out of the motion, as published; that errs by about |w|^2 dJ / (m g): 5 um at 3 deg/s, over 100 um
at 20 deg/s on a platform of 14 kg. The signs are those of the paper's Eq. 6: its Eq. 15 has the
other sign (erratum R5), and both in one procedure would double the imbalance.

Assumes that J is right: com errs by as large a share as J does. Cannot see com along gravity
without tilt, nor anything of J. Increments of neighbouring rows are the noisiest of all data, and
noise that two of them share is taken for two: the same information integrated gives a tenth of the
sd.
"""

import numpy as np

from equipoise.estimation.formulations.columns import columns
from equipoise.estimation.formulations.differentiated import rate_noise
from equipoise.estimation.formulations.rows import Posed, Rows
from equipoise.model.arrays import Vector3
from equipoise.model.estimate import COM

LEFT_OUT = "gyroscopic torque and products of inertia: com is off by about |w|^2 dJ / (m g)"


def increments(posed: Posed) -> Rows:
    """Return one row for each pair of neighbours."""
    motion = posed.motion
    at = columns(posed.recording, posed.testbed, motion[:3], posed.terms)
    pair = np.flatnonzero(np.diff(motion.piece) == 0)
    half = 0.5 * np.diff(motion.t)[pair]
    moments = np.diag(posed.testbed.body.inertia_P)
    torque = (at.torque[pair] + at.torque[pair + 1]) * half[:, None, None]
    push = (at.known_torque[pair] + at.known_torque[pair + 1]) * half[:, None]
    known = push - np.diff(at.known_momentum, axis=0)[pair]
    b = np.diff(motion.w, axis=0)[pair] - known / moments
    A, names = torque / moments[:, None], (*COM, *posed.terms)
    return Rows(motion.t[pair + 1], A, b, names, left_out=(*motion.left_out, LEFT_OUT))


def increment_noise(posed: Posed) -> Vector3:
    """Return one sd of each equation (rad/s)."""
    return np.full(3, 2**0.5 * rate_noise(posed.testbed))
