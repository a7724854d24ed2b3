"""Tilt and shift along two horizontal axes, in numbers alone: a micro-controller runs the same.

With the axes a_i, u up and c_i = u x a_i,

    theta_i = n . c_i,  n = -g_B / |g_B|         theta = n x u along a_i
    s = -(v_1 c_1 + v_2 c_2)                     the shift whose u x s is v
    v_i = -s . c_i                               the way back

(``pendulum`` states the plant; its functions of arrays call these.)
"""

from typing import NamedTuple

from equipoise.model.arrays import Triple

Pair = tuple[float, float]
SPARE = 0.7  # chosen: of the masses' speed for tilt and rate; the rest is the integral's


class TiltAxes(NamedTuple):
    """Two horizontal body axes."""

    first: Triple  # a_1
    second: Triple
    across_first: Triple  # c_1
    across_second: Triple


class Feedback(NamedTuple):
    """A feedback of tilt and rate about both axes, and what limits it."""

    proportional: Pair  # m/rad
    derivative: Pair  # m s/rad
    frequency: Pair  # rad/s, w0
    slew: float  # m/s, of a shift by the masses


def inner(a: Triple, b: Triple) -> float:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def size_of(a: Triple) -> float:
    """Return |a|."""
    return inner(a, a) ** 0.5


def tilt_along(axes: TiltAxes, gravity: Triple) -> Pair:
    """Return the tilt about both axes for g_B (m/s^2), rad."""
    size = -size_of(gravity)
    return inner(gravity, axes.across_first) / size, inner(gravity, axes.across_second) / size


def rate_along(axes: TiltAxes, rate: Triple) -> Pair:
    """Return the rate about both axes, rad/s."""
    return inner(rate, axes.first), inner(rate, axes.second)


def shift_with(axes: TiltAxes, v: Pair) -> Triple:
    """Return the horizontal shift (m) whose u x s is v along the axes."""
    a, b = axes.across_first, axes.across_second
    return (
        -(v[0] * a[0] + v[1] * b[0]),
        -(v[0] * a[1] + v[1] * b[1]),
        -(v[0] * a[2] + v[1] * b[2]),
    )


def turned_along(axes: TiltAxes, shift: Triple) -> Pair:
    """Return v = u x s along the axes, m."""
    return -inner(shift, axes.across_first), -inner(shift, axes.across_second)


def followed_share(feedback: Feedback, tilt: Pair, rate: Pair) -> float:
    """Return how much of v = -(p tilt + d rate) the masses can follow through a swing.

    Of the slope |w (p tilt + d rate) + j (p rate - d w^2 tilt)| over both axes, w in rad/s.
    """
    p, d, w, square = feedback.proportional, feedback.derivative, feedback.frequency, 0.0
    for k in range(2):
        real = w[k] * (p[k] * tilt[k] + d[k] * rate[k])
        late = p[k] * rate[k] - d[k] * w[k] * w[k] * tilt[k]
        square += real * real + late * late
    return 1.0 if square <= 0.0 else min(1.0, SPARE * feedback.slew / square**0.5)
