"""Right-hand sides, compiled: the motion, and its sensitivities to any set of parameters.

    H' = -w x H + mu x g_B + tau,    q' = 1/2 q (0, w),    w = J^-1 (H - h)

A small change of parameter p turns the attitude by dth (body axes) and the momentum by dH:

    dw   = J^-1 (dH - f_p)                    f_p = dh/dp + (dJ/dp) w
    dth' = dw - w x dth
    dH'  = ([H x] + D) dw - w x dH + G dth + b_p
    D = d tau/dw,   G = d(mu x g_B + tau)/dth,   b_p = explicit d(torque)/dp

f_p and b_p are columns of the regressor, so this is the momentum balance once more.

Small vectors and matrices are tuples here: the compiler keeps them in registers.
"""

from typing import NamedTuple

from equipoise.dynamics.regressor import (
    DRIFT,
    N_TORQUES,
    QUADRATIC,
    SAG,
    SWIRL,
    Triple,
    regressor,
    torque_columns,
)
from equipoise.dynamics.regressor import INERTIA as INERTIA_COLUMN
from equipoise.dynamics.regressor import MOMENT as MOMENT_COLUMN
from equipoise.dynamics.regressor import TORQUE as TORQUE_COLUMN
from equipoise.maths.compiled import part
from equipoise.model.arrays import Floats, Ints

Six = tuple[float, float, float, float, float, float]
Nine = tuple[float, float, float, float, float, float, float, float, float]

TURN, RATE, INERTIA, MOMENT, TORQUE, ERROR = 0, 1, 2, 3, 4, 5  # kinds of sensitivity column
ROWS = 7  # of the state before the sensitivities: q, H
KNOWN_D = 6  # first mass displacement among the known inputs: wheel momentum, torque, masses
A, B, HM = 3, 9, 15  # where the mass maps keep A_i, B_i and the momentum of travel


class Body(NamedTuple):
    """The platform as the kernels see it: numbers only."""

    mass: float  # kg
    gravity: float  # m/s^2
    inertia: Six  # kg m^2, about P, masses at home, xx yy zz xy xz yz
    moment: Triple  # kg m, masses at home
    torqued: bool  # any coefficient below is not zero
    torque: tuple[float, ...]  # (16,) coefficients


class Now(NamedTuple):
    """The platform at one moment."""

    t: float  # s since the start of the record
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
def dot(m: Nine, x: Triple) -> Triple:
    """Return M x for a matrix given by rows."""
    return (
        m[0] * x[0] + m[1] * x[1] + m[2] * x[2],
        m[3] * x[0] + m[4] * x[1] + m[5] * x[2],
        m[6] * x[0] + m[7] * x[1] + m[8] * x[2],
    )


@part
def cross(a: Triple, b: Triple) -> Triple:
    """Return a x b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@part
def between(known: Floats, i: int, share: float, column: int) -> float:
    """Return a known input at ``share`` (0 to 1) of step i."""
    return known[i, column] + share * (known[i + 1, column] - known[i, column])


@part
def body_at(body: Body, maps: Floats, t: Floats, known: Floats, i: int, share: float) -> Now:
    """Return the platform at ``share`` of step i: J(d), mu(d, t), h(d')."""
    step = t[i + 1] - t[i]
    since = t[i] - t[0] + share * step
    xx, yy, zz, xy, xz, yz = body.inertia
    ramp = body.mass * since
    m0 = body.moment[0] + ramp * body.torque[DRIFT]
    m1 = body.moment[1] + ramp * body.torque[DRIFT + 1]
    m2 = body.moment[2] + ramp * body.torque[DRIFT + 2]
    h0, h1, h2 = (between(known, i, share, 0), between(known, i, share, 1),
                  between(known, i, share, 2))  # fmt: skip
    for k in range(maps.shape[0]):
        d = between(known, i, share, KNOWN_D + k)
        rate = (known[i + 1, KNOWN_D + k] - known[i, KNOWN_D + k]) / step
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
    torque = (between(known, i, share, 3), between(known, i, share, 4), between(known, i, share, 5))
    return Now(since, inertia, invert(inertia), (m0, m1, m2), (h0, h1, h2), torque)


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
        torque_columns(w, g, now.t, body.mass, body.gravity, columns)
        for j in range(3):
            for k in range(DRIFT):
                dy[4 + j] += body.torque[k] * columns[j, TORQUE_COLUMN + k]


@part
def cross_twice(a: Triple, b: Triple) -> Nine:
    """Return [a x][b x] = b a^T - (a.b) E."""
    s = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return (b[0] * a[0] - s, b[0] * a[1], b[0] * a[2],
            b[1] * a[0], b[1] * a[1] - s, b[1] * a[2],
            b[2] * a[0], b[2] * a[1], b[2] * a[2] - s)  # fmt: skip


@part
def add(a: Nine, b: Nine, weight: float) -> Nine:
    """Return a + weight b."""
    return (a[0] + weight * b[0], a[1] + weight * b[1], a[2] + weight * b[2],
            a[3] + weight * b[3], a[4] + weight * b[4], a[5] + weight * b[5],
            a[6] + weight * b[6], a[7] + weight * b[7], a[8] + weight * b[8])  # fmt: skip


@part
def cross_matrix(a: Triple) -> Nine:
    """Return [a x]."""
    return (0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0)


@part
def sag_by_turn(torque: tuple[float, ...], g: Triple) -> Nine:
    """Return d/dth of (C g) x g, where dg = g x dth: [C g x][g x] - [g x] C [g x]."""
    xx, yy, xy = torque[SAG], torque[SAG + 1], torque[SAG + 2]
    xz, yz = torque[SAG + 3], torque[SAG + 4]
    sag = (xx, yy, -xx - yy, xy, xz, yz)
    # the columns of C [g x] are C (g x e_j)
    c0 = cross(times(sag, (0.0, g[2], -g[1])), g)
    c1 = cross(times(sag, (-g[2], 0.0, g[0])), g)
    c2 = cross(times(sag, (g[1], -g[0], 0.0)), g)
    bent = (c0[0], c1[0], c2[0], c0[1], c1[1], c2[1], c0[2], c1[2], c2[2])
    return add(bent, cross_twice(times(sag, g), g), 1.0)


@part
def linearise(body: Body, now: Now, y: Floats, w: Triple, g: Triple) -> tuple[Nine, Nine]:
    """Return [H x] + D and G."""
    by_rate = cross_matrix((y[4], y[5], y[6]))
    by_turn = cross_twice(now.moment, g)
    if not body.torqued:
        return by_rate, by_turn
    torque = body.torque
    speed = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) ** 0.5 + 1e-300
    k = torque[QUADRATIC] / speed
    along = k * speed * speed
    drag = (torque[0] + along + k * w[0] * w[0], k * w[0] * w[1], k * w[0] * w[2],
            k * w[1] * w[0], torque[1] + along + k * w[1] * w[1], k * w[1] * w[2],
            k * w[2] * w[0], k * w[2] * w[1], torque[2] + along + k * w[2] * w[2])  # fmt: skip
    by_rate = add(by_rate, drag, -1.0)
    # swirl: the vertical -g_B/g turns by -g_B/g x dth
    by_turn = add(by_turn, cross_matrix(g), -torque[SWIRL] / body.gravity)
    by_turn = add(by_turn, sag_by_turn(torque, g), body.mass / body.gravity)
    return by_rate, by_turn


@part
def error_column(
    maps: Floats,
    t: Floats,
    known: Floats,
    i: int,
    share: float,
    owner: int,
    column: int,
    w: Triple,
    g: Triple,
) -> tuple[Triple, Triple]:
    """Return f and b of one displacement error, felt as the known input ``column`` says."""
    felt = between(known, i, share, column)
    rate = (known[i + 1, column] - known[i, column]) / (t[i + 1] - t[i])
    d, m = between(known, i, share, KNOWN_D + owner), maps[owner]
    bend = (m[A] + 2 * d * m[B], m[A + 1] + 2 * d * m[B + 1], m[A + 2] + 2 * d * m[B + 2],
            m[A + 3] + 2 * d * m[B + 3], m[A + 4] + 2 * d * m[B + 4],
            m[A + 5] + 2 * d * m[B + 5])  # fmt: skip
    v, u = times(bend, w), cross((m[0], m[1], m[2]), g)
    f = (
        felt * v[0] + rate * m[HM],
        felt * v[1] + rate * m[HM + 1],
        felt * v[2] + rate * m[HM + 2],
    )
    return f, (felt * u[0], felt * u[1], felt * u[2])


@part
def forcing(
    body: Body,
    now: Now,
    maps: Floats,
    t: Floats,
    known: Floats,
    i: int,
    share: float,
    owners: Ints,
    kinds: Ints,
    indices: Ints,
    w: Triple,
    g: Triple,
    columns: Floats,
    fb: Floats,
) -> None:
    """Write f_p (rows 0-2) and b_p (rows 3-5) of every column from the regressor."""
    n = kinds.shape[0]
    torques = False
    for c in range(n):
        torques |= kinds[c] == TORQUE
    regressor(w, g, now.t, body.mass, body.gravity, torques, columns)
    for c in range(n):
        kind, k = kinds[c], indices[c]
        if kind == ERROR:
            felt = KNOWN_D + maps.shape[0] + k
            f, b = error_column(maps, t, known, i, share, int(owners[k]), felt, w, g)
            for j in range(3):
                fb[j, c], fb[3 + j, c] = f[j], b[j]
            continue
        for j in range(3):
            fb[j, c] = columns[j, INERTIA_COLUMN + k] if kind == INERTIA else 0.0
            fb[3 + j, c] = 0.0
            if kind == MOMENT:
                fb[3 + j, c] = columns[j, MOMENT_COLUMN + k]
            elif kind == TORQUE:
                fb[3 + j, c] = columns[j, TORQUE_COLUMN + k]


@part
def sensitivity_rates(
    inverse: Six, w: Triple, by_rate: Nine, by_turn: Nine, fb: Floats, y: Floats, dy: Floats
) -> None:
    """Write dth' and dH' of n columns; y holds six rows of n after q and H."""
    n = fb.shape[1]
    for c in range(n):
        i = ROWS + c
        turn = (float(y[i]), float(y[i + n]), float(y[i + 2 * n]))
        dH = (float(y[i + 3 * n]), float(y[i + 4 * n]), float(y[i + 5 * n]))
        dw = times(inverse, (dH[0] - fb[0, c], dH[1] - fb[1, c], dH[2] - fb[2, c]))
        p, r = cross(w, turn), cross(w, dH)
        s, v = dot(by_turn, turn), dot(by_rate, dw)
        for j in range(3):
            dy[i + j * n] = dw[j] - p[j]
            dy[i + (3 + j) * n] = v[j] + s[j] + fb[3 + j, c] - r[j]


NO_TORQUE = (0.0,) * N_TORQUES
