"""Whether the torque of all causes closes the momentum balance, by the sensors' own rows.

    left = [ J (w~_(k+1) - w~_k) + int w x (J w + h) dt + h_(k+1) - h_k - int tau dt ] / interval
           - total,        J: masses as the record begins;  h, tau: of wheels and known torque

w~ is the rate that rows near the ends of an interval show by themselves: of a gyro the mean of its
rows there, of a camera alone the slope of its attitudes. Rows are compared with the smoothed motion
within the window, so that its curvature does not count as error. The smoothed motion, not the rows,
gives the integral: its error there is small beside that of w~.

    sd^2 = J (V_k + V_(k+1)) J^T / interval^2,      V of the rows' noise alone

an upper bound, as the smoothed torque follows the same rows. An interval without rows at one of its
ends has no closure: NaN.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.dynamics.timeline import SAME
from equipoise.estimation.output_error.problem import Problem, forward_of, posed
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.parameters.fit_parameters import JP, RATE, Unknowns, unknowns_of
from equipoise.estimation.torque_by_cause.by_cause import moved_point
from equipoise.estimation.torque_by_cause.stretch_motion import (
    Within,
    followed,
    inertia_at,
    known_at,
)
from equipoise.maths.attitude import difference, exponential, multiply, to_matrix
from equipoise.maths.linalg import unpack_symmetric
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Ints, Matrix3, Series1, Series3, Series4
from equipoise.model.torque_by_cause import MomentumClosure
from equipoise.sensors.camera import said_along
from equipoise.sensors.gyro import gyro_matrix

GYRO_WINDOW, CAMERA_WINDOW = 0.1, 0.5  # s to either side, chosen: a tenth of an interval, and half
FEWEST = 3  # rows to either side, at least


class RateErrors(NamedTuple):
    """Measured less smoothed rate at some times, and its variance about each axis."""

    error: Series3  # (n, 3) rad/s, body axes
    variance: Series1  # (n,) (rad/s)^2; NaN without rows


class Motions(NamedTuple):
    """The smoothed motion of all stretches."""

    of: list[Within]
    first: Unknowns
    begins: Series1  # (K + 1,) s since the record began


def motions_of(fitted: Fitted, steps: Floats) -> Motions:
    """Return the motion of all stretches, off that of a fit by steps (K, n), of first order."""
    problem, points = fitted.problem, [unknowns_of(flat) for flat in fitted.at.pieces.points]
    nodes, known = posed(problem).cuts.nodes, known_at(problem, points[0])
    found = [
        off_by(followed(problem, known, slice(int(a), int(b) + 1), point), step)
        for a, b, point, step in zip(nodes, nodes[1:], points, steps, strict=False)
    ]
    return Motions(found, moved_point(points[0], steps[0], problem),
                   problem.line.t[nodes] - problem.line.t[0])  # fmt: skip


def off_by(at: Within, step: Floats) -> Within:
    """Return a motion whose unknowns are off by a step, of first order."""
    motion, own = at.motion, step[: at.motion.rate_by.shape[2]]
    q = multiply(motion.q, exponential(motion.turn_by @ own))
    return at._replace(motion=motion._replace(q=q, rate=motion.rate + motion.rate_by @ own))


def rows_within(motions: Motions, t: Series1) -> list[slice]:
    """Return the rows of times (s, since the record began) that each stretch has."""
    edges = np.searchsorted(t, motions.begins[1:-1])
    return [slice(a, b) for a, b in zip([0, *edges], [*edges, len(t)], strict=True)]


def attitudes(motions: Motions, t: Series1) -> Series4:
    """Return the smoothed attitudes at times (s, since the record began)."""
    found: list[Floats] = []
    for at, rows in zip(motions.of, rows_within(motions, t), strict=True):
        rate = np.hstack([np.zeros((len(at.t), 1)), at.motion.rate])
        line = CubicHermiteSpline(at.t, at.motion.q, 0.5 * multiply(at.motion.q, rate))
        found.append(np.asarray(line(t[rows]), dtype=np.float64).reshape(-1, 4))
    q = np.vstack(found)
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def rates(motions: Motions, t: Series1) -> Series3:
    """Return the smoothed rates (rad/s) at times (s, since the record began)."""
    pieces = zip(motions.of, rows_within(motions, t), strict=True)
    return np.vstack([read_at(t[rows], at.t, at.motion.rate) for at, rows in pieces])


def by_gyro(problem: Problem, motions: Motions, edges: Series1) -> RateErrors:
    """Return the rates that the gyro shows around times ``edges`` (s)."""
    line, measured, point = problem.line, problem.observed, motions.first
    t = moments(problem, line.rate_node, line.rate_share)
    matrix = np.array(gyro_matrix(point.sensor), dtype=np.float64).reshape(3, 3)
    rows = np.linalg.solve(matrix, (measured.rate - point.bias).T).T - rates(motions, t)
    first, last = around(t, edges, GYRO_WINDOW)
    count = last - first
    running = np.vstack([np.zeros((1, 3)), np.cumsum(rows, axis=0)])
    with np.errstate(invalid="ignore", divide="ignore"):
        error = (running[last] - running[first]) / count[:, None]
        return RateErrors(error, np.where(count > 0, measured.rate_sd**2 / count, np.nan))


def by_camera(problem: Problem, motions: Motions, edges: Series1) -> RateErrors:
    """Return the rates that the camera's attitudes show around times ``edges`` (s)."""
    line, measured = problem.line, problem.observed
    t = moments(problem, line.attitude_node, line.attitude_share)
    q, said = attitudes(motions, t), np.empty((len(t), 4))
    said_along(q, forward_of(problem.testbed.up), motions.first.sensor, said)
    off = np.einsum("nij,nj->ni", to_matrix(q), difference(measured.attitude, said))
    first, last = around(t, edges, CAMERA_WINDOW)
    error, variance = np.full((len(edges), 3), np.nan), np.full(len(edges), np.nan)
    turn = to_matrix(attitudes(motions, edges))
    for k, (a, b) in enumerate(zip(first, last, strict=True)):
        centred = t[a:b] - t[a:b].mean() if b - a >= FEWEST else np.zeros(0)
        spread = float(centred @ centred)
        if spread > 0:
            error[k] = turn[k].T @ (centred @ off[a:b]) / spread
            variance[k] = measured.attitude_sd**2 / spread
    return RateErrors(error, variance)


def moments(problem: Problem, node: Ints, share: Floats) -> Series1:
    """Return when rows were measured, s since the record began."""
    t = problem.line.t
    length = np.append(np.diff(t), 0.0)
    return t[node] + share * length[node] - t[0]


def around(t: Series1, edges: Series1, window: float) -> tuple[Ints, Ints]:
    """Return the first row within a window (s) around each time, and the one behind the last."""
    period = float(np.median(np.diff(t))) if len(t) > 1 else window
    reach = max(window, FEWEST * period)
    return np.searchsorted(t, edges - reach), np.searchsorted(t, edges + reach)


def closure_of(fitted: Fitted, steps: Floats, edges: Series1, total: Series3) -> MomentumClosure:
    """Return what the torque of all causes (n, 3) N m leaves between times ``edges`` (s).

    The motion is that of a fit, off by ``steps`` (K, n) of its unknowns.
    """
    problem, motions = fitted.problem, motions_of(fitted, steps)
    since: Series1 = edges - float(problem.line.t[0])
    gyro = len(problem.observed.rate) > 0
    shown = (by_gyro if gyro else by_camera)(problem, motions, since)
    inertia = inertia_of(fitted, steps[0])
    first: list[int] = np.searchsorted(motions.begins, since - SAME).tolist()
    w = np.array([rate_at_cut(fitted, motions, steps, k) for k in first]) + shown.error
    interval = np.diff(edges)[:, None]
    own = np.array([integral_of(at, inertia) for at in motions.of])
    turned = np.array([own[a:b].sum(axis=0) for a, b in pairwise(first)])
    left = (np.diff(w @ inertia, axis=0) + turned) / interval - total
    both = shown.variance[1:] + shown.variance[:-1]
    sd = np.sqrt(both[:, None] * np.diag(inertia @ inertia)) / interval
    return MomentumClosure(left, sd)


def inertia_of(fitted: Fitted, step: Floats) -> Matrix3:
    """Return the inertia about P after a step, masses as at first; of a body possible or not."""
    problem, first = fitted.problem, unknowns_of(fitted.at.pieces.points[0])
    start = problem.line.known[0, KNOWN_D : KNOWN_D + len(problem.maps.momentum)]
    return inertia_at(problem, first, start) + unpack_symmetric(step[JP])


def rate_at_cut(fitted: Fitted, motions: Motions, steps: Floats, k: int) -> Floats:
    """Return the rate (rad/s) with which stretch k begins, or the last one ends."""
    if k == len(motions.of):
        return motions.of[-1].motion.rate[-1]
    return unknowns_of(fitted.at.pieces.points[k]).w0 + steps[k, RATE]


def integral_of(at: Within, inertia: Matrix3) -> Floats:
    """Return int w x (J w + h) - tau, and what the wheels' momentum h changes by, N m s."""
    w, h, torque = at.motion.rate, at.known[:, :3], at.known[:, 3:6]
    turning = np.cross(w, w @ inertia + h) - torque
    return at.weights @ turning + h[-1] - h[0]
