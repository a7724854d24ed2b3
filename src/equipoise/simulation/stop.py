"""The stop: a level, smooth ring on which the platform lies once it tilts to its limit.

It pushes straight upwards at a point on the side that sinks, so that its torque turns the platform
back about the level axis of tilt, and does nothing to the momentum about the vertical Z or about
the body's axis u that points up when level:

    tilt' = w . a,    a = Z x u / |Z x u|
    touch:  H += -p a,   p = tilt' / (a . J^-1 a)   where tilt' > 0

It is dead, of rubber or foam: what tilts outwards is gone, at a loss of tilt'^2 / (2 a . J^-1 a) of
energy, and nothing comes back.

Cannot see friction: on the ring the platform slides freely.
"""

from math import cos, pi
from typing import NamedTuple

import numpy as np

from equipoise.dynamics.propagation import to_unit
from equipoise.dynamics.rigid_body import Now, cross, rate_of, times
from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats, Triple, Vector3

LYING = 1e-12  # of the cosine of the tilt, chosen: rounding
STILL = 1e-10  # rad/s, chosen: a push that takes no more is rounding, and no touch


class Stop(NamedTuple):
    """Where the stop is, as the kernels see it."""

    up: Triple  # unit vector, the body axis that points up when level
    cosine: float  # of the tilt limit; below -1: there is none
    sine: float


NO_STOP = Stop((0.0, 0.0, 1.0), -2.0, 0.0)


def stop_at(up: Vector3, tilt_limit: float) -> Stop:
    """Return the stop at a tilt limit (rad); a platform that may turn over has none."""
    if tilt_limit >= pi:
        return NO_STOP
    x, y, z = up
    cosine = cos(tilt_limit)
    return Stop((float(x), float(y), float(z)), cosine, (1.0 - cosine * cosine) ** 0.5)


@part
def dot(a: Triple, b: Triple) -> float:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@part
def vertical(y: Floats) -> Triple:
    """Return Z, body axes."""
    return (
        2.0 * (y[1] * y[3] - y[0] * y[2]),
        2.0 * (y[2] * y[3] + y[0] * y[1]),
        1.0 - 2.0 * (y[1] * y[1] + y[2] * y[2]),
    )


@part
def is_beyond(stop: Stop, y: Floats) -> bool:
    """Say whether the platform tilts beyond its limit."""
    return dot(vertical(y), stop.up) < stop.cosine


@part
def lies(stop: Stop, y: Floats) -> bool:
    """Say whether the platform lies on the stop."""
    return dot(vertical(y), stop.up) < stop.cosine + LYING


@part
def tilt_axis(stop: Stop, y: Floats) -> tuple[Triple, float, float]:
    """Return a, body axes, and sine and cosine of the tilt."""
    Z = vertical(y)
    across = cross(Z, stop.up)
    sine = dot(across, across) ** 0.5
    return (across[0] / sine, across[1] / sine, across[2] / sine), sine, dot(Z, stop.up)


@part
def excess(stop: Stop, y: Floats) -> float:
    """Return by how much the platform tilts beyond its limit, rad."""
    _, sine, cosine = tilt_axis(stop, y)
    return np.arctan2(sine * stop.cosine - stop.sine * cosine,
                      cosine * stop.cosine + sine * stop.sine)  # fmt: skip


@part
def yielding(stop: Stop, now: Now, y: Floats) -> float:
    """Return a . J^-1 a: the rate of tilt (rad/s) that a push takes, for each N m s."""
    a, _, _ = tilt_axis(stop, y)
    return dot(a, times(now.inverse, a))


@part
def push(stop: Stop, p: float, y: Floats) -> None:
    """Push the platform back by p (N m s)."""
    a, _, _ = tilt_axis(stop, y)
    for j in range(3):
        y[4 + j] -= p * a[j]


@part
def note(stop: Stop, p: float, t: float, y: Floats, touch: Floats) -> None:
    """Note a push by p (N m s) at time t (s).

    ``touch`` has the first and last time (s) and the impulse along laboratory x, y, none yet: 0.
    """
    a, _, _ = tilt_axis(stop, y)
    if touch[2] == 0.0 and touch[3] == 0.0:
        touch[0] = t
    touch[1] = t
    w, x, v, z = y[0], y[1], y[2], y[3]  # a is level: along Z there is nothing
    touch[2] -= p * ((1.0 - 2.0 * (v * v + z * z)) * a[0] + 2.0 * (x * v - w * z) * a[1]
                     + 2.0 * (x * z + w * v) * a[2])  # fmt: skip
    touch[3] -= p * (2.0 * (x * v + w * z) * a[0] + (1.0 - 2.0 * (x * x + z * z)) * a[1]
                     + 2.0 * (v * z - w * x) * a[2])  # fmt: skip


@part
def land(stop: Stop, now: Now, t: float, y: Floats, touch: Floats) -> None:
    """Lay the platform, a little beyond its limit, on the stop at time t (s); note the touch."""
    set_back(stop, y)
    a, _, _ = tilt_axis(stop, y)
    outwards = dot(rate_of(now, y), a)
    if outwards <= 0.0:
        return
    p = outwards / dot(a, times(now.inverse, a))
    push(stop, p, y)
    if outwards > STILL:
        note(stop, p, t, y, touch)


@part
def set_back(stop: Stop, y: Floats) -> None:
    """Turn the platform about a back to its limit, at the same H . Z, H . u and H . a."""
    half = -0.5 * excess(stop, y)
    a, sine, cosine = tilt_axis(stop, y)
    Z, up, H = vertical(y), stop.up, (y[4], y[5], y[6])
    c, s, w, x, v, z = np.cos(half), np.sin(half), y[0], y[1], y[2], y[3]
    y[0] = c * w - s * (x * a[0] + v * a[1] + z * a[2])
    y[1] = c * x + s * (w * a[0] + v * a[2] - z * a[1])
    y[2] = c * v + s * (w * a[1] + z * a[0] - x * a[2])
    y[3] = c * z + s * (w * a[2] + x * a[1] - v * a[0])
    to_unit(y)
    # Across u the vertical leans to n = (Z - cos u) / sin, which stays where it is in the body.
    along, total = dot(H, up), dot(H, Z)
    change = (total - stop.cosine * along) / stop.sine - (total - cosine * along) / sine
    for j in range(3):
        y[4 + j] += change * (Z[j] - cosine * up[j]) / sine
