"""Torque balance at every row, filtered as a whole: the slope of the momentum by a running fit.

    W(w)' p + w x W(w) p - m r x g_B - T c = known - k' - w x k

(da Silva 2021 Eqs. 11-13 with Lee's signs of the products, errata R5 and R7; Lee Eq. 3 with u_c on
the right, erratum L5.) The slopes of w and k are Savitzky and Golay's over the last ``WINDOW``
seconds; every other term is the mean over the same window that such a slope is of the true one
(``running_slope``). The equation stays true whatever the torque does: filtering the slope alone
biases J by 0.5 to 1.6 % with square waves. A row stands for the middle of its window and comes at
its end.

Noise in w' pulls J towards zero by its share in the square of w'; a longer window has less noise
and less signal. Cannot see the common scale of J and com without a known change, nor J_zz and the
products without spin about more than one axis.
"""

from typing import NamedTuple

import numpy as np

from equipoise.estimation.formulations.columns import columns
from equipoise.estimation.formulations.rows import BODY, Posed, Rows
from equipoise.maths.running_slope import running_slope
from equipoise.model.arrays import Floats, Ints, Series, Series1, Series3, Vector3
from equipoise.model.testbed import Testbed

WINDOW = 1.0  # s, chosen: noise of 0.05 deg/s at 100 Hz leaves 3e-4 rad/s2 in the slope
IN_WINDOW = 25  # chosen: rows of the balance in each window; more would say the same again
UNKNOWN = 1e-3  # rad/s, chosen: noise of rates that no gyro of the testbed gives
TOO_SHORT = "a piece of the record is shorter than the filter and is not used"


class Balance(NamedTuple):
    """The balance of torques; what is known is the last column of ``acting``, and k."""

    changing: Series  # (n, 6) w (rad/s) and k (N m s), of which the slope is taken
    acting: Floats  # (n, 3, c + 1) w x W | -torque | known - w x k, of which it is not


def momentum_matrix(w: Series3) -> Floats:
    """Return W(w), shape (n, 3, 6): W(w) p = J w."""
    out = np.zeros((len(w), 3, 6))
    out[:, 0, [0, 3, 4]] = w
    out[:, 1, [1, 3, 5]] = w[:, [1, 0, 2]]
    out[:, 2, [2, 4, 5]] = w[:, [2, 0, 1]]
    return out


def balance(posed: Posed) -> Balance:
    """Return what acts and what changes at every row of the motion."""
    w = posed.motion.w
    at = columns(posed.recording, posed.testbed, posed.motion[:3], posed.terms)
    acting = np.empty((len(w), 3, 7 + at.torque.shape[2]))
    for column in range(6):
        acting[:, :, column] = np.cross(w, at.momentum[:, :, column])
    acting[:, :, 6:-1] = -at.torque
    acting[:, :, -1] = at.known_torque - np.cross(w, at.known_momentum)
    return Balance(np.hstack([w, at.known_momentum]), acting)


def equations(changing: Series, acting: Floats) -> tuple[Floats, Floats]:
    """Return A and b of a balance that has been through a filter: its slope or its integral."""
    A, b = acting[:, :, :-1].copy(), acting[:, :, -1] - changing[:, 3:]
    A[:, :, :6] += momentum_matrix(changing[:, :3])
    return A, b


def rate_noise(testbed: Testbed) -> float:
    """Return one sd of a rate's row (rad/s)."""
    return testbed.gyro.noise if testbed.gyro and testbed.gyro.noise > 0 else UNKNOWN


def period_of(t: Series1) -> float:
    """Return the median step, s."""
    return float(np.median(np.diff(t))) if len(t) > 1 else 1.0


def gathered(posed: Posed, parts: list[tuple[Ints, Floats, Floats]]) -> Rows:
    """Return the rows that the pieces of a record came to: which they are, A and b."""
    c, motion = len(BODY) + len(posed.terms), posed.motion
    which = np.concatenate([np.zeros(0, np.int64), *(part[0] for part in parts)])
    A = np.concatenate([np.zeros((0, 3, c)), *(part[1] for part in parts)])
    b = np.concatenate([np.zeros((0, 3)), *(part[2] for part in parts)])
    lost = () if all(len(part[0]) for part in parts) else (TOO_SHORT,)
    told = (*motion.left_out, *lost)
    return Rows(motion.t[which], A, b, (*BODY, *posed.terms), motion.piece[which], left_out=told)


def smoothed_slope(posed: Posed) -> Rows:
    """Return the rows, each at the end of its window."""
    motion, terms = posed.motion, balance(posed)
    parts = list[tuple[Ints, Floats, Floats]]()
    for k in np.unique(motion.piece):
        rows = np.flatnonzero(motion.piece == k)
        windows, flat = windows_of(len(rows), window_rows(motion.t)), terms.acting[rows]
        slope, mean = running_slope(
            motion.t[rows], terms.changing[rows], flat.reshape(len(rows), -1), windows
        )
        A, b = equations(slope, mean.reshape(-1, *flat.shape[1:]))
        parts.append((rows[windows[:, 1] - 1], A, b))
    return without_constants(gathered(posed, parts))


def without_constants(rows: Rows) -> Rows:
    """Return rows of a balance of torques: nothing in them is integrated from a start."""
    return Rows(rows.t, rows.A, rows.b, rows.names, left_out=rows.left_out)


def window_rows(t: Series1) -> int:
    """Return the rows of a window, an odd number."""
    return max(2 * round(0.5 * WINDOW / period_of(t)) + 1, 5)


def windows_of(n: int, window: int) -> Ints:
    """Return where windows begin and end in a piece of n rows, none when it is too short."""
    first = np.arange(0, max(n - window + 1, 0), max(window // IN_WINDOW, 1), dtype=np.int64)
    return np.column_stack([first, first + window])


def slope_noise(posed: Posed) -> Vector3:
    """Return one sd of each equation (N m): that of the slope, times the guessed moments."""
    t = posed.motion.t
    share = np.sqrt(12.0 / window_rows(t) ** 3) / period_of(t)
    return share * momentum_noise(posed)


def momentum_noise(posed: Posed) -> Vector3:
    """Return one sd of a momentum (N m s): the rates' noise, times the guessed moments."""
    return rate_noise(posed.testbed) * np.diag(posed.testbed.body.inertia_P)
