"""Secant steps of several quantities at once, each toward the root of its own function.

Where d(x) falls to zero at the x sought, x <- x + d leads there, but takes long where d falls
slowly. From two points its slope is known, quantity by quantity (regula falsi):

    x <- x - d / slope,      slope = (d - d_before) / (x - x_before)

A slope that is steeper than -1, of the plain step, or is none, counts as -1; a flatter one as
-1 / ``BOLDEST`` at most. What the functions have in common is not counted.
"""

from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Floats

BOLDEST = 10.0  # plain steps at once, chosen


class Evaluated(NamedTuple):
    """Where the functions were evaluated, and what they were."""

    x: Floats
    d: Floats


def secant_step(now: Evaluated, before: Evaluated | None) -> Floats:
    """Return the next step of each x; the plain one where nothing was evaluated ``before``."""
    if before is None:
        return now.d
    way, change = now.x - before.x, now.d - before.d
    falls = way * change < 0
    slope = np.where(falls, change / np.where(falls, way, 1.0), -1.0)
    return -now.d / np.clip(slope, -1.0, -1.0 / BOLDEST)
