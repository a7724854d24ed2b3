"""The one propagator: a body along a timeline by classical Runge-Kutta of order 4.

It gives the trajectory, or the trajectory with its sensitivities, or (for the fit) the normal
equations of the residuals without ever storing the sensitivities, so that memory grows with the
data and not with data times parameters.
"""

from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import MassMaps
from equipoise.dynamics.regressor import WIDTH, Triple
from equipoise.dynamics.rigid_body import (
    ERROR,
    INERTIA,
    NO_TORQUE,
    RATE,
    ROWS,
    TURN,
    Body,
    Now,
    body_at,
    forcing,
    gravity_of,
    linearise,
    motion,
    rate_of,
    sensitivity_rates,
    times,
)
from equipoise.dynamics.timeline import Timeline
from equipoise.maths.compiled import kernel, part
from equipoise.model.arrays import Floats, Ints, Quaternion, Vector3, Vector6


class Columns(NamedTuple):
    """Which sensitivities are wanted: a kind and an index within it."""

    kinds: Ints
    indices: Ints


class Motion(NamedTuple):
    """A trajectory at every node of the timeline."""

    q: Floats  # (n+1, 4)
    momentum: Floats  # (n+1, 3) N m s, total about P, body axes
    rate: Floats  # (n+1, 3) rad/s
    turn_by: Floats  # (n+1, 3, columns) d(rotation vector)/dp
    rate_by: Floats  # (n+1, 3, columns) d(rate)/dp


def body_of(
    mass: float, gravity: float, inertia: Vector6, moment: Vector3, torque: Floats | None = None
) -> Body:
    """Return the platform as the kernels see it; ``torque`` are the 16 coefficients."""
    six = tuple(float(x) for x in inertia)
    three = tuple(float(x) for x in moment)
    terms = NO_TORQUE if torque is None else tuple(float(x) for x in torque)
    torqued = any(x != 0 for x in terms)
    return Body(float(mass), float(gravity), six, three, torqued, terms)  # pyright: ignore


@part
def look(
    body: Body,
    maps: Floats,
    t: Floats,
    known: Floats,
    owners: Ints,
    columns: Columns,
    i: int,
    share: float,
    y: Floats,
    regress: Floats,
    fb: Floats,
) -> tuple[Now, Triple, Triple]:
    """Return platform, rate and gravity at ``share`` of step i; write the forcing."""
    now = body_at(body, maps, t, known, i, share)
    w, g = rate_of(now, y), gravity_of(y, body.gravity)
    if fb.shape[1]:
        forcing(body, now, maps, t, known, i, share, owners, columns.kinds, columns.indices,
                w, g, regress, fb)  # fmt: skip
    return now, w, g


@part
def arrive(
    body: Body,
    maps: Floats,
    t: Floats,
    known: Floats,
    owners: Ints,
    columns: Columns,
    node: int,
    y: Floats,
    regress: Floats,
    fb: Floats,
) -> tuple[Now, Triple, Triple]:
    """Look at a node; at a corner of the inputs, as the step that leaves it sees them."""
    last = t.shape[0] - 2
    i, share = (last, 1.0) if node > last else (node, 0.0)
    return look(body, maps, t, known, owners, columns, i, share, y, regress, fb)


@part
def start(
    body: Body,
    maps: Floats,
    t: Floats,
    known: Floats,
    owners: Ints,
    columns: Columns,
    q: Floats,
    w: Floats,
    y: Floats,
    regress: Floats,
    fb: Floats,
) -> None:
    """Write q, H = J w + h and their sensitivities at the first node."""
    n = fb.shape[1]
    now = body_at(body, maps, t, known, 0, 0.0)
    H = times(now.inertia, (w[0], w[1], w[2]))
    y[:] = 0.0
    for j in range(4):
        y[j] = q[j]
    for j in range(3):
        y[4 + j] = H[j] + now.momentum[j]
    look(body, maps, t, known, owners, columns, 0, 0.0, y, regress, fb)
    for c in range(n):
        kind, k = columns.kinds[c], columns.indices[c]
        if kind == TURN:
            y[ROWS + k * n + c] = 1.0
        unit = times(now.inertia, (1.0 * (k == 0), 1.0 * (k == 1), 1.0 * (k == 2)))
        for j in range(3):
            if kind == RATE:
                y[ROWS + (3 + j) * n + c] = unit[j]
            elif kind in (INERTIA, ERROR):
                y[ROWS + (3 + j) * n + c] = fb[j, c]


@part
def slope(
    body: Body, now: Now, w: Triple, g: Triple, y: Floats, regress: Floats, fb: Floats, dy: Floats
) -> None:
    """Write y' from what ``look`` has seen."""
    motion(body, now, y, w, g, regress, dy)
    if fb.shape[1]:
        by_rate, by_turn = linearise(body, now, y, w, g)
        sensitivity_rates(now.inverse, w, by_rate, by_turn, fb, y, dy)


@part
def slope_at(
    body: Body,
    maps: Floats,
    t: Floats,
    known: Floats,
    owners: Ints,
    columns: Columns,
    i: int,
    share: float,
    y: Floats,
    regress: Floats,
    fb: Floats,
    dy: Floats,
) -> None:
    """Write y' at ``share`` of step i."""
    now, w, g = look(body, maps, t, known, owners, columns, i, share, y, regress, fb)
    slope(body, now, w, g, y, regress, fb, dy)


@part
def step_from(
    body: Body,
    maps: Floats,
    t: Floats,
    known: Floats,
    owners: Ints,
    columns: Columns,
    i: int,
    y: Floats,
    first: Floats,
    regress: Floats,
    fb: Floats,
    at: Floats,
    dy: Floats,
    total: Floats,
) -> None:
    """Take y over step i, in place; ``first`` is the slope at its beginning."""
    h, m = t[i + 1] - t[i], y.shape[0]
    for j in range(m):
        total[j] = first[j]
        at[j] = y[j] + 0.5 * h * first[j]
    for k in range(1, 4):
        share, weight = (1.0, 1.0) if k == 3 else (0.5, 2.0)
        ahead = h if k == 2 else 0.5 * h
        slope_at(body, maps, t, known, owners, columns, i, share, at, regress, fb, dy)
        for j in range(m):
            total[j] += weight * dy[j]
            at[j] = y[j] + ahead * dy[j]
    for j in range(m):
        y[j] += h / 6 * total[j]
    to_unit(y)


@part
def to_unit(y: Floats) -> None:
    """Bring the quaternion to unit length."""
    norm = (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + y[3] * y[3]) ** -0.5
    for j in range(4):
        y[j] *= norm


@part
def step(
    body: Body,
    maps: Floats,
    t: Floats,
    known: Floats,
    owners: Ints,
    columns: Columns,
    i: int,
    y: Floats,
    regress: Floats,
    fb: Floats,
    at: Floats,
    dy: Floats,
    total: Floats,
) -> None:
    """Take y over step i, in place."""
    slope_at(body, maps, t, known, owners, columns, i, 0.0, y, regress, fb, total)
    step_from(body, maps, t, known, owners, columns, i, y, total, regress, fb, at, dy, total)


@part
def steady(known: Floats, i: int) -> bool:
    """Say whether no known input changes over step i."""
    for j in range(known.shape[1]):  # noqa: SIM110 - the compiler takes no generator
        if known[i, j] != known[i + 1, j]:
            return False
    return True


@part
def interpolate(
    y0: Floats, dy0: Floats, y1: Floats, dy1: Floats, h: float, share: float, out: Floats
) -> None:
    """Write the state within a step of h seconds: the cubic through both ends and their slopes.

    It errs by (w h)^4 / 384 of a motion's amplitude, w being its frequency.
    """
    s, r = share, 1.0 - share
    a, b, c, d = (1 + 2 * s) * r * r, h * s * r * r, s * s * (3 - 2 * s), -h * s * s * r
    for j in range(out.shape[0]):
        out[j] = a * y0[j] + b * dy0[j] + c * y1[j] + d * dy1[j]
    to_unit(out)


@part
def rate_sensitivity(now: Now, y: Floats, fb: Floats, out: Floats) -> None:
    """Write dw = J^-1 (dH - f) of every column."""
    n = fb.shape[1]
    for c in range(n):
        i = ROWS + 3 * n + c
        dw = times(now.inverse, (y[i] - fb[0, c], y[i + n] - fb[1, c], y[i + 2 * n] - fb[2, c]))
        for j in range(3):
            out[j, c] = dw[j]


@kernel
def _run(
    body: Body,
    maps: Floats,
    t: Floats,
    known: Floats,
    owners: Ints,
    columns: Columns,
    q0: Floats,
    w0: Floats,
    q: Floats,
    H: Floats,
    w: Floats,
    turn_by: Floats,
    rate_by: Floats,
) -> None:
    n = columns.kinds.shape[0]
    m = ROWS + 6 * n
    y, at, dy, total = np.empty(m), np.empty(m), np.empty(m), np.empty(m)
    regress, fb = np.zeros((3, WIDTH)), np.zeros((6, n))
    start(body, maps, t, known, owners, columns, q0, w0, y, regress, fb)
    for node in range(t.shape[0]):
        now, rate, _ = arrive(body, maps, t, known, owners, columns, node, y, regress, fb)
        q[node] = y[:4]
        H[node] = y[4:7]
        for j in range(3):
            w[node, j] = rate[j]
            for c in range(n):
                turn_by[node, j, c] = y[ROWS + j * n + c]
        rate_sensitivity(now, y, fb, rate_by[node])
        if node < t.shape[0] - 1:
            step(body, maps, t, known, owners, columns, node, y, regress, fb, at, dy, total)


NO_COLUMNS = Columns(np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64))


def stacked(maps: MassMaps) -> Floats:
    """Return the mass maps side by side, one row a mass."""
    return np.hstack([maps.first_moment, maps.inertia_1, maps.inertia_2, maps.momentum])


def propagate(
    body: Body,
    maps: MassMaps,
    line: Timeline,
    q0: Quaternion,
    w0: Vector3,
    columns: Columns = NO_COLUMNS,
) -> Motion:
    """Return the motion at every node, with its sensitivities to ``columns``."""
    n, c = len(line.t), len(columns.kinds)
    out = Motion(*[np.zeros((n, *s)) for s in ((4,), (3,), (3,), (3, c), (3, c))])
    _run(body, stacked(maps), line.t, line.known, line.error_mass, columns, q0, w0, *out)
    return out
