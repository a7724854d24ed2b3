"""Stability of a linear loop through sampled masses: one axis that hangs (``hanging``).

    theta'' = -w0^2 theta + a v,   v held over a step h,   given n steps late

    x+ = F x + b v,   F = [cos w0 h, sin(w0 h) / w0; -w0 sin w0 h, cos w0 h],
                      b = a [(1 - cos w0 h) / w0^2, sin(w0 h) / w0]

    I+ = I + h K_i theta,   v = -(K_p theta + K_d theta' + I)

n covers the delay of sensors and masses, and half a step, for masses that go evenly over a step.
The loop is stable where all eigenvalues lie within the unit circle. The speed limit of the masses
is not part of the model.
"""

from typing import NamedTuple

import numpy as np

from equipoise.control.elements.ziegler_nichols import Gains
from equipoise.model.arrays import Floats, Square


class Sampled(NamedTuple):
    """One axis, sampled."""

    gain: float  # a, rad/s^2 per m
    frequency: float  # w0, rad/s
    period: float  # h, s
    late: int  # n, steps


def steps_late(delay: float, period: float) -> int:
    """Return n for sensors and masses that are late by ``delay`` (s)."""
    return int(np.ceil(delay / period + 0.5 - 1e-9))


def swing_matrix(frequency: float, period: float) -> Square:
    """Return F."""
    c, s = np.cos(frequency * period), np.sin(frequency * period)
    return np.array([[c, s / frequency], [-frequency * s, c]])


def swing_input(frequency: float, period: float) -> Floats:
    """Return b / a."""
    half, w = np.sin(frequency * period / 2), frequency
    return np.array([2 * half**2 / w**2, np.sin(w * period) / w])


def closed(axis: Sampled, gains: Gains) -> Square:
    """Return the matrix that takes tilt, rate, I and the n last v a step further."""
    n = axis.late
    v = -np.array([gains.proportional, gains.derivative, 1.0])
    loop = np.zeros((3 + n, 3 + n))
    loop[:2, :2] = swing_matrix(axis.frequency, axis.period)
    loop[:2, 2 + n] = axis.gain * swing_input(axis.frequency, axis.period)
    loop[2, 0], loop[2, 2] = axis.period * gains.integral, 1.0
    loop[3, :3] = v
    loop[4:, 3:-1] = np.eye(n - 1)
    return loop


def radius(loop: Square) -> float:
    """Return the greatest size of an eigenvalue; stable below 1."""
    return float(np.abs(np.linalg.eigvals(loop)).max())
