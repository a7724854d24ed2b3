"""Balances behind Han's tracking differentiators, as Xu (2015) uses them.

With F = 1 / (1 + h0 s)^2, one differentiator in its linear zone, and the momentum balance

    A x + c = b,    A = W(w) + int w x W(w) | - int (m r x g_B) | ...

``tracking``: slope behind two in series, F F d/dt of both sides: the balance of torques, 4 h0 late,
without constants (TD-TD). ``extended``: F of both sides, 2 h0 late: the filtered integrals of the
extended differentiator, no w' at all, a free constant for each piece (ETD).

Filtering the balance as a whole is filtering each of its terms alike, products and known torques
among them: differentiating w alone would set its slope against torques that are 4 h0 younger, and
bias J. Rows come in time order as a live record gives them, and describe the motion so much
earlier. The first ``SETTLING`` h0 of each piece are left out: there the filters remember that they
began at rest.

Noise pulls J towards zero as in any regression: that of the slope with h0^-3, of F alone with
1 / h0. Cannot see what ``momentum`` cannot see.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.formulations.rows import Posed, Rows
from equipoise.estimation.regression.formulations.torque import evenly
from equipoise.maths.sampled.tracking_differentiator import pace_for, track, track_twice
from equipoise.model.arrays import Floats, Ints, Series, Series1

PERIODS = 10  # chosen: h0 in rows, of Xu's 5 to 10; noise of w' falls with its cube
SETTLING = 12.0  # h0, chosen: (1 + 12) exp(-12) = 8e-5 of the start is left


def tracking(values: Series, period: float) -> tuple[Series, int, float]:
    """Return the slope of even rows behind two of them, its first row, how much earlier (s)."""
    h0, t = PERIODS * period, period * np.arange(len(values), dtype=np.float64)
    out = track_twice(pace_for(values, h0), t, values)
    first = min(round(2 * SETTLING * PERIODS), len(values))
    return out.slope[first:], first, 4 * h0


def extended(posed: Posed) -> Rows:
    """Return the rows of the momentum balance behind one differentiator."""
    rows = body_axes(posed)
    n, m, c = rows.A.shape
    assert rows.piece is not None
    flat = np.concatenate([rows.A.reshape(n, m * c), rows.b], axis=1)
    parts = list[tuple[Series1, Floats, Ints]]()
    for k in np.unique(rows.piece):
        mine = rows.piece == k
        grid, values, period = evenly(rows.t[mine], flat[mine])
        h0, first = PERIODS * period, round(SETTLING * PERIODS)
        value = track(pace_for(values, h0), grid, values).value[first:]
        late = grid[first:] - 2 * h0
        parts.append((late, value, np.full(len(late), k, dtype=np.int64)))
    t, found, piece = (np.concatenate([part[j] for part in parts]) for j in range(3))
    A, b = found[:, : m * c].reshape(-1, m, c), found[:, m * c :]
    return replace(rows, t=t, A=A, b=b, piece=piece)
