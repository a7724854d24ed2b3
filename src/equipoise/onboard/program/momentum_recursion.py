"""The method ``momentum_recursive`` row by row: integrals by parabolas, two rows at a time.

    A = [ W(w) + int w x W(w),  -m int (e_i x g_B) ],    b = int (dmu x g_B - w x k) - k

with k = dJ(d) w of masses that stand off home. The integral over a step takes a third row
(``running_integral``), so an odd row of a piece waits for the next one, and both are then taken.
``learn_row`` is the recursion's own kernel.

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
from equipoise.estimation.regression.formulations.rows import Rows, values_of
from equipoise.estimation.regression.solvers.recursion import Plan, recursion_of, unfiltered
from equipoise.estimation.regression.solvers.recursive import begin, learn_row, restart
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

    x: Floats  # (12,) J, com, constants of the piece
    P: Floats  # (12, 12)
    h: Floats  # (12,)
    gain: Floats  # (12,)
    A: Floats  # (3, 9)
    b: Floats  # (3,)
    total: Floats  # (3, 10) integrals up to the last pair
    slopes: Floats  # (3, 3, 10) what is integrated, at the last three rows
    rates: Floats  # (3, 3) rad/s at these rows
    times: Floats  # (3,) s from the first of them
    last_d: Floats  # (k,) m
    count: Ints  # (1,) rows of the piece
    begun: Bools  # (1,)


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


def put_slopes(own: Recursion, w: Triple, q: Floats, d: Floats, out: Floats) -> None:
    """Write what is integrated: w x W(w), m e_i x g_B, dmu x g_B - w x k."""
    g = gravity_of(q, own.gravity)
    momentum_columns(w, out)
    for j in range(MOMENT):
        turned = cross(w, (out[0, j], out[1, j], out[2, j]))
        out[0, j], out[1, j], out[2, j] = turned[0], turned[1], turned[2]
    cross_columns(g, own.mass, MOMENT, out)
    weight, swirl = cross(moment_of(own.maps, d), g), cross(w, times(bend_of(own.maps, d), w))
    for i in range(3):
        out[i, UNKNOWNS] = weight[i] - swirl[i]


def put_step(memory: Memory, near: int, middle: int, distant: int) -> None:
    """Add the step from row ``near`` to ``middle``, of the parabola through ``distant``."""
    t, y, total = memory.times, memory.slopes, memory.total
    first, second = t[middle] - t[near], t[distant] - t[middle]
    size, r = abs(first), first / (first + second)
    bend = r * (first / second)
    for i in range(3):
        for j in range(UNKNOWNS + 1):
            inner = (3.0 - r) * y[near, i, j] + (3.0 + bend + r) * y[middle, i, j]
            total[i, j] += size / 6.0 * (inner - bend * y[distant, i, j])


def learn(own: Recursion, memory: Memory, row: int, d: Floats) -> None:
    """Take the three equations of a row."""
    A, b, total = memory.A, memory.b, memory.total
    w = (memory.rates[row, 0], memory.rates[row, 1], memory.rates[row, 2])
    momentum_columns(w, A)
    k = times(bend_of(own.maps, d), w)
    for i in range(3):
        for j in range(MOMENT):
            A[i, j] += total[i, j]
        for j in range(MOMENT, UNKNOWNS):
            A[i, j] = -total[i, j]
        b[i] = total[i, UNKNOWNS] - k[i]
    learn_row(A, b, own.noise, memory.x, memory.P, memory.h, memory.gain)


def begin_piece(own: Recursion, memory: Memory) -> None:
    """Begin the integrals and their constants anew."""
    restart(memory.x, memory.P, UNKNOWNS, own.free * own.free)
    for i in range(3):
        for j in range(UNKNOWNS + 1):
            memory.total[i, j] = 0.0
    memory.count[0] = 0


def take_pair(own: Recursion, memory: Memory, d: Floats) -> None:
    """Take the two rows that end a pair of steps, and keep the last as the next pair's first."""
    put_step(memory, 0, 1, 2)
    learn(own, memory, 1, d)
    put_step(memory, 2, 1, 0)
    learn(own, memory, 2, d)
    for i in range(3):
        memory.rates[0, i] = memory.rates[2, i]
        for j in range(UNKNOWNS + 1):
            memory.slopes[0, i, j] = memory.slopes[2, i, j]


def stands(own: Recursion, memory: Memory, dt: float, d: Floats) -> bool:
    """Say whether all masses have stood since the last row; note where they are."""
    still = True
    for k in range(d.shape[0]):
        if abs(d[k] - memory.last_d[k]) > own.slowest[k] * dt:
            still = False
        memory.last_d[k] = d[k]
    return still


def take_row(
    own: Recursion, memory: Memory, dt: float, q: Floats, rate: Floats, d: Floats
) -> None:
    """Take attitude (w x y z) and rate (rad/s) dt s after the last, with the masses at d m."""
    goes_on = stands(own, memory, dt, d) and dt <= own.gap
    if not (goes_on and memory.begun[0]):
        begin_piece(own, memory)
    memory.begun[0] = True
    row = memory.count[0]
    w = (rate[0], rate[1], rate[2])
    memory.times[row] = memory.times[row - 1] + dt if row > 0 else 0.0
    for i in range(3):
        memory.rates[row, i] = rate[i]
    put_slopes(own, w, q, d, memory.slopes[row])
    memory.count[0] = row + 1
    if row == 0:
        learn(own, memory, 0, d)
    if row == 2:
        take_pair(own, memory, d)
        memory.count[0] = 1


def put_estimate(memory: Memory, q: Floats, out: Request) -> None:
    """Write the attitude (that of the row is q), the centre of mass at home, and its sd by P alone."""
    for j in range(4):
        out.attitude[j] = q[j]
    for j in range(3):
        at = MOMENT + j
        out.com[j] = memory.x[at]
        out.com_sd[j] = max(memory.P[at, at], 0.0) ** 0.5


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
    state = begin(plan, constants=True)
    assert set(values_of(testbed)) == set(BODY)
    own = Recursion(
        testbed.body.mass, testbed.gravity, stacked(mass_maps(testbed.masses)),
        EDGE * STILL * np.array([mass.speed for mass in testbed.masses]),
        max(GAP / gyro.rate, SHORTEST), plan.noise, plan.free,
    )  # fmt: skip
    c = UNKNOWNS
    memory = Memory(
        state.x, state.P, np.zeros(c + 3), np.zeros(c + 3), np.zeros((3, c)), np.zeros(3),
        np.zeros((3, c + 1)), np.zeros((3, 3, c + 1)), np.zeros((3, 3)), np.zeros(3),
        np.zeros(k), np.zeros(1, np.int64), np.zeros(1, np.bool_),
    )  # fmt: skip
    return own, memory
