"""Where the centre of mass of a sagging platform must be for it to act as a stiff one.

A platform that sags has the lever r + C n, n = g_B / g. Gravity turns it as it turns a stiff one
with the centre of mass r_t where (r + C n - r_t) x n = 0, which leaves the part along n open. It is
chosen such that r stays at one height, as balancing left it (``dynamics.sag_trim.acting_com``):

    r(n) = r_t + allowance(n),    allowance(n) = ((a + u.C n) / u.n) n - C n
    a = u.C u - (tr C - u.C u) / 2

where u points up. Level, n = -u, r_t is the acting centre of mass. Masses that follow the tilt go
sideways, by what the sag along both horizontal axes differs; what it has in common is in a.

Cannot be used at 90 deg, where u.n = 0.
"""

from dataclasses import replace

import numpy as np

from equipoise.dynamics.sag_trim import SAG_TERMS, sag_matrix
from equipoise.estimation.tracker.known_sag import SAG
from equipoise.estimation.tracker.predict_correct import COM
from equipoise.estimation.tracker.tracker import State
from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Floats, Matrix3, Quaternion, Vector3


def allowance(sag: Matrix3, q: Quaternion, up: Vector3) -> Vector3:
    """Return r(n) - r_t (m) at an attitude."""
    down: Vector3 = -to_matrix(q)[2]
    height = up @ sag @ up
    level = height - 0.5 * (np.trace(sag) - height)
    return (level + up @ sag @ down) / (up @ down) * down - sag @ down


def allowances(q: Quaternion, up: Vector3) -> Floats:
    """Return what each of the five coefficients adds to it, (3, 5)."""
    return np.column_stack([allowance(sag_matrix({name: 1.0}), q, up) for name in SAG_TERMS])


def as_stiff(state: State, up: Vector3) -> State:
    """Return the state of the stiff platform that acts alike at its attitude.

    Its r and the covariance of r with all else are those of r - allowance.
    """
    if state.sag is None:
        return state
    by_sag, T = allowances(state.q, up), np.eye(len(state.covariance))
    T[COM, SAG] = -by_sag
    com: Vector3 = state.com - by_sag @ state.sag
    return replace(state, com=com, covariance=T @ state.covariance @ T.T)
