"""Momentum rows from one half of the samples, with instruments from the other half.

Every second row of each sensor makes the equations, the rows between make the same columns Z, read
at the same times. Both see the same motion, with noise that has nothing to do with each other's.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.motion.fused_motion import led_motion
from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.formulations.rows import Posed, Rows
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats
from equipoise.model.recording import Recording, Samples


def half(channel: Samples | None, first: int) -> Samples | None:
    """Return every second row."""
    if channel is None:
        return None
    return Samples(channel.t[first::2], np.ascontiguousarray(channel.values[first::2]))


def halved(posed: Posed, first: int) -> Rows:
    """Return the momentum rows of every second row of each sensor."""
    whole = posed.recording
    part: Recording = replace(
        whole, attitude=half(whole.attitude, first), rate=half(whole.rate, first)
    )
    return body_axes(replace(posed, recording=part, motion=led_motion(part, posed.testbed)))


def interpolated(rows: Rows, at: Rows) -> Floats:
    """Return the columns of rows at the times of others, piece by piece."""
    out = np.zeros_like(at.A)
    assert rows.piece is not None
    assert at.piece is not None
    for k in np.unique(at.piece):
        here, there = at.piece == k, rows.piece == k
        if not there.any():
            continue
        flat = rows.A[there].reshape(int(there.sum()), -1)
        out[here] = read_at(at.t[here], rows.t[there], flat).reshape(-1, *at.A.shape[1:])
    return out


def split(posed: Posed) -> Rows:
    """Return the rows and their instruments."""
    rows, others = halved(posed, 0), halved(posed, 1)
    return replace(rows, instruments=interpolated(others, rows)) if len(others.t) else rows
