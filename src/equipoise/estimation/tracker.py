"""Tracker: multiplicative extended Kalman filter of attitude, rate, mass properties and gyro bias.

    error state  x = [ dth, dw, dr, dJ, db ]      (body axes; r and J with the masses at home)
    prediction   the propagator; Phi from its sensitivities to first attitude, rate, moment, J
    z_q = log( q_pred^-1 (x) q_meas ),  H = [E 0 0 0 0],  R = sd_q^2 E
    z_w = w_meas - w_pred - b,          H = [0 E 0 0 E],  R = sd_w^2 E
    q+  = q_pred (x) exp( dth+ )

Ivanov 2021 section 5 with errata I7-I11: the error is the whole rotation vector, so no block
carries a factor 2 or 1/2; the gyroscopic block is J^-1 ([Jw x] - [w x] J); R is the variance of
the angle.
A commanded move enters the prediction with the covariance of where masses stop (fed), or is left
out so that the estimate has to find the new centre of mass by itself (ignored; paper Fig. 13).

The inertia is part of the state with its own sd, since an error of 2 % in it would be ten stated
sd in r_z: as the swing shows J and r only by their ratio, r is never told better than J until a
known move separates them. An sd of 0 takes the inertia as known.

Cannot see r along gravity until the platform has tilted. Linearises about its belief, which is too
coarse from an inertia wrong by more than some 3 %: for a whole record see ``track_again``.
"""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.actuators.stops import travels
from equipoise.dynamics import sensitivities
from equipoise.dynamics.propagation import Columns, body_of, stacked
from equipoise.dynamics.timeline import TURN_PER_STEP, Timeline, timeline
from equipoise.estimation.tracker_step import BODY, COM, SIZE, Rows, run_filter
from equipoise.maths.linalg import element_sizes, pack_symmetric, unpack_symmetric
from equipoise.model.arrays import (
    Floats,
    Ints,
    Matrix3,
    Quaternion,
    Series,
    Series1,
    Series3,
    Series4,
    Square,
    Vector3,
)
from equipoise.model.estimate import INERTIA, Estimate
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import seen_at

Moves = Literal["fed", "ignored"]
LONGEST_STEP = 1.0  # s
WINDOW, LOOK, GROWTH, PASSES, DOUBT = 60.0, 4.0, 1.3, 4, 0.015
UNTOLD = 2e-6  # m/sqrt(s), chosen: walk of a centre of mass that may jump without being told
WHERE = np.cumsum([4, 3, 3, 6, 3])  # where the parts of a belief written as one array end
NOTHING = Samples(np.zeros(0), np.zeros((0, 4)))
NO_RATE = Samples(np.zeros(0), np.zeros((0, 3)))


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """What the tracker is told."""

    moves: Moves = "fed"
    com_walk: float = 5e-8  # m/sqrt(s): 0.05 um, thermal drift; chosen within 0.01 to 0.1
    torque_walk: float = 1e-6  # N m sqrt(s): air and bearing torques on a platform of some kg
    bias_walk: float = 1e-7  # rad/s/sqrt(s)
    torque: Floats | None = None  # (16,) known coefficients


@dataclass(frozen=True, slots=True, eq=False)
class Belief:
    """Mass properties with the masses at home, and how well they are known."""

    com: Vector3  # m
    inertia_P: Matrix3  # kg m^2
    covariance: Square  # (9, 9) of com and of J as xx yy zz xy xz yz


@dataclass(frozen=True, slots=True, eq=False)
class Kept:
    """Rows."""

    rows: Rows
    belief: Floats
    covariance: Square
    point: Floats
    replayed: float
    doubtful: bool


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """What the tracker believes, at one time."""

    t: float  # s
    q: Quaternion
    rate: Vector3  # rad/s
    com: Vector3  # m, masses at home
    inertia_P: Matrix3  # kg m^2, masses at home
    bias: Vector3  # rad/s
    covariance: Square  # (18, 18) of dth, dw, dr, dJ, db
    kept: "Kept | None" = None

    @property
    def belief(self) -> Belief:
        """Return what is believed of the body."""
        return Belief(self.com, self.inertia_P, self.covariance[BODY, BODY])


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """What was believed after each row, and how surprising the row was."""

    t: Series1  # s
    q: Series4
    rate: Series3  # rad/s
    com: Series3  # m, masses at home; with moves ignored: as they stand
    inertia: Series  # (n, 6) kg m^2, xx yy zz xy xz yz
    bias: Series3
    sd: Series  # (n, 18) of dth, dw, dr, dJ, db
    surprise: Series1  # squared innovation over its covariance, 3 degrees of freedom
    end: State

    @property
    def com_sd(self) -> Series3:
        """Return the sd of the centre of mass, m."""
        return self.sd[:, COM]

    @property
    def rate_sd(self) -> Series3:
        """Return the sd of the rate, rad/s."""
        return self.sd[:, 3:6]


def belief_of(testbed: Testbed, estimate: Estimate | None = None) -> Belief:
    """Return what the testbed says, with the inertia of an estimate if that saw it."""
    inertia_sd = testbed.inertia_sd * element_sizes(testbed.body.inertia_P)
    variance = np.concatenate([testbed.com_sd, inertia_sd]) ** 2
    covariance, inertia_P = np.diag(variance), testbed.body.inertia_P
    if estimate is not None and estimate.sees(INERTIA):
        covariance[3:, 3:], inertia_P = estimate.covariance_of(INERTIA), estimate.inertia_P
    return Belief(testbed.body.com, inertia_P, covariance)


def first_state(t: float, q: Quaternion, testbed: Testbed, belief: Belief | None = None) -> State:
    """Return a state from one attitude: at rest within 0.1 rad/s, the body as known beforehand."""
    belief = belief or belief_of(testbed)
    covariance = np.zeros((SIZE, SIZE))
    noise = testbed.attitude.noise if testbed.attitude else 0.1
    bias = testbed.gyro.bias_sd if testbed.gyro else 0.0
    spread = [noise**2] * 3 + [0.1**2] * 3 + [0.0] * 9 + [bias**2] * 3
    covariance[np.diag_indices(SIZE)] = spread
    covariance[BODY, BODY] = belief.covariance
    return State(t, q, np.zeros(3), belief.com, belief.inertia_P, np.zeros(3), covariance)


def stop_covariances(
    recording: Recording, testbed: Testbed, line: Timeline, after: float
) -> tuple[Ints, Floats]:
    """Return the nodes at which masses stopped, and what that adds to the covariance of r.

    A mass that travels up to the end has not stopped yet: the record that goes on counts it.
    """
    nodes: list[int] = []
    added: list[Floats] = []
    track, total = recording.masses, testbed.body.mass
    for i, mass in enumerate(testbed.masses if track is not None else ()):
        assert track is not None
        for _, last in travels(track.t, track.values[:, i], mass.speed):
            when = float(track.t[last])
            if after < when < line.t[-1] and mass.accuracy > 0:
                nodes.append(min(int(np.searchsorted(line.t, when)), len(line.t) - 1))
                shift: Vector3 = mass.mass * mass.accuracy / total * mass.axis
                added.append(shift[:, None] * shift)
    order = np.argsort(nodes, kind="stable")
    stacked_up = np.array(added).reshape(-1, 3, 3)
    return np.array(nodes, dtype=np.int64)[order], stacked_up[order]


def rows_of(recording: Recording, testbed: Testbed, params: Params, state: State) -> Rows:
    """Return what was seen later than the state."""
    attitude, rate = recording.attitude or NOTHING, recording.rate or NO_RATE
    tq, tw = seen_at(attitude.t, testbed.attitude), seen_at(rate.t, testbed.gyro)
    new_q, new_w = tq > state.t, tw > state.t
    masses = recording.masses if params.moves == "fed" else None
    fastest = float(np.linalg.norm(state.rate)) + 0.2
    line = timeline(
        np.append(state.t, tq[new_q]), tw[new_w], masses, len(testbed.masses),
        min(LONGEST_STEP, TURN_PER_STEP / fastest), recording.momentum, recording.torque,
    )  # fmt: skip
    stops, added = stop_covariances(recording if masses else Recording(), testbed, line, state.t)
    return Rows(
        line.t, line.known, line.error_mass,
        np.ascontiguousarray(attitude.values[new_q]), line.attitude_node[1:],
        np.ascontiguousarray(rate.values[new_w]), line.rate_node, stops, added,
    )  # fmt: skip


def appended(a: Rows, b: Rows) -> Rows:
    """Return rows that go on where others end."""
    n = len(a.t) - 1
    return Rows(
        np.append(a.t, b.t[1:]), np.vstack([a.known[:-1], b.known]), a.owners,
        np.vstack([a.q, b.q]), np.append(a.q_node, b.q_node + n),
        np.vstack([a.w, b.w]), np.append(a.w_node, b.w_node + n),
        np.append(a.stop_node, b.stop_node + n), np.vstack([a.stop_added, b.stop_added]),
    )  # fmt: skip


def after(rows: Rows, node: int) -> Rows:
    """Return the rows from a node on."""
    q, w, s = rows.q_node > node, rows.w_node > node, rows.stop_node > node
    return Rows(
        rows.t[node:], rows.known[node:], rows.owners, rows.q[q], rows.q_node[q] - node,
        rows.w[w], rows.w_node[w] - node, rows.stop_node[s] - node, rows.stop_added[s],
    )  # fmt: skip


def doubtful(point: Floats, P: Floats) -> bool:
    """Say whether the inertia is too doubtful to linearise about one belief."""
    moments = point[3:6]
    size = np.sqrt(moments[[0, 1, 2, 0, 0, 1]] * moments[[0, 1, 2, 1, 2, 2]])
    return bool(np.any(np.sqrt(np.diag(P)[9:15]) > DOUBT * size))


def nearer(point: Floats, belief: Floats) -> Floats:
    """Return the belief, or a point on the way to it where the inertia stays possible."""
    share = 1.0
    root = np.linalg.cholesky(unpack_symmetric(point[3:]))
    inverse = np.linalg.inv(root)
    while True:
        new = point + share * (belief - point)
        least = np.linalg.eigvalsh(inverse @ unpack_symmetric(new[3:]) @ inverse.T)[0]
        if least > 0.5:
            return new
        share /= 2


def track(recording: Recording, testbed: Testbed, params: Params, state: State) -> Track:
    """Return the beliefs after every row later than the state; call again to go on from its end."""
    fresh = rows_of(recording, testbed, params, state)
    belief = np.concatenate([state.q, state.rate, state.com, pack_symmetric(state.inertia_P), state.bias])
    P = state.covariance.copy()
    kept = state.kept or Kept(fresh, belief.copy(), P.copy(), belief[7:16].copy(), 0.0, doubtful(belief[7:16], P))
    rows = appended(kept.rows, fresh) if state.kept else fresh
    here = len(rows.t) - len(fresh.t)
    walk = params.com_walk if params.moves == "fed" else max(params.com_walk, UNTOLD)
    bias_walk = params.bias_walk if len(rows.w) else 0.0
    walks = np.repeat([0.0, params.torque_walk, walk, 0.0, 0.0, bias_walk], 3)
    sd_q = testbed.attitude.noise if testbed.attitude else 1.0
    sd_w = testbed.gyro.noise if testbed.gyro else 1.0
    body = body_of(testbed.body.mass, testbed.gravity, belief[10:16], belief[7:10], params.torque)
    maps = stacked(mass_maps(testbed.masses))
    n = len(fresh.q) + len(fresh.w)
    out = np.zeros((n, 1 + len(belief) + SIZE + 1))
    anchor, anchor_P, point, replayed, open_ = kept.belief, kept.covariance, kept.point.copy(), kept.replayed, kept.doubtful
    done = 0
    def run(rows, a, b, look, quiet, belief, P):
        return run_filter(body, maps, rows, filter_columns(), sd_q, sd_w, walks, a, b, look, not open_, quiet, point, belief, P, out[done:])
    def count(rows, a, b):
        return int(np.sum((rows.q_node > a) & (rows.q_node <= b)) + np.sum((rows.w_node > a) & (rows.w_node <= b)))
    while here < len(rows.t) - 1:
        edge = int(np.searchsorted(rows.t, rows.t[0] + WINDOW)) if open_ else len(rows.t) - 1
        edge = max(min(edge, len(rows.t) - 1), here + 1)
        look = int(np.searchsorted(rows.t, rows.t[0] + max(LOOK, GROWTH * replayed)))
        before = here
        here = run(rows, here, edge, look, False, belief, P)
        done += count(rows, before, here)
        age = rows.t[here] - rows.t[0]
        if open_ and here >= look:
            for _ in range(PASSES):
                point[:] = nearer(point, belief[7:16])
                belief, P = anchor.copy(), anchor_P.copy()
                if run(rows, 0, here, 0 if False else here, True, belief, P) == here and not far(point, belief): break
            replayed = age
        if age >= WINDOW - 1e-9 and open_:
            moveto(point, belief, P)
            anchor, anchor_P = belief.copy(), P.copy()
            open_ = doubtful(point, P)
            rows, here, replayed = after(rows, here), 0, 0.0
    at = np.split(out, [1, *(1 + WHERE), out.shape[1] - 1], axis=1)
    t, q, w, com, J, b, sd, surprise = at
    q_end, w_end, com_end, J_end, b_end = np.split(belief, WHERE[:-1])
    keep = Kept(rows if open_ else after(rows, here), anchor, anchor_P, point, replayed, open_)
    last = State(float(rows.t[-1]), q_end, w_end, com_end, unpack_symmetric(J_end), b_end, P, keep)
    return Track(t[:, 0], q, w, com, J, b, sd, surprise[:, 0], last)


def far(point, belief):
    size = np.sqrt(point[3:6][[0, 1, 2, 0, 0, 1]] * point[3:6][[0, 1, 2, 1, 2, 2]])
    off = belief[7:16] - point
    return bool(np.any(np.abs(off[3:]) > 0.25 * 0.02 * size) or np.linalg.norm(off[:3]) > 0.25 * 0.05 * np.linalg.norm(point[:3]))


def moveto(point, belief, P):
    new = belief[7:16]
    l = np.zeros(9); l[3:6] = 1 / point[3:6].sum()
    c = new[3:6].sum() / point[3:6].sum()
    T = c * np.eye(9) + np.outer(new - c * point, l)
    P[6:15] = T @ P[6:15]
    P[:, 6:15] = P[:, 6:15] @ T.T
    point[:] = new


def track_again(recording: Recording, testbed: Testbed, params: Params, state: State) -> Track:
    """Return the track of a second pass, from the mass properties that a first one ended with.

    Only the point of linearisation is new: the covariance to begin with is the same prior's, so the
    record counts once. (The prior's values are given up for it: this is for priors much wider than
    what the record tells.)
    """
    end = track(recording, testbed, params, state).end
    again = replace(state, com=end.com, inertia_P=end.inertia_P)
    return track(recording, testbed, params, again)


def filter_columns() -> Columns:
    """Return the sensitivities that make the transition matrix."""
    kinds = [sensitivities.TURN, sensitivities.RATE, sensitivities.MOMENT]
    return Columns(
        np.array([*np.repeat(kinds, 3), *[sensitivities.INERTIA] * 6], dtype=np.int64),
        np.array([*np.tile([0, 1, 2], 3), *range(6)], dtype=np.int64),
    )
