"""The motion of the platform, compiled: its state now, and the right-hand side.

    H' = -w x H + mu x g_B + tau,    q' = 1/2 q (0, w),    w = J^-1 (H - h)

Small vectors and matrices are tuples here: the compiler keeps them in registers.
"""

from typing import NamedTuple

from equipoise.dynamics.regressor import DRIFT, N_TORQUES, THERMAL, torque_columns
from equipoise.dynamics.regressor import TORQUE as TORQUE_COLUMN
from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats, Six, Triple

ROWS = 7  # of the state before the sensitivities: q, H
KNOWN_WARMTH, KNOWN_D = 6, 7  # among the known inputs: momentum, torque, warmth, masses
A, B, HM = 3, 9, 15  # where the mass maps keep A_i, B_i and the momentum of travel


class Body(NamedTuple):
    """The platform as the kernels see it: numbers only."""

    mass: float  # kg
    gravity: float  # m/s^2
    inertia: Six  # kg m^2, about P, masses at home, xx yy zz xy xz yz
    moment: Triple  # kg m, masses at home
    torqued: bool  # any coefficient below is not zero
    torque: tuple[float, ...]  # (19,) coefficients


class Now(NamedTuple):
    """The platform at one moment."""

    t: float  # s since the start of the record
    warmth: float  # K, of the temperature above that at the start
    inertia: Six
    inverse: Six
    moment: Triple
    momentum: Triple  # of all that moves inside
    torque: Triple  # known, from outside


@part
def invert(s: Six) -> Six:
    """Return the inverse of a symmetric matrix, both as xx yy zz xy xz yz."""
    xx, yy, zz, xy, xz, yz = s
    a, b, c = yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy
    k = 1.0 / (xx * a + xy * b + xz * c)
    return (k * a, k * (xx * zz - xz * xz), k * (xx * yy - xy * xy), k * b, k * c,
            k * (xy * xz - xx * yz))  # fmt: skip


@part
def times(s: Six, x: Triple) -> Triple:
    """Return S x for a symmetric S."""
    return (
        s[0] * x[0] + s[3] * x[1] + s[4] * x[2],
        s[3] * x[0] + s[1] * x[1] + s[5] * x[2],
        s[4] * x[0] + s[5] * x[1] + s[2] * x[2],
    )


@part
def cross(a: Triple, b: Triple) -> Triple:
    """Return a x b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@part
def between(first: float, last: float, share: float) -> float:
    """Return a known input at ``share`` (0 to 1) of a step."""
    return first + share * (last - first)


@part
def moved_moment(body: Body, since: float, warmth: float) -> Triple:
    """Return the first moment, masses at home, after ``since`` seconds and as much warmer."""
    a, b, c = body.mass * since, body.mass * warmth, body.torque
    return (
        body.moment[0] + a * c[DRIFT] + b * c[THERMAL],
        body.moment[1] + a * c[DRIFT + 1] + b * c[THERMAL + 1],
        body.moment[2] + a * c[DRIFT + 2] + b * c[THERMAL + 2],
    )


@part
def body_at(body: Body, maps: Floats, t: Floats, known: Floats, i: int, share: float) -> Now:
    """Return the platform at ``share`` of step i: J(d), mu(d, t), h(d')."""
    step = t[i + 1] - t[i]
    since = t[i] - t[0] + share * step
    xx, yy, zz, xy, xz, yz = body.inertia
    a, b = known[i], known[i + 1]
    warmth = between(a[KNOWN_WARMTH], b[KNOWN_WARMTH], share)
    m0, m1, m2 = moved_moment(body, since, warmth)
    h0, h1, h2 = (between(a[0], b[0], share), between(a[1], b[1], share),
                  between(a[2], b[2], share))  # fmt: skip
    for k in range(maps.shape[0]):
        first, last = a[KNOWN_D + k], b[KNOWN_D + k]
        d, rate = between(first, last, share), (last - first) / step
        m0, m1, m2 = m0 + d * maps[k, 0], m1 + d * maps[k, 1], m2 + d * maps[k, 2]
        h0 += rate * maps[k, HM]
        h1 += rate * maps[k, HM + 1]
        h2 += rate * maps[k, HM + 2]
        xx += d * (maps[k, A] + d * maps[k, B])
        yy += d * (maps[k, A + 1] + d * maps[k, B + 1])
        zz += d * (maps[k, A + 2] + d * maps[k, B + 2])
        xy += d * (maps[k, A + 3] + d * maps[k, B + 3])
        xz += d * (maps[k, A + 4] + d * maps[k, B + 4])
        yz += d * (maps[k, A + 5] + d * maps[k, B + 5])
    inertia = (xx, yy, zz, xy, xz, yz)
    torque = (between(a[3], b[3], share), between(a[4], b[4], share), between(a[5], b[5], share))
    return Now(since, warmth, inertia, invert(inertia), (m0, m1, m2), (h0, h1, h2), torque)


@part
def drifts(body: Body) -> bool:
    """Say whether the centre of mass moves with time."""
    c = body.torque
    return c[DRIFT] != 0.0 or c[DRIFT + 1] != 0.0 or c[DRIFT + 2] != 0.0


@part
def body_within(
    body: Body,
    maps: Floats,
    t: Floats,
    known: Floats,
    i: int,
    share: float,
    fixed: bool,
    first: Now,
) -> Now:
    """Return the platform at ``share`` of step i: where nothing changes, ``first`` at that time."""
    if not fixed:
        return body_at(body, maps, t, known, i, share)
    since = t[i] - t[0] + share * (t[i + 1] - t[i])
    return Now(since, first.warmth, first.inertia, first.inverse, first.moment, first.momentum,
               first.torque)  # fmt: skip


@part
def rate_of(now: Now, y: Floats) -> Triple:
    """Return w = J^-1 (H - h)."""
    h = now.momentum
    return times(now.inverse, (y[4] - h[0], y[5] - h[1], y[6] - h[2]))


@part
def gravity_of(y: Floats, gravity: float) -> Triple:
    """Return g_B."""
    return (
        -2.0 * gravity * (y[1] * y[3] - y[0] * y[2]),
        -2.0 * gravity * (y[2] * y[3] + y[0] * y[1]),
        -gravity * (1.0 - 2.0 * (y[1] * y[1] + y[2] * y[2])),
    )


@part
def motion(
    body: Body, now: Now, y: Floats, w: Triple, g: Triple, columns: Floats, dy: Floats
) -> None:
    """Write q' and H'."""
    dy[0] = -0.5 * (y[1] * w[0] + y[2] * w[1] + y[3] * w[2])
    dy[1] = 0.5 * (y[0] * w[0] + y[2] * w[2] - y[3] * w[1])
    dy[2] = 0.5 * (y[0] * w[1] + y[3] * w[0] - y[1] * w[2])
    dy[3] = 0.5 * (y[0] * w[2] + y[1] * w[1] - y[2] * w[0])
    weight, gyroscopic = cross(now.moment, g), cross(w, (y[4], y[5], y[6]))
    for j in range(3):
        dy[4 + j] = now.torque[j] + weight[j] - gyroscopic[j]
    if body.torqued:
        torque_columns(w, g, now.t, now.warmth, body.mass, body.gravity, columns)
        for j in range(3):
            for k in range(DRIFT):
                dy[4 + j] += body.torque[k] * columns[j, TORQUE_COLUMN + k]


NO_TORQUE = (0.0,) * N_TORQUES
