"""The moments of moves sideways that leave least of a swing.

A platform swings about where its centre of mass leans it. When masses level it, the swing goes on
about level, with the amplitude that it has about level at that moment. Along a horizontal axis e,
with n the vertical in body axes,

    a^2 = (n.e)^2 + ((n x w).e)^2 / w_n^2           n' = n x w: its derivative in the body

which is nothing for a platform let go from level, once in every swing. Swings along both axes are
out of step, so each axis has a moment of its own. The first WATCH swings are observed; an axis is
levelled when its a comes NEAR the least of them again, and after PATIENCE swings in any case.

(Coupling by products of inertia, and spin, are left out: they make a moment less good.)
"""

from typing import NamedTuple

import numpy as np

from equipoise.control.law import Sample
from equipoise.maths.attitude import level, to_matrix
from equipoise.maths.linalg import cross
from equipoise.model.arrays import Floats, Series, Vector3

WATCH = 1.2  # swings, chosen: one, and a part for an error of the period
NEAR = 1.15  # of the least amplitude, chosen: a moment as good
SMALL = 0.003  # rad, chosen: an amplitude that integral and coils soon remove
PATIENCE = 2.5  # swings, chosen


class Waiting(NamedTuple):
    """For the moments to level both axes."""

    shift: Vector3  # m, to end with
    swing: float  # rad/s, w_n
    since: float | None = None  # s
    least: tuple[float, float] = (np.inf, np.inf)  # rad, amplitudes so far
    done: tuple[bool, bool] = (False, False)


def across(up: Vector3) -> Series:
    """Return the two axes that masses level, (2, 3)."""
    return to_matrix(level(up))[:2]


def amplitudes(sample: Sample, up: Vector3, swing: float) -> Floats:
    """Return the amplitudes of the swings along both axes about level, (2,) rad."""
    n = -sample.gravity / float(np.linalg.norm(sample.gravity))
    return np.hypot(across(up) @ n, across(up) @ cross(n, sample.rate) / swing)


def watched(
    waiting: Waiting, sample: Sample, up: Vector3, shift: Vector3
) -> tuple[Waiting, Vector3]:
    """Return the wait after a sample, and the shift to request (m), ``shift`` being the last."""
    since = sample.t if waiting.since is None else waiting.since
    swings = (sample.t - since) * waiting.swing / (2 * np.pi)
    requested, least, done = shift, list(waiting.least), list(waiting.done)
    for k, now in enumerate(amplitudes(sample, up, waiting.swing)):
        good = swings > WATCH and now < max(NEAR * least[k], SMALL)
        if not done[k] and (good or swings > PATIENCE):
            axis = across(up)[k]
            requested, done[k] = requested + axis * (axis @ (waiting.shift - requested)), True
        least[k] = min(float(now), least[k])
    remembered = waiting._replace(since=since, least=(least[0], least[1]), done=(done[0], done[1]))
    return remembered, waiting.shift if all(done) else requested
