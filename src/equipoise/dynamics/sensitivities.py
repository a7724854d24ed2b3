"""Sensitivities of the motion to any set of parameters: their right-hand side, compiled.

A small change of parameter p turns the attitude by dth (body axes) and the momentum by dH:

    dw   = J^-1 (dH - f_p)                    f_p = dh/dp + (dJ/dp) w
    dth' = dw - w x dth
    dH'  = ([H x] + D) dw - w x dH + G dth + b_p
    D = d tau/dw,   G = d(mu x g_B + tau)/dth,   b_p = explicit d(torque)/dp

f_p and b_p are columns of the regressor, so this is the momentum balance once more
(``forcing``).

They lie in blocks of LANES columns behind q and H, each block row by row (dth, then dH), so that
one machine instruction serves several columns; columns that only fill the last block stay zero.
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.regressor import QUADRATIC, SAG, SWIRL, WIDTH
from equipoise.dynamics.rigid_body import ROWS, Body, Now, cross, times
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.model.arrays import Floats, Ints, Nine, Six, Triple

TURN, RATE, INERTIA, MOMENT, TORQUE, ERROR = 0, 1, 2, 3, 4, 5  # kinds of column
LANES = 16  # columns in a block; with fewer the compiler (LLVM 20) does not vectorise
BLOCK = 6 * LANES
SPAN = 3 * LANES  # numbers in a block of three rows of sensitivities


class Columns(NamedTuple):
    """Which sensitivities are wanted: a kind and an index within it."""

    kinds: Ints
    indices: Ints


class Groups(NamedTuple):
    """Where columns are that stand together: looked for once, as each step passes them often."""

    inertia: int  # the first of the six of J in order and in one block; -1: nowhere
    moment: int  # of the three of mu
    others: bool  # columns beside these are forced, too


class Inputs(NamedTuple):
    """What is known at the nodes of a timeline, and which sensitivities are wanted."""

    maps: Floats  # of the masses, as ``propagation.stacked`` has them
    t: Floats  # s
    known: Floats  # as in ``timeline``
    owners: Ints
    columns: Columns
    groups: Groups  # of the columns


class Work(NamedTuple):
    """Arrays that a step works in, made once."""

    at: Floats  # (7 + columns,) the state within the step
    dy: Floats
    total: Floats
    regress: Floats  # (3, WIDTH) the regressor
    fb: Floats  # f_p and b_p of all columns


@part
def room_for(columns: int) -> int:
    """Return how many numbers the sensitivities of so many columns take."""
    return (columns + LANES - 1) // LANES * BLOCK


@kernel
def work_for(columns: int) -> Work:
    """Return the arrays for so many sensitivities."""
    m = ROWS + room_for(columns)
    return Work(np.empty(m), np.empty(m), np.empty(m), np.zeros((3, WIDTH)), np.zeros(m - ROWS))


@part
def place(column: int) -> int:
    """Return where the first row of a column is; its next rows follow LANES apart."""
    return column // LANES * BLOCK + column % LANES


@part
def spot(column: int) -> int:
    """Return where the first of three rows of a column is, in blocks of three rows."""
    return column // LANES * SPAN + column % LANES


@part
def dot(m: Nine, x: Triple) -> Triple:
    """Return M x for a matrix given by rows."""
    return (
        m[0] * x[0] + m[1] * x[1] + m[2] * x[2],
        m[3] * x[0] + m[4] * x[1] + m[5] * x[2],
        m[6] * x[0] + m[7] * x[1] + m[8] * x[2],
    )


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
def sensitivity_rates(
    inverse: Six, w: Triple, by_rate: Nine, by_turn: Nine, fb: Floats, y: Floats, dy: Floats
) -> None:
    """Write dth' and dH' of all columns."""
    for first in range(0, fb.shape[0], BLOCK):
        x, dx = y[ROWS + first : ROWS + first + BLOCK], dy[ROWS + first : ROWS + first + BLOCK]
        force = fb[first : first + BLOCK]
        for c in range(LANES):
            turn = (x[c], x[c + LANES], x[c + 2 * LANES])
            dH = (x[c + 3 * LANES], x[c + 4 * LANES], x[c + 5 * LANES])
            dw = times(inverse, (dH[0] - force[c], dH[1] - force[c + LANES],
                                 dH[2] - force[c + 2 * LANES]))  # fmt: skip
            p, r = cross(w, turn), cross(w, dH)
            s, v = dot(by_turn, turn), dot(by_rate, dw)
            dx[c], dx[c + LANES], dx[c + 2 * LANES] = dw[0] - p[0], dw[1] - p[1], dw[2] - p[2]
            dx[c + 3 * LANES] = v[0] + s[0] + force[c + 3 * LANES] - r[0]
            dx[c + 4 * LANES] = v[1] + s[1] + force[c + 4 * LANES] - r[1]
            dx[c + 5 * LANES] = v[2] + s[2] + force[c + 5 * LANES] - r[2]
