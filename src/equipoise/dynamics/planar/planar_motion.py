"""The motion of a platform whose centre of rotation P floats on a table, in momentum form.

State: attitude q (body to laboratory), the angular momentum L about P of the absolute motion (body
axes), the position p of P and the linear momentum Pi of platform and sled, both in the plane of the
table (laboratory axes, z normal to the table). With V = R^T (v_x, v_y, 0), the velocity of P:

    L  = J w + h + mu x V                    q'  = 1/2 q (0, w)
    Pi = M v + [R (w x mu + mu')]_xy         p'  = v
    L'  = -w x L - V x (w x mu + mu') + mu x g_B + tau
    Pi' = M g s - c(p) v

M is the mass of platform and sled, s the downhill slope of the table, c the friction map, mu' what
moving masses add to the momentum, g_B gravity in body axes. No acceleration of P stands here: L
holds it. By d/dt (mu x V) this is H' = -w x H + mu x (g_B - R^T a_P) + tau with H = J w + h.
(``docs/derivations.md`` derives it; the momentum balance about P is ``dynamics.rigid_body``'s.)
"""

from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import MassMaps
from equipoise.dynamics.planar.friction_map import FrictionMap, friction_at
from equipoise.dynamics.propagation import interpolate, stacked, to_unit
from equipoise.dynamics.regressor import WIDTH
from equipoise.dynamics.rigid_body import KNOWN_D, Body, Now, body_at, cross, motion, times
from equipoise.dynamics.timeline import Timeline
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.kernels.copying import copy_values
from equipoise.model.arrays import Floats, Ints, Quaternion, Triple, Vector3

PLANAR_ROWS = 11  # of the state: q, L, p, Pi
P, PI = 7, 9


class TableTop(NamedTuple):
    """What acts on platform and sled in the plane, and gravity as the attitude's axes have it."""

    floating_mass: float  # kg, platform and sled
    pull: tuple[float, float]  # m/s^2, g times the downhill slope
    gravity_N: Triple  # m/s^2, in the axes of the attitude
    friction: FrictionMap


class Velocities(NamedTuple):
    """How platform and P move."""

    w: Triple  # rad/s, body axes
    v: tuple[float, float]  # m/s, of P, laboratory axes
    V: Triple  # m/s, of P, body axes
    flow: Triple  # kg m/s, w x mu + mu': the platform's momentum relative to P


class PlanarMotion(NamedTuple):
    """A trajectory at every node of the timeline, with the slopes there."""

    state: Floats  # (n+1, 11)
    leaving: Floats  # (n+1, 11) the slope of the step that begins there
    arriving: Floats  # (n+1, 11) of the step that ends there: not the same where a mass starts
    rate: Floats  # (n+1, 3) rad/s
    velocity: Floats  # (n+1, 2) m/s


@part
def along(y: Floats, axis: int) -> Triple:
    """Return a laboratory axis in body axes: a row of R."""
    w, a, b, c = y[0], y[1], y[2], y[3]
    if axis == 0:
        return (1.0 - 2.0 * (b * b + c * c), 2.0 * (a * b - w * c), 2.0 * (a * c + w * b))
    if axis == 1:
        return (2.0 * (a * b + w * c), 1.0 - 2.0 * (a * a + c * c), 2.0 * (b * c - w * a))
    return (2.0 * (a * c - w * b), 2.0 * (b * c + w * a), 1.0 - 2.0 * (a * a + b * b))


@part
def in_body(y: Floats, x: Triple) -> Triple:
    """Return R^T x."""
    e, f, g = along(y, 0), along(y, 1), along(y, 2)
    return (
        x[0] * e[0] + x[1] * f[0] + x[2] * g[0],
        x[0] * e[1] + x[1] * f[1] + x[2] * g[1],
        x[0] * e[2] + x[1] * f[2] + x[2] * g[2],
    )


@part
def inner(a: Triple, b: Triple) -> float:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@part
def moment_rate(maps: Floats, t: Floats, known: Floats, i: int) -> Triple:
    """Return mu' (kg m/s) of the masses that travel within step i."""
    step, x, y, z = t[i + 1] - t[i], 0.0, 0.0, 0.0
    for k in range(maps.shape[0]):
        speed = (known[i + 1, KNOWN_D + k] - known[i, KNOWN_D + k]) / step
        x, y, z = x + speed * maps[k, 0], y + speed * maps[k, 1], z + speed * maps[k, 2]
    return (x, y, z)


@part
def velocities_of(table: TableTop, now: Now, travel: Triple, y: Floats) -> Velocities:
    """Return w and v from both momenta: [J A; A^T M E] (w, v) = (L - h, Pi - (R mu')_xy).

    The columns of A are mu x e, e being the axes of the plane.
    """
    e, f, h = along(y, 0), along(y, 1), now.momentum
    a, b = cross(now.moment, e), cross(now.moment, f)
    free = times(now.inverse, (y[4] - h[0], y[5] - h[1], y[6] - h[2]))
    from_a, from_b = times(now.inverse, a), times(now.inverse, b)
    xx = table.floating_mass - inner(a, from_a)
    xy = -inner(a, from_b)
    yy = table.floating_mass - inner(b, from_b)
    along_x = y[PI] - inner(e, travel) - inner(a, free)
    along_y = y[PI + 1] - inner(f, travel) - inner(b, free)
    size = xx * yy - xy * xy
    vx, vy = (yy * along_x - xy * along_y) / size, (xx * along_y - xy * along_x) / size
    w = (
        free[0] - vx * from_a[0] - vy * from_b[0],
        free[1] - vx * from_a[1] - vy * from_b[1],
        free[2] - vx * from_a[2] - vy * from_b[2],
    )
    V = (vx * e[0] + vy * f[0], vx * e[1] + vy * f[1], vx * e[2] + vy * f[2])
    turning = cross(w, now.moment)
    flow = (turning[0] + travel[0], turning[1] + travel[1], turning[2] + travel[2])
    return Velocities(w, (vx, vy), V, flow)


@part
def planar_slope(
    body: Body, table: TableTop, now: Now, travel: Triple, y: Floats, columns: Floats, dy: Floats
) -> Velocities:
    """Write y', and return the velocities."""
    found = velocities_of(table, now, travel, y)
    motion(body, now, y, found.w, in_body(y, table.gravity_N), columns, dy)
    carried = cross(found.V, found.flow)
    for j in range(3):
        dy[4 + j] -= carried[j]
    c = friction_at(table.friction, y[P], y[P + 1])
    for j in range(2):
        dy[P + j] = found.v[j]
        dy[PI + j] = table.floating_mass * table.pull[j] - c * found.v[j]
    return found


@kernel
def _write_momenta(
    body: Body, table: TableTop, maps: Floats, t: Floats, known: Floats, w: Floats, v: Floats,
    y: Floats,
) -> None:  # fmt: skip
    now, travel = body_at(body, maps, t, known, 0, 0.0), moment_rate(maps, t, known, 0)
    e, f = along(y, 0), along(y, 1)
    rate = (w[0], w[1], w[2])
    V = (v[0] * e[0] + v[1] * f[0], v[0] * e[1] + v[1] * f[1], v[0] * e[2] + v[1] * f[2])
    spin, carried, turning = times(now.inertia, rate), cross(now.moment, V), cross(rate, now.moment)
    flow = (turning[0] + travel[0], turning[1] + travel[1], turning[2] + travel[2])
    for j in range(3):
        y[4 + j] = spin[j] + now.momentum[j] + carried[j]
    y[PI] = table.floating_mass * v[0] + inner(e, flow)
    y[PI + 1] = table.floating_mass * v[1] + inner(f, flow)


class StepWork(NamedTuple):
    """Arrays that a step works in, made once."""

    at: Floats  # (11,) the state within the step
    dy: Floats
    total: Floats
    columns: Floats  # (3, WIDTH) the regressor


@part
def planar_step(
    body: Body, table: TableTop, maps: Floats, t: Floats, known: Floats, i: int, y: Floats,
    first: Floats, work: StepWork,
) -> None:  # fmt: skip
    """Take y over step i, in place; ``first`` is the slope at its beginning."""
    h, travel = t[i + 1] - t[i], moment_rate(maps, t, known, i)
    for j in range(PLANAR_ROWS):
        work.total[j] = first[j]
        work.at[j] = y[j] + 0.5 * h * first[j]
    for k in range(1, 4):
        share, weight = (1.0, 1.0) if k == 3 else (0.5, 2.0)
        ahead = h if k == 2 else 0.5 * h
        now = body_at(body, maps, t, known, i, share)
        planar_slope(body, table, now, travel, work.at, work.columns, work.dy)
        for j in range(PLANAR_ROWS):
            work.total[j] += weight * work.dy[j]
            work.at[j] = y[j] + ahead * work.dy[j]
    for j in range(PLANAR_ROWS):
        y[j] += h / 6 * work.total[j]
    to_unit(y)


@part
def write_node(
    body: Body, table: TableTop, maps: Floats, t: Floats, known: Floats, node: int, y: Floats,
    out: PlanarMotion, columns: Floats,
) -> None:  # fmt: skip
    """Write the state at a node, its velocities, and the slope as the step that leaves it has it.

    At the last node it is that of the step which ends there.
    """
    last = t.shape[0] - 2
    i, share = (last, 1.0) if node > last else (node, 0.0)
    now, travel = body_at(body, maps, t, known, i, share), moment_rate(maps, t, known, i)
    moved = planar_slope(body, table, now, travel, y, columns, out.leaving[node])
    copy_values(y, out.state[node])
    out.rate[node, 0], out.rate[node, 1], out.rate[node, 2] = moved.w
    out.velocity[node, 0], out.velocity[node, 1] = moved.v


@kernel
def _run_planar(
    body: Body, table: TableTop, maps: Floats, t: Floats, known: Floats, first: Floats,
    out: PlanarMotion,
) -> None:  # fmt: skip
    work = StepWork(np.empty(PLANAR_ROWS), np.empty(PLANAR_ROWS), np.empty(PLANAR_ROWS),
                    np.zeros((3, WIDTH)))  # fmt: skip
    y = first.copy()
    write_node(body, table, maps, t, known, 0, y, out, work.columns)
    for i in range(t.shape[0] - 1):
        planar_step(body, table, maps, t, known, i, y, out.leaving[i], work)
        now, travel = body_at(body, maps, t, known, i, 1.0), moment_rate(maps, t, known, i)
        planar_slope(body, table, now, travel, y, work.columns, out.arriving[i + 1])
        write_node(body, table, maps, t, known, i + 1, y, out, work.columns)


class Start(NamedTuple):
    """Where a motion begins."""

    q: Quaternion
    rate: Vector3  # rad/s, body axes
    position: Floats  # (2,) m, of P
    velocity: Floats  # (2,) m/s


def first_state(
    body: Body, table: TableTop, maps: Floats, t: Floats, known: Floats, start: Start
) -> Floats:
    """Return the state (11,) of a start at the first of the nodes t (s) with ``known`` inputs."""
    y = np.concatenate([start.q, np.zeros(3), start.position, np.zeros(2)])
    _write_momenta(body, table, maps, t, known, start.rate, start.velocity, y)
    return y


def run_planar(
    body: Body, table: TableTop, maps: Floats, t: Floats, known: Floats, first: Floats
) -> PlanarMotion:
    """Return the motion from a state (11,) on, at nodes that may also run backward."""
    out = PlanarMotion(*[np.empty((len(t), k)) for k in (*[PLANAR_ROWS] * 3, 3, 2)])
    _run_planar(body, table, maps, t, known, first, out)
    return out


def propagate_planar(
    body: Body, table: TableTop, maps: MassMaps, line: Timeline, start: Start
) -> PlanarMotion:
    """Return the motion at every node, by classical Runge-Kutta of order 4."""
    within = (body, table, stacked(maps), line.t, line.known)
    return run_planar(*within, first_state(*within, start))


@kernel
def _read_planar(
    body: Body, table: TableTop, maps: Floats, t: Floats, known: Floats, motion: PlanarMotion,
    node: Ints, share: Floats, spread: float, states: Floats, rates: Floats,
) -> None:  # fmt: skip
    last = t.shape[0] - 2
    for row in range(node.shape[0]):
        i, s = (last, 1.0) if node[row] > last else (node[row], share[row])
        y = states[row]
        interpolate(motion.state[i], motion.leaving[i], motion.state[i + 1],
                    motion.arriving[i + 1], float(t[i + 1] - t[i]), s, spread, y)  # fmt: skip
        now, travel = body_at(body, maps, t, known, i, s), moment_rate(maps, t, known, i)
        w = velocities_of(table, now, travel, y).w
        for j in range(3):
            rates[row, j] = w[j]


def read_planar(
    body: Body,
    table: TableTop,
    maps: MassMaps,
    line: Timeline,
    motion: PlanarMotion,
    node: Ints,
    share: Floats,
    spread: float,
) -> tuple[Floats, Floats]:
    """Return states (n, 11) and rates (n, 3) within steps: the cubic through both of their ends.

    ``node`` and ``share`` say where each row lies; ``spread`` (s^2) is as of ``interpolate``.
    """
    states, rates = np.empty((len(node), PLANAR_ROWS)), np.empty((len(node), 3))
    where = (line.t, line.known, motion, node, share, float(spread))
    _read_planar(body, table, stacked(maps), *where, states, rates)
    return states, rates
