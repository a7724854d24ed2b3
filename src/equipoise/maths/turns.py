"""Turning one attitude, compiled: the rotation between two, and an attitude after a rotation.

Quaternions as in ``maths.attitude``, of which these are the single-sample forms for kernels.
"""

import math

from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats, Triple

NO_TURN = 1e-9  # rad; below it sin(x) / x is 1 to rounding


@part
def turn(p: Floats, q: Floats) -> tuple[float, float, float]:
    """Return log(p^-1 q), rad."""
    w = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3]
    x = p[0] * q[1] - p[1] * q[0] - p[2] * q[3] + p[3] * q[2]
    y = p[0] * q[2] + p[1] * q[3] - p[2] * q[0] - p[3] * q[1]
    z = p[0] * q[3] - p[1] * q[2] + p[2] * q[1] - p[3] * q[0]
    sine = (x * x + y * y + z * z) ** 0.5
    if w < 0:
        w, x, y, z = -w, -x, -y, -z
    scale = 2.0 if sine < NO_TURN else 2.0 * math.atan2(sine, w) / sine
    return scale * x, scale * y, scale * z


@part
def turned(q: Floats, x: float, y: float, z: float) -> tuple[float, float, float, float]:
    """Return q (x) exp(rotation vector), which is in body axes and rad."""
    angle = (x * x + y * y + z * z) ** 0.5
    s = 0.5 if angle < NO_TURN else math.sin(0.5 * angle) / angle
    c, a, b, d = math.cos(0.5 * angle), s * x, s * y, s * z
    w, i, j, k = q[0], q[1], q[2], q[3]
    return (
        w * c - i * a - j * b - k * d,
        w * a + i * c + j * d - k * b,
        w * b - i * d + j * c + k * a,
        w * d + i * b - j * a + k * c,
    )


@part
def to_laboratory(q: Floats, v: Triple) -> Triple:
    """Return R v."""
    w, x, y, z = q[0], q[1], q[2], q[3]
    a, b, c = v
    # t = 2 q_v x v,  R v = v + q_w t + q_v x t
    t, u, s = 2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a)
    return (a + w * t + y * s - z * u, b + w * u + z * t - x * s, c + w * s + x * u - y * t)


@part
def to_body(q: Floats, v: Triple) -> Triple:
    """Return R^T v."""
    w, x, y, z = q[0], q[1], q[2], q[3]
    a, b, c = v
    t, u, s = 2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a)
    return (a - w * t + y * s - z * u, b - w * u + z * t - x * s, c - w * s + x * u - y * t)
