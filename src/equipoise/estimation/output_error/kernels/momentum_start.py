"""The linear start of the fit for many records with the same times, as one compiled kernel.

The momentum balance in laboratory axes (``regression.formulations.momentum``), of a record each,

    R W(w) p_J - int m (R r) x g_N - H0_N = -R (dJ w + h) + int (R dmu) x g_N + int R tau

has twelve unknowns: J, com and the first momentum. What masses, wheels and torques do is the same
in all records; attitude and rate are not. The priors are those of ``initial_guess``.
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.rigid_body import invert, times
from equipoise.estimation.parameters.retraction import away, plus, six_at
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.local_motion import (
    Window,
    suitable_half,
    weigh,
    weights_of,
    window_of,
)
from equipoise.maths.pseudo_inertia import exceeds, second_moments_of
from equipoise.maths.scaled_solve import scaled_solve
from equipoise.maths.turns import to_body, to_laboratory, turned
from equipoise.model.arrays import Bools, Floats, Ints, Triple

JR, H0, KNOWN = 9, 12, 12  # how many are J and com; all unknowns; the column of the known side
WIDTH = 16  # numbers in a row of the balance: the last ones stay zero


class Inputs(NamedTuple):
    """What is the same in all records, at the n times of the camera."""

    t: Floats  # (n,) s
    period: float  # s, the median
    first: Ints  # (n,) rows by which each step is integrated,
    weights: Floats  # (n, 3) s, and how
    bend: Floats  # (n, 6) kg m^2, dJ of masses off home
    momentum: Floats  # (n, 3) N m s, of masses that travel and of wheels
    shifted: Floats  # (n, 3) kg m, dmu of masses off home
    impulse: Floats  # (n, 3) N m s, integral of the known torque
    rate_rows: Ints  # (n, 2) rows of the gyro around each: the first, and behind the last
    with_gyro: Bools  # (n,) whether the gyro's rate is taken
    mass: float
    gravity: float


class Body(NamedTuple):
    """What is believed of the platform beforehand, and how firmly."""

    guess: Floats  # (9,) J and com
    sizes: Floats  # (6,) kg m^2, of the inertia's elements
    com_sd: Floats  # (3,) m
    momentum_size: float  # N m s, natural to the first momentum
    trusts: Floats  # relative sd of the inertia, tried in turn until a body comes out possible
    correlated: float  # by how much more than rows say their errors weigh together


class Tools(NamedTuple):
    """Arrays in which a record is worked on, made once."""

    parts: Floats  # (4, n) attitude
    terms: Floats  # (n, 2, 3) of the local polynomials
    q: Floats  # (n, 4) smoothed
    w: Floats  # (n, 3) rad/s
    running: Floats  # (rows + 1, 3) sums of the gyro
    pushes: Floats  # (n, 8) what is integrated
    rows: Floats  # (3 n, WIDTH) regressor and known side
    normal: Floats  # (WIDTH, WIDTH)


@kernel
def tools_for(n: int, rate_rows: int) -> Tools:
    """Return the arrays for records of so many rows."""
    return Tools(np.empty((4, n)), np.zeros((n, 2, 3)), np.empty((n, 4)), np.empty((n, 3)),
                 np.zeros((rate_rows + 1, 3)), np.zeros((n, 8)), np.zeros((3 * n, WIDTH)),
                 np.zeros((WIDTH, WIDTH)))  # fmt: skip


@part
def sampled(inputs: Inputs, attitude: Floats, rate: Floats, tools: Tools) -> None:
    """Write attitude and rate from the local polynomials and the gyro's means."""
    running, q, w = tools.running, tools.q, tools.w
    for i in range(rate.shape[0]):
        for c in range(3):
            running[i + 1, c] = running[i, c] + rate[i, c]
    for k in range(inputs.t.shape[0]):
        still, slope = tools.terms[k, 0], tools.terms[k, 1]
        q[k, 0], q[k, 1], q[k, 2], q[k, 3] = turned(attitude[k], still[0], still[1], still[2])
        a, b = inputs.rate_rows[k, 0], inputs.rate_rows[k, 1]
        for c in range(3):
            w[k, c] = slope[c]
            if inputs.with_gyro[k]:
                w[k, c] = (running[b, c] - running[a, c]) / (b - a)


@part
def laboratory(inputs: Inputs, k: int, q: Floats, w: Floats, rows: Floats, push: Floats) -> None:
    """Write R W(w) and -R (dJ w + h) of a row, and what is integrated: R's first rows, R dmu."""
    x = to_laboratory(q, (1.0, 0.0, 0.0))
    y = to_laboratory(q, (0.0, 1.0, 0.0))
    z = to_laboratory(q, (0.0, 0.0, 1.0))
    s, h = inputs.shifted[k], inputs.momentum[k]
    dh = times(six_at(inputs.bend[k], 0), (w[0], w[1], w[2]))
    known = (dh[0] + h[0], dh[1] + h[1], dh[2] + h[2])
    for c in range(3):
        out = rows[c]
        out[0], out[1], out[2] = x[c] * w[0], y[c] * w[1], z[c] * w[2]
        out[3], out[4] = x[c] * w[1] + y[c] * w[0], x[c] * w[2] + z[c] * w[0]
        out[5] = y[c] * w[2] + z[c] * w[1]
        out[KNOWN] = -(x[c] * known[0] + y[c] * known[1] + z[c] * known[2])
    for c in range(2):
        push[4 * c], push[4 * c + 1], push[4 * c + 2] = x[c], y[c], z[c]
        push[4 * c + 3] = x[c] * s[0] + y[c] * s[1] + z[c] * s[2]


@part
def turned_impulse(inputs: Inputs, k: int, q: Floats) -> Triple:
    """Return R dI of the step that ends at row k, R even between the rows."""
    now, before = inputs.impulse[k], inputs.impulse[k - 1]
    step = (now[0] - before[0], now[1] - before[1], now[2] - before[2])
    a, b = to_laboratory(q[k], step), to_laboratory(q[k - 1], step)
    return (0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]))


@kernel  # not a part: it makes an array
def integrate(inputs: Inputs, tools: Tools) -> None:
    """Add the integrals to the rows of the momentum balance."""
    weight, g = inputs.mass * inputs.gravity, inputs.gravity
    sums, gained = np.zeros(8), (0.0, 0.0, 0.0)
    for k in range(1, inputs.t.shape[0]):
        i, by = inputs.first[k], inputs.weights[k]
        a, b, c = tools.pushes[i], tools.pushes[i + 1], tools.pushes[i + 2]
        for j in range(sums.shape[0]):
            sums[j] += by[0] * a[j] + by[1] * b[j] + by[2] * c[j]
        d = turned_impulse(inputs, k, tools.q)
        gained = (gained[0] + d[0], gained[1] + d[1], gained[2] + d[2])
        x, y, z = tools.rows[3 * k], tools.rows[3 * k + 1], tools.rows[3 * k + 2]
        for j in range(3):
            x[6 + j], y[6 + j] = weight * sums[4 + j], -weight * sums[j]
        x[KNOWN] += gained[0] - g * sums[7]
        y[KNOWN] += gained[1] + g * sums[3]
        z[KNOWN] += gained[2]


@part
def add_squares(rows: Floats, normal: Floats) -> None:
    """Write the normal matrix of rows."""
    normal[:] = 0.0
    width = min(WIDTH, normal.shape[1])  # a count that the compiler does not know, see ``add_row``
    for k in range(rows.shape[0]):
        row = rows[k]
        for i in range(KNOWN + 1):
            size, out = row[i], normal[i]
            for c in range(width):
                out[c] += size * row[c]


@kernel
def balance(inputs: Inputs, tools: Tools) -> None:
    """Write the rows of the momentum balance, and their normal matrix."""
    for k in range(inputs.t.shape[0]):
        rows = tools.rows[3 * k : 3 * k + 3]
        laboratory(inputs, k, tools.q[k], tools.w[k], rows, tools.pushes[k])
        for c in range(3):
            rows[c, JR + c] = -1.0
    integrate(inputs, tools)
    add_squares(tools.rows, tools.normal)


@part
def natural_sizes(body: Body, trust: float, spread: Floats) -> None:
    """Write the sd of the priors of J and com, and a size natural to the first momentum."""
    for k in range(6):
        spread[k] = trust * body.sizes[k]
    for k in range(3):
        spread[6 + k], spread[JR + k] = body.com_sd[k], body.momentum_size


@kernel  # not a part: it makes arrays
def with_inertia_held(scaled: Floats, pull: Floats, spread: Floats) -> Floats:
    """Return J as guessed, and com and first momentum beside it (12,); ``scaled`` has b behind."""
    free = scaled[6:H0, KNOWN].copy()
    for a in range(H0 - 6):
        for b in range(6):
            free[a] -= scaled[6 + a, b] * pull[b]
    held = pull.copy()
    held[6:] = scaled_solve(scaled[6:H0, 6:H0].copy(), free, 1e-10)
    return held * spread


@kernel
def solution(tools: Tools, body: Body, trust: float, best: Floats) -> None:
    """Write J, com and first momentum (12,), the testbed's inertia known to ``trust``.

    What is left with the inertia as guessed decides how much the priors weigh.
    """
    spread, pull, scaled = np.empty(H0), np.zeros(H0), np.empty((H0, KNOWN + 1))
    natural_sizes(body, trust, spread)
    pull[:JR] = body.guess / spread[:JR]
    for a in range(H0):
        scaled[a, KNOWN] = spread[a] * tools.normal[a, KNOWN]
        for b in range(H0):
            scaled[a, b] = spread[a] * spread[b] * tools.normal[a, b]
    left = rms_left(tools.rows, with_inertia_held(scaled, pull, spread))
    noise = max(body.correlated * left, 1e-9)
    normal = scaled[:, :H0] / noise**2
    for a in range(JR):
        normal[a, a] += 1.0
    best[:] = spread * scaled_solve(normal, scaled[:, KNOWN] / noise**2 + pull, 0.0)


@part
def rms_left(rows: Floats, x: Floats) -> float:
    """Return the root mean square of what a solution leaves of the balance, N m s."""
    total = 0.0
    for k in range(rows.shape[0]):
        left = rows[k, KNOWN]
        for a in range(H0):
            left -= rows[k, a] * x[a]
        total += left * left
    return (total / rows.shape[0]) ** 0.5


@part
def is_possible(found: Floats, mass: float) -> bool:
    """Say whether J about P and com are those of a body that can exist."""
    com = (found[6], found[7], found[8])
    return exceeds(second_moments_of(plus(six_at(found, 0), away(mass, com), -1.0)), 0.0)


@part
def first_rate(inputs: Inputs, found: Floats, q: Floats, w: Floats) -> Triple:
    """Return J^-1 (R^T H0_N - dJ w - h) at the first row, rad/s."""
    h, dh = inputs.momentum[0], times(six_at(inputs.bend[0], 0), (w[0], w[1], w[2]))
    H = to_body(q, (found[9], found[10], found[11]))
    return times(invert(six_at(found, 0)), (H[0] - dh[0] - h[0], H[1] - dh[1] - h[1],
                                            H[2] - dh[2] - h[2]))  # fmt: skip


@kernel
def start_each(
    inputs: Inputs, body: Body, attitudes: Floats, rates: Floats, bodies: Floats, motions: Floats
) -> None:
    """Write J and com (k, 9), and of each record's first row (k, 10) q, w and the momentum's w."""
    n, half, window = inputs.t.shape[0], 0.0, Window(0, 1, 1, 0.0)
    tools, weights, found = tools_for(n, rates.shape[1]), np.zeros((n, 2, 1)), np.empty(H0)
    for k in range(attitudes.shape[0]):
        q = attitudes[k]
        suits = suitable_half(inputs.t, q, inputs.period)
        if suits != half:
            half, window = suits, window_of(suits, inputs.period, n)
            weights = weights_of(inputs.t, window)
        weigh(q, tools.parts, window, weights, tools.terms)
        sampled(inputs, q, rates[k], tools)
        balance(inputs, tools)
        for trust in body.trusts:
            solution(tools, body, trust, found)
            if is_possible(found, inputs.mass):
                break
        else:
            found[:JR] = body.guess
        bodies[k] = found[:JR]
        w = first_rate(inputs, found, tools.q[0], tools.w[0])
        motions[k, :4], motions[k, 4:7] = tools.q[0], tools.w[0]
        motions[k, 7], motions[k, 8], motions[k, 9] = w
