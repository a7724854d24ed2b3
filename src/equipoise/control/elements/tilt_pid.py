"""One step of the PID on tilt, in numbers alone: a micro-controller runs the same.

    v = -f (K_p theta + K_d rate) - I,      I' = f K_i theta - (v_done - v_asked) / T_a

per axis, with T_a = K_p / K_i (``laws.pid`` says what it is for).
"""

from typing import NamedTuple

from equipoise.control.plant.tilt_axes import Pair, TiltAxes, followed_share, shift_with
from equipoise.model.arrays import Triple


class Gains(NamedTuple):
    """The gains of both axes, and what limits them."""

    proportional: Pair  # m/rad
    integral: Pair  # m/(rad s)
    derivative: Pair  # m s/rad
    frequency: Pair  # rad/s, w0
    slew: float  # m/s, of a shift by the masses


def damped(gains: Gains, rate: Pair) -> Pair:
    """Return v = -f K_d rate, m."""
    d, none = gains.derivative, (0.0, 0.0)
    f = followed_share(gains.frequency, gains.slew, none, d, none, rate)
    return (-f * d[0] * rate[0], -f * d[1] * rate[1])


def pid_step(
    gains: Gains, tilt: Pair, rate: Pair, integral: Pair, undelivered: Pair, share: float, h: float
) -> tuple[Pair, Pair]:
    """Return v and the next I (m) after h seconds; ``share`` of the integral gain is used."""
    p, d, i = gains.proportional, gains.derivative, gains.integral
    f = followed_share(gains.frequency, gains.slew, p, d, tilt, rate)
    grown = (
        integral[0] + h * share * i[0] * (f * tilt[0] - undelivered[0] / p[0]),
        integral[1] + h * share * i[1] * (f * tilt[1] - undelivered[1] / p[1]),
    )
    v = (
        -f * (p[0] * tilt[0] + d[0] * rate[0]) - grown[0],
        -f * (p[1] * tilt[1] + d[1] * rate[1]) - grown[1],
    )
    return v, grown


def shortened(v: Pair, most: float) -> Pair:
    """Return v, shortened to ``most`` (m) where it is longer; its direction is kept."""
    size = (v[0] * v[0] + v[1] * v[1]) ** 0.5
    return v if size <= most else (v[0] * (most / size), v[1] * (most / size))


def shift_at(axes: TiltAxes, up: Triple, v: Pair, reach: float, along: float) -> Triple:
    """Return the shift (m) that gives v within reach, ``along`` m along u."""
    s = shift_with(axes, shortened(v, reach))
    return (s[0] + along * up[0], s[1] + along * up[1], s[2] + along * up[2])
