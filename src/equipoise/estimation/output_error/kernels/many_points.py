"""One problem at many points at once: the peaks of each motion, and its information.

For a search that asks the same of many platforms: what is worked out around a kernel in Python
would take longer than the kernel itself. A record is one stretch here, without jumps.

Within a step the peaks are looked for at both ends and in the middle, there by cubic interpolation.
Between two such moments a swing turns by half of what it turns in a step.
"""

import numpy as np

from equipoise.dynamics.propagation import advance, interpolate, start, steady
from equipoise.dynamics.rigid_body import (
    ROWS,
    Body,
    Now,
    body_at,
    body_within,
    drifts,
    gravity_of,
    rate_of,
)
from equipoise.dynamics.sensitivities import Inputs, Work, work_for
from equipoise.estimation.output_error.kernels.gauss_newton import descend
from equipoise.estimation.output_error.kernels.record_pass import Posed, local_for
from equipoise.estimation.parameters.retraction import W, body_at_point
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.levenberg_marquardt import FIRST, GROWTH
from equipoise.model.arrays import Floats, Triple


@part
def greater(now: Now, y: Floats, up: Triple, peak: tuple[float, float]) -> tuple[float, float]:
    """Return the least cosine of the tilt and the greatest rate squared, a state included."""
    w, g = rate_of(now, y), gravity_of(y, 1.0)
    cosine = -(g[0] * up[0] + g[1] * up[1] + g[2] * up[2])
    return min(peak[0], cosine), max(peak[1], w[0] * w[0] + w[1] * w[1] + w[2] * w[2])


@part
def peak_along(
    body: Body, inputs: Inputs, point: Floats, up: Triple, ends: Floats, work: Work
) -> tuple[float, float]:
    """Return the least cosine of the tilt and the greatest rate squared of a motion.

    ``ends`` (4, 7) has room for the states at both ends of a step and their slopes.
    """
    (maps, t, known), (y0, dy0, y, dy1) = inputs[:3], (ends[0], ends[1], ends[2], ends[3])
    moving, was_steady, peak = drifts(body), False, (1.0, 0.0)
    start(body, body_at(body, maps, t, known, 0, 0.0), inputs, 0, 0.0, point[:W],
          point[W : W + 3], y, work)  # fmt: skip
    for i in range(t.shape[0] - 1):
        is_steady = steady(known, i)
        fixed, here = is_steady and not moving, body_at(body, maps, t, known, i, 0.0)
        sloped, was_steady = was_steady and is_steady, is_steady
        now = advance(body, here, fixed, sloped, inputs, i, y, (y0, dy0, dy1), work)
        peak = greater(now, y, up, greater(here, y0, up, peak))
        interpolate(y0, dy0, y, dy1, t[i + 1] - t[i], 0.5, 0.0, work.at)
        middle = body_within(body, maps, t, known, i, 0.5, fixed, here)
        peak = greater(middle, work.at, up, peak)
    return peak


@kernel
def peaks_at(inputs: Inputs, mass: float, gravity: float, points: Floats, up: Floats) -> Floats:
    """Return the greatest tilt (rad) and rate (rad/s) of the motion from each point, (k, 2).

    A point may end behind its torques. Masses stop where the inputs, which have no columns, say.
    """
    found, work, ends = np.empty((points.shape[0], 2)), work_for(0), np.empty((4, ROWS))
    for k in range(points.shape[0]):
        body = body_at_point(points[k], mass, gravity)
        cosine, square = peak_along(body, inputs, points[k], (up[0], up[1], up[2]), ends, work)
        found[k, 0] = np.arccos(max(min(cosine, 1.0), -1.0))
        found[k, 1] = square**0.5
    return found


@kernel
def information_at(posed: Posed, points: Floats) -> Floats:
    """Return the information at each point, data and priors, in physical coordinates: (k, n, n)."""
    n = posed.slots.shape[0]
    found, descent = np.empty((points.shape[0], n, n)), np.empty(n)
    for k in range(points.shape[0]):
        found[k] = np.nan
        descend(posed, local_for(posed, points[k]), 1, found[k], descent, FIRST, GROWTH)
    return found
