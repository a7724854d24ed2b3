"""One step of the PID on tilt, in numbers alone: a micro-controller runs the same.

    v = -f (K_p theta + K_d rate) - I,      I' = f K_i theta - (v_done - v_asked) / T_a

per axis, with T_a = K_p / K_i (``laws.pid`` says what it is for).
"""

from typing import NamedTuple

from equipoise.control.plant.tilt_axes import (
    Feedback,
    Pair,
    TiltAxes,
    followed_share,
    shift_with,
)
from equipoise.model.arrays import Triple


class Gains(NamedTuple):
    """The gains of both axes, and what limits them."""

    feedback: Feedback
    integral: Pair  # m/(rad s)


class Integral(NamedTuple):
    """The integral before a step, and what the masses have not delivered of the last demand."""

    value: Pair  # m
    undelivered: Pair  # m


def damped(gains: Gains, rate: Pair) -> Pair:
    """Return v = -f K_d rate, m."""
    by, none = gains.feedback, (0.0, 0.0)
    d = by.derivative
    f = followed_share(Feedback(none, d, by.frequency, by.slew), none, rate)
    return (-f * d[0] * rate[0], -f * d[1] * rate[1])


def pid_step(
    gains: Gains, tilt: Pair, rate: Pair, before: Integral, time: float
) -> tuple[Pair, Pair]:
    """Return v and the next I (m) after so many seconds.

    A share of the integral gain is the same share of the time.
    """
    p, d, i = gains.feedback.proportional, gains.feedback.derivative, gains.integral
    f, left = followed_share(gains.feedback, tilt, rate), before.undelivered
    grown = (
        before.value[0] + time * i[0] * (f * tilt[0] - left[0] / p[0]),
        before.value[1] + time * i[1] * (f * tilt[1] - left[1] / p[1]),
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
