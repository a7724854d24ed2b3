"""A record of a platform on a table as a least-squares problem: residuals in units of their noise.

    sum |log(q_pred^-1 q_meas)|^2 / sd_q^2 + sum |p_meas - p|^2 / sd_p^2
    + sum |w_meas - w - b|^2 / sd_w^2 + priors

through the propagator of five degrees of freedom. The state between nodes is the cubic through both
ends and their slopes. Sensitivities are differences of the whole record, which needs no second set
of equations: they err by a millionth, in natural sizes, of what the second derivatives are.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.actuators.sliding_masses import MassMaps, mass_maps
from equipoise.dynamics.planar.friction_map import FrictionMap
from equipoise.dynamics.planar.planar_motion import (
    P,
    PlanarMotion,
    Start,
    TableTop,
    propagate_planar,
    read_planar,
)
from equipoise.dynamics.propagation import body_of
from equipoise.dynamics.regressor import N_TORQUES
from equipoise.dynamics.rigid_body import Body
from equipoise.dynamics.timeline import TURN_PER_STEP, Timeline, place, timeline
from equipoise.estimation.planar.planar_layout import (
    BIAS,
    INPUTS,
    LEAN,
    POSITION,
    SLOPE,
    VELOCITY,
    PlanarLayout,
    PlanarPrior,
)
from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.arrays import Floats, Ints, Quaternion, Series1
from equipoise.model.estimate import ATTITUDE, COM, INERTIA, RATE
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.recording import Recording, Samples
from equipoise.model.table_top import PlanarTable
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import TERMS
from equipoise.sensors.timing import measured_at, spread_of

STEP = 1e-6  # natural sizes, chosen: rounding then errs by 1e-8 of them
LONGEST = 0.05  # s, chosen: of a step; the cubic errs by (w h)^4 / 384 of a swing of frequency w
NOTHING = Samples(np.zeros(0), np.zeros((0, 3)))


@dataclass(frozen=True, slots=True, eq=False)
class Channel:
    """One sensor's rows, where they lie on the timeline, and their noise."""

    rows: Samples
    node: Ints
    share: Floats
    sd: float
    spread: float  # s^2, of the moments that a row is the mean of


@dataclass(frozen=True, slots=True, eq=False)
class PlanarProblem:
    """Everything that does not change while the unknowns are sought."""

    testbed: Testbed
    table: PlanarTable
    layout: PlanarLayout
    prior: PlanarPrior
    size: Floats  # natural, of each unknown
    maps: MassMaps
    line: Timeline
    attitude: Channel
    position: Channel
    rate: Channel

    @property
    def rows(self) -> int:
        """Return how many numbers were measured."""
        channels = (self.attitude, self.position, self.rate)
        width = (3, 2, 3)
        return sum(w * len(c.rows) for w, c in zip(width, channels, strict=True))


@dataclass(frozen=True, slots=True, eq=False)
class Point:
    """A point of the search: the first attitude, and all unknowns; the turn is from ``q0``."""

    q0: Quaternion
    values: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Left:
    """What a point leaves of each sensor, in units of its noise."""

    attitude: Floats  # (n, 3)
    position: Floats  # (n, 2)
    rate: Floats  # (n, 3)

    @property
    def flat(self) -> Floats:
        """Return all residuals."""
        return np.concatenate([self.attitude.ravel(), self.position.ravel(), self.rate.ravel()])


def line_of(recording: Recording, testbed: Testbed) -> tuple[Timeline, tuple[Series1, ...]]:
    """Return the timeline of a record, and when each sensor measured (s)."""
    attitude, position, rate = recording.attitude, recording.position, recording.rate or NOTHING
    assert attitude is not None
    assert position is not None
    assert testbed.position is not None
    times = (
        measured_at(attitude.t, testbed.attitude),
        position.t - testbed.position.delay,
        measured_at(rate.t, testbed.gyro),
    )
    longest = min(LONGEST, TURN_PER_STEP / fastest_turn(recording))
    line = timeline(
        np.union1d(times[0], times[1]),
        times[2],
        recording.masses,
        len(testbed.masses),
        longest,
        recording.momentum,
        recording.torque,
        at_nodes=False,
    )
    return line, times


def fastest_turn(recording: Recording) -> float:
    """Return the greatest rate (rad/s) that rows of the attitude have between them, smoothed."""
    rows = recording.attitude
    assert rows is not None
    stride = max(len(rows) // 200, 1)
    q, t = rows.values[::stride], rows.t[::stride]
    turned = np.linalg.norm(difference(q[1:], q[:-1]), axis=1) / np.diff(t)
    return float(max(np.max(turned, initial=0.0), 1e-3))


def pose(
    recording: Recording, testbed: Testbed, layout: PlanarLayout, prior: PlanarPrior, size: Floats
) -> PlanarProblem:
    """Return the problem of a record, whose masses are arranged as the testbed has them."""
    line, (attitude_t, position_t, rate_t) = line_of(recording, testbed)
    camera, sensor, gyro, table = (
        testbed.attitude, testbed.position, testbed.gyro, testbed.table
    )  # fmt: skip
    assert recording.attitude is not None
    assert recording.position is not None
    assert camera is not None
    assert sensor is not None
    assert table is not None
    return PlanarProblem(
        testbed,
        table,
        layout,
        prior,
        size,
        mass_maps(testbed.masses),
        line,
        Channel(recording.attitude, *place(line.t, attitude_t), camera.noise, spread_of(camera)),
        Channel(recording.position, *place(line.t, position_t), sensor.noise, 0.0),
        Channel(
            recording.rate or NOTHING,
            *place(line.t, rate_t),
            gyro.noise if gyro is not None else 1.0,
            spread_of(gyro),
        ),
    )


def grid_of(table: PlanarTable, values: Floats) -> FrictionMap:
    """Return the map with these values (n, n) at nodes that spread evenly over the table."""
    cells = max(len(values) - 1, 1)
    (x, y), (dx, dy) = table.low, (table.high - table.low) / cells
    return FrictionMap(float(x), float(y), float(dx), float(dy), values)


def table_top(problem: PlanarProblem, values: Floats) -> TableTop:
    """Return what acts on platform and sled at these unknowns."""
    layout, testbed, table = problem.layout, problem.testbed, problem.table
    mass_error, sled_error, gravity_error = values[layout.of(*INPUTS)]
    mass = testbed.body.mass * (1 + mass_error) + table.sled_mass * (1 + sled_error)
    g = testbed.gravity * (1 + gravity_error)
    (sx, sy), (lx, ly) = values[layout.of(*SLOPE)], values[layout.of(*LEAN)]
    x, y = sx + lx, sy + ly
    down = (float(g * x), float(g * y), float(-g * np.sqrt(1 - x * x - y * y)))
    nodes = np.ascontiguousarray(values[layout.friction].reshape(layout.nodes, layout.nodes))
    pull = (float(g * sx), float(g * sy))
    return TableTop(float(mass), pull, down, grid_of(table, nodes))


def platform_of(problem: PlanarProblem, values: Floats) -> Body:
    """Return the platform at these unknowns."""
    layout, testbed = problem.layout, problem.testbed
    mass_error, _, gravity_error = values[layout.of(*INPUTS)]
    mass, torque = testbed.body.mass * (1 + mass_error), np.zeros(N_TORQUES)
    torque[[TERMS.index(term) for term in layout.terms]] = values[layout.of(*layout.terms)]
    J, r = values[layout.of(*INERTIA)], values[layout.of(*COM)]
    return body_of(float(mass), float(testbed.gravity * (1 + gravity_error)), J, mass * r, torque)


def possible(problem: PlanarProblem, values: Floats) -> bool:
    """Say whether some body has the inertia and the centre of mass of these unknowns."""
    layout = problem.layout
    J = unpack_symmetric(values[layout.of(*INERTIA)])
    if not np.all(np.isfinite(values)):
        return False
    return is_possible(MassProperties(problem.testbed.body.mass, values[layout.of(*COM)], J))


def motion_at(problem: PlanarProblem, point: Point) -> tuple[TableTop, Body, PlanarMotion]:
    """Return the motion of a point along the record."""
    layout, values = problem.layout, point.values
    table, body = table_top(problem, values), platform_of(problem, values)
    q = multiply(point.q0, exponential(values[layout.of(*ATTITUDE)]))
    start = Start(q, values[layout.of(*RATE)], values[layout.of(*POSITION)],
                  values[layout.of(*VELOCITY)])  # fmt: skip
    return table, body, propagate_planar(body, table, problem.maps, problem.line, start)


def left_of(problem: PlanarProblem, point: Point) -> Left:
    """Return what a point leaves."""
    table, body, motion = motion_at(problem, point)

    def read(channel: Channel) -> tuple[Floats, Floats]:
        where = (channel.node, channel.share, channel.spread)
        return read_planar(body, table, problem.maps, problem.line, motion, *where)

    turned, _ = read(problem.attitude)
    placed, _ = read(problem.position)
    _, rate = read(problem.rate)
    bias = point.values[problem.layout.of(*BIAS)] if len(rate) else np.zeros(3)
    return Left(
        difference(problem.attitude.rows.values, turned[:, :4]) / problem.attitude.sd,
        (problem.position.rows.values - placed[:, P : P + 2]) / problem.position.sd,
        (problem.rate.rows.values - rate - bias) / problem.rate.sd,
    )


def sensitivities(problem: PlanarProblem, point: Point, left: Left) -> Floats:
    """Return d(residuals)/d(unknowns), (rows, unknowns), ``left`` being what the point leaves.

    Of what is held it is zero.
    """
    out, here = np.zeros((problem.rows, problem.layout.size)), left.flat
    for k in np.flatnonzero(~problem.prior.held):
        values = point.values.copy()
        values[k] += STEP * problem.size[k]
        out[:, k] = left_of(problem, replace(point, values=values)).flat - here
        out[:, k] /= STEP * problem.size[k]
    return out
