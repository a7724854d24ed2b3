"""Rows at which the platform is at its stop: it tilts to its limit, within what sensors tell."""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from equipoise.maths.attitude import tilt
from equipoise.model.arrays import Bools
from equipoise.model.recording import Samples, runs
from equipoise.model.testbed import Testbed

ROWS = 3  # in a median, chosen: one bad row decides nothing
BRIEF = 2.0  # s, chosen: near its turning point a swing stays by its greatest tilt for so long
Span = tuple[float, float]  # s


def at_stop(attitude: Samples, testbed: Testbed) -> Bools:
    """Return for each row (n,) whether the median of it and its neighbours is at the stop."""
    lean = tilt(attitude.values, testbed.up)
    if len(lean) < ROWS:
        return np.full(len(lean), bool(len(lean)) and np.median(lean) > testbed.tilt_at_stop)
    middles = np.median(sliding_window_view(lean, ROWS), axis=1)
    return np.pad(middles, ROWS // 2, mode="edge") > testbed.tilt_at_stop


def spans_at_stop(attitude: Samples, testbed: Testbed) -> list[Span]:
    """Return from when to when (s) rows are at the stop."""
    t, found = attitude.t, runs(at_stop(attitude, testbed))
    return [(float(t[first]), float(t[last])) for first, last in found]
