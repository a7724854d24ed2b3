"""The method ``momentum_recursive`` row by row: integrals by parabolas, two rows at a time.

    A = [ W(w) + int w x W(w),  -m int (e_i x g_B) ],    b = int (dmu x g_B - w x k) - k

with k = dJ(d) w of masses that stand off home. The integral over a step takes a third row
(``running_integral``), so an odd row of a piece waits for the next one, and both are then taken.
The recursion is the library's in factors (``factored``), which single precision bears.

While a mass travels no row is taken, and a new piece begins where it stands again: momentum of
travel needs a speed that a board does not report. Torques of the air are left out. It assumes rates
without bias, and cannot see the common scale of J and com before a mass has moved.
"""

from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.actuators.stops import STILL
from equipoise.dynamics.propagation import stacked
from equipoise.dynamics.regressor import MOMENT, cross_columns, momentum_columns
from equipoise.dynamics.rigid_body import A as BEND_1
from equipoise.dynamics.rigid_body import B as BEND_2
from equipoise.dynamics.rigid_body import cross, gravity_of, times
from equipoise.estimation.motion.fused_motion import GAP, SHORTEST
from equipoise.estimation.regression.formulations.rows import Rows
from equipoise.estimation.regression.solvers.factored import (
    learn_factored,
    restart_first,
    variance_of,
)
from equipoise.estimation.regression.solvers.recursion import Plan, recursion_of, unfiltered
from equipoise.model.arrays import Bools, Floats, Ints, Six, Triple
from equipoise.model.errors import InputError
from equipoise.model.estimate import BODY
from equipoise.model.testbed import Testbed
from equipoise.onboard.program.camera_filter import EDGE
from equipoise.onboard.program.request import Request

UNKNOWNS, EQUATIONS = len(BODY), 3


class Recursion(NamedTuple):
    """What does not change."""

    mass: float  # kg
    gravity: float  # m/s^2
    maps: Floats  # (k, 18) of the masses
    slowest: Floats  # (k,) m/s, above which a mass travels
    gap: float  # s, behind which a new piece begins
    noise: Floats  # (3,) N m s, one sd of each equation
    free: float  # N m s, one sd of the constants of a new piece


class Memory(NamedTuple):
    """What changes with every row."""

    x: Floats  # (12,) constants of the piece, J, com
    D: Floats  # (12,) factors of P, see ``factored``
    U: Floats  # (66,)
    h: Floats  # (12,) an equation
    gain: Floats  # (12,)
    slopes: Floats  # (3, 10) what is integrated, at one row
    total: Floats  # (3, 10) its integral up to the last row that was taken
    rates: Floats  # (3, 3) rad/s at the last three rows
    gravity: Floats  # (3, 3) m/s^2, g_B
    push: Floats  # (3, 3) N m, dmu x g_B - w x k
    times: Floats  # (3,) s from the first of them
    last_d: Floats  # (k,) m
    row_count: Ints  # (1,) rows of the piece
    begun: Bools  # (1,)
    fresh: Bools  # (1,) no row of the piece has been taken


def bend_of(maps: Floats, d: Floats) -> Six:
    """Return dJ of masses off home, kg m^2."""
    xx, yy, zz, xy, xz, yz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(d.shape[0]):
        s = d[k]
        xx += s * (maps[k, BEND_1] + s * maps[k, BEND_2])
        yy += s * (maps[k, BEND_1 + 1] + s * maps[k, BEND_2 + 1])
        zz += s * (maps[k, BEND_1 + 2] + s * maps[k, BEND_2 + 2])
        xy += s * (maps[k, BEND_1 + 3] + s * maps[k, BEND_2 + 3])
        xz += s * (maps[k, BEND_1 + 4] + s * maps[k, BEND_2 + 4])
        yz += s * (maps[k, BEND_1 + 5] + s * maps[k, BEND_2 + 5])
    return (xx, yy, zz, xy, xz, yz)


def moment_of(maps: Floats, d: Floats) -> Triple:
    """Return dmu of masses off home, kg m."""
    x, y, z = 0.0, 0.0, 0.0
    for k in range(d.shape[0]):
        x, y, z = x + d[k] * maps[k, 0], y + d[k] * maps[k, 1], z + d[k] * maps[k, 2]
    return (x, y, z)


def put_row(own: Recursion, memory: Memory, row: int, q: Floats, w: Triple, d: Floats) -> None:
    """Write what a row brings to the integrals."""
    g = gravity_of(q, own.gravity)
    weight, swirl = cross(moment_of(own.maps, d), g), cross(w, times(bend_of(own.maps, d), w))
    for i in range(3):
        memory.rates[row, i], memory.gravity[row, i] = w[i], g[i]
        memory.push[row, i] = weight[i] - swirl[i]


def put_slopes(own: Recursion, memory: Memory, row: int) -> None:
    """Write what is integrated at a row: w x W(w), m e_i x g_B, dmu x g_B - w x k."""
    out, w, g = memory.slopes, memory.rates[row], memory.gravity[row]
    rate = (w[0], w[1], w[2])
    momentum_columns(rate, out)
    for j in range(MOMENT):
        turned = cross(rate, (out[0, j], out[1, j], out[2, j]))
        out[0, j], out[1, j], out[2, j] = turned[0], turned[1], turned[2]
    cross_columns((g[0], g[1], g[2]), own.mass, MOMENT, out)
    for i in range(3):
        out[i, UNKNOWNS] = memory.push[row, i]


def add_slopes(own: Recursion, memory: Memory, row: int, weight: float) -> None:
    """Add to the integrals what is integrated at a row, times a weight (s)."""
    put_slopes(own, memory, row)
    for i in range(3):
        for j in range(UNKNOWNS + 1):
            memory.total[i, j] += weight * memory.slopes[i, j]


def add_step(own: Recursion, memory: Memory, near: int, middle: int, distant: int) -> None:
    """Add the step from row ``near`` to ``middle``, of the parabola through ``distant``."""
    t = memory.times
    first, second = t[middle] - t[near], t[distant] - t[middle]
    size, r = abs(first) / 6.0, first / (first + second)
    bend = r * (first / second)
    add_slopes(own, memory, near, size * (3.0 - r))
    add_slopes(own, memory, middle, size * (3.0 + bend + r))
    add_slopes(own, memory, distant, -size * bend)


def learn(own: Recursion, memory: Memory, row: int, d: Floats) -> None:
    """Take the three equations of a row."""
    columns, h, total = memory.slopes, memory.h, memory.total
    w = (memory.rates[row, 0], memory.rates[row, 1], memory.rates[row, 2])
    momentum_columns(w, columns)
    k = times(bend_of(own.maps, d), w)
    for i in range(EQUATIONS):
        for j in range(EQUATIONS):
            h[j] = 1.0 if i == j else 0.0
        for j in range(MOMENT):
            h[EQUATIONS + j] = columns[i, j] + total[i, j]
        for j in range(MOMENT, UNKNOWNS):
            h[EQUATIONS + j] = -total[i, j]
        b, sd = total[i, UNKNOWNS] - k[i], own.noise[i]
        learn_factored(memory.x, memory.D, memory.U, h, b, sd * sd, memory.gain)


def begin_piece(own: Recursion, memory: Memory) -> None:
    """Begin the integrals and their constants anew."""
    restart_first(memory.x, memory.D, memory.U, EQUATIONS, own.free * own.free)
    for i in range(3):
        for j in range(UNKNOWNS + 1):
            memory.total[i, j] = 0.0
    memory.row_count[0], memory.fresh[0] = 0, True


def take_pair(own: Recursion, memory: Memory, d: Floats) -> None:
    """Take the two rows that end a pair of steps, and keep the last as the next pair's first.

    The first row of a piece says only what the constants are: it is taken with the first pair.
    """
    if memory.fresh[0]:
        learn(own, memory, 0, d)
        memory.fresh[0] = False
    add_step(own, memory, 0, 1, 2)
    learn(own, memory, 1, d)
    add_step(own, memory, 2, 1, 0)
    learn(own, memory, 2, d)
    for i in range(3):
        memory.rates[0, i], memory.gravity[0, i] = memory.rates[2, i], memory.gravity[2, i]
        memory.push[0, i] = memory.push[2, i]


def stands(own: Recursion, memory: Memory, dt: float, d: Floats) -> bool:
    """Say whether all masses have stood since the last row; note where they are."""
    still = True
    for k in range(d.shape[0]):
        if abs(d[k] - memory.last_d[k]) > own.slowest[k] * dt:
            still = False
        memory.last_d[k] = d[k]
    return still


def take_row(own: Recursion, memory: Memory, dt: float, q: Floats, rate: Floats, d: Floats) -> None:
    """Take attitude (w x y z) and rate (rad/s) dt s after the last, with the masses at d m."""
    goes_on = stands(own, memory, dt, d) and dt <= own.gap
    if not (goes_on and memory.begun[0]):
        begin_piece(own, memory)
    memory.begun[0] = True
    row = memory.row_count[0]
    memory.times[row] = memory.times[row - 1] + dt if row > 0 else 0.0
    put_row(own, memory, row, q, (rate[0], rate[1], rate[2]), d)
    memory.row_count[0] = row + 1
    if row == 2:
        take_pair(own, memory, d)
        memory.row_count[0] = 1


def put_estimate(memory: Memory, q: Floats, out: Request) -> None:
    """Write the attitude (that of the row is q), the centre of mass, and its sd by P alone."""
    for j in range(4):
        out.attitude[j] = q[j]
    for j in range(3):
        at = EQUATIONS + MOMENT + j
        out.com[j] = memory.x[at]
        out.com_sd[j] = variance_of(memory.D, memory.U, at) ** 0.5


def no_rows() -> Rows:
    """Return rows that name the unknowns."""
    return Rows(np.zeros(0), np.zeros((0, EQUATIONS, UNKNOWNS)), np.zeros((0, EQUATIONS)), BODY,
                np.zeros(0, np.int64))  # fmt: skip


def recursion_on(testbed: Testbed) -> tuple[Recursion, Memory]:
    """Return the recursion of a testbed before its first row; InputError without a gyro."""
    gyro = testbed.gyro
    if gyro is None or gyro.rate <= 0:
        raise InputError("method momentum_recursive", "a testbed without a gyro and its rate",
                         "[gyro] with rate_Hz")  # fmt: skip
    rows, k = no_rows(), len(testbed.masses)
    plan = recursion_of(Plan(unfiltered), testbed, rows)
    own = Recursion(
        testbed.body.mass, testbed.gravity, stacked(mass_maps(testbed.masses)),
        EDGE * STILL * np.array([mass.speed for mass in testbed.masses]),
        max(GAP / gyro.rate, SHORTEST), plan.noise, plan.free,
    )  # fmt: skip
    n = EQUATIONS + UNKNOWNS
    x = np.concatenate([np.zeros(EQUATIONS), plan.start])
    D = np.concatenate([np.full(EQUATIONS, plan.free**2), plan.sd**2])
    slopes, rows3 = np.zeros((3, UNKNOWNS + 1)), np.zeros((3, 3))
    memory = Memory(
        x, D, np.zeros(n * (n - 1) // 2), np.zeros(n), np.zeros(n), slopes, slopes.copy(), rows3,
        rows3.copy(), rows3.copy(), np.zeros(3), np.zeros(k), np.zeros(1, np.int64),
        np.zeros(1, np.bool_), np.zeros(1, np.bool_),
    )  # fmt: skip
    return own, memory
