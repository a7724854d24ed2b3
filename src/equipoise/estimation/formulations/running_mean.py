"""Momentum rows, every term averaged over the same running window (Lee Eqs. 5-7, corrected).

    mean_n [ W(w) p + int ... - H0 ] = mean_n [ -k + int ... ]

Lee puts the mean of the n samples before t_k for w(t_k) and leaves the integrals at t_k: the mean
is (n + 1) / 2 samples late, and J off by 0.4 to 2.7 % (erratum L7). Here the whole equation is
averaged, which keeps it true; H0 is a free constant of each piece. A row stands for the middle of
its window and comes at its end.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.formulations.differentiated import momentum_noise
from equipoise.estimation.formulations.momentum import body_axes
from equipoise.estimation.formulations.rows import Posed, Rows
from equipoise.model.arrays import Floats, Vector3

SAMPLES = 20  # n, Lee's order of size; at 100 Hz a window of 0.2 s


def running_mean(values: Floats) -> Floats:
    """Return the means of ``SAMPLES`` rows in line, that many less one fewer."""
    total = np.concatenate([np.zeros((1, *values.shape[1:])), np.cumsum(values, axis=0)])
    return (total[SAMPLES:] - total[:-SAMPLES]) / SAMPLES


def averaged(posed: Posed) -> Rows:
    """Return the rows, each at the end of its window, none of which reaches over a gap."""
    rows = body_axes(posed)
    assert rows.piece is not None
    last = np.arange(SAMPLES - 1, len(rows.t))
    whole = rows.piece[last] == rows.piece[last - SAMPLES + 1]
    A, b = running_mean(rows.A)[whole], running_mean(rows.b)[whole]
    return replace(rows, t=rows.t[last][whole], A=A, b=b, piece=rows.piece[last][whole])


def averaged_noise(posed: Posed) -> Vector3:
    """Return one sd of each equation (N m s)."""
    return SAMPLES**-0.5 * momentum_noise(posed)
