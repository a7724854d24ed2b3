"""Tracker: multiplicative extended Kalman filter of attitude, rate, centre of mass and gyro bias.

    error state  x = [ dth, dw, dr, db ]      (body axes; r with the masses at home)
    prediction   the propagator; Phi from its sensitivities to first attitude, rate and moment
    z_q = log( q_pred^-1 (x) q_meas ),  H = [E 0 0 0],  R = sd_q^2 E
    z_w = w_meas - w_pred - b,          H = [0 E 0 E],  R = sd_w^2 E
    q+  = q_pred (x) exp( dth+ )

Ivanov 2021 section 5 with errata I7-I11: the error is the whole rotation vector, so no block
carries a factor 2 or 1/2; the gyroscopic block is J^-1 ([Jw x] - [w x] J); R is the variance of
the angle.
A commanded move enters the prediction with the covariance of where masses stop (fed), or is left
out so that the estimate has to find the new centre of mass by itself (ignored; paper Fig. 13).

The inertia is taken as known: an error of 2 % in it is ten stated sd in r_z. Cannot see r along
gravity until the platform has tilted.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.actuators.stops import travels
from equipoise.dynamics.propagation import Columns, body_of, stacked
from equipoise.dynamics.rigid_body import MOMENT, RATE, TURN
from equipoise.dynamics.timeline import TURN_PER_STEP, Timeline, timeline
from equipoise.estimation.tracker_step import SIZE, run_filter
from equipoise.maths.linalg import pack_symmetric
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
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import seen_at

Moves = Literal["fed", "ignored"]
LONGEST_STEP = 1.0  # s
UNTOLD = 2e-6  # m/sqrt(s), chosen: walk of a centre of mass that may jump without being told
NOTHING = Samples(np.zeros(0), np.zeros((0, 4)))
NO_RATE = Samples(np.zeros(0), np.zeros((0, 3)))


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """What the tracker is told."""

    moves: Moves = "fed"
    com_walk: float = 5e-8  # m/sqrt(s): 0.05 um, thermal drift; chosen within 0.01 to 0.1
    torque_walk: float = 1e-6  # N m sqrt(s): air and bearing torques on a platform of some kg
    bias_walk: float = 1e-7  # rad/s/sqrt(s)
    inertia_P: Matrix3 | None = None  # kg m^2, masses at home; None: the testbed's
    torque: Floats | None = None  # (16,) known coefficients


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """What the tracker believes, at one time."""

    t: float  # s
    q: Quaternion
    rate: Vector3  # rad/s
    com: Vector3  # m, masses at home
    bias: Vector3  # rad/s
    covariance: Square  # (12, 12) of dth, dw, dr, db


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """What was believed after each row, and how surprising the row was."""

    t: Series1  # s
    q: Series4
    rate: Series3  # rad/s
    com: Series3  # m, masses at home; with moves ignored: as they stand
    bias: Series3
    sd: Series  # (n, 12) of dth, dw, dr, db
    surprise: Series1  # squared innovation over its covariance, 3 degrees of freedom
    end: State

    @property
    def com_sd(self) -> Series3:
        """Return the sd of the centre of mass, m."""
        return self.sd[:, 6:9]

    @property
    def rate_sd(self) -> Series3:
        """Return the sd of the rate, rad/s."""
        return self.sd[:, 3:6]


def first_state(
    t: float,
    q: Quaternion,
    testbed: Testbed,
    com: Vector3 | None = None,
    com_covariance: Matrix3 | None = None,
) -> State:
    """Return a belief from one attitude: at rest within 0.1 rad/s, com as known beforehand."""
    covariance = np.zeros((SIZE, SIZE))
    noise = testbed.attitude.noise if testbed.attitude else 0.1
    bias = testbed.gyro.bias_sd if testbed.gyro else 0.0
    spread = [noise**2] * 3 + [0.1**2] * 3 + [0.0] * 3 + [bias**2] * 3
    covariance[np.diag_indices(SIZE)] = spread
    covariance[6:9, 6:9] = np.diag(testbed.com_sd**2) if com_covariance is None else com_covariance
    return State(t, q, np.zeros(3), testbed.body.com if com is None else com, np.zeros(3),
                 covariance)  # fmt: skip


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


def track(recording: Recording, testbed: Testbed, params: Params, state: State) -> Track:
    """Return the beliefs after every row later than the state; call again to go on from its end."""
    attitude, rate = recording.attitude or NOTHING, recording.rate or NO_RATE
    tq, tw = seen_at(attitude.t, testbed.attitude), seen_at(rate.t, testbed.gyro)
    new_q, new_w = tq > state.t, tw > state.t
    masses = recording.masses if params.moves == "fed" else None
    walk = params.com_walk if params.moves == "fed" else max(params.com_walk, UNTOLD)
    fastest = float(np.linalg.norm(state.rate)) + 0.2
    line = timeline(
        np.append(state.t, tq[new_q]), tw[new_w], masses, len(testbed.masses),
        min(LONGEST_STEP, TURN_PER_STEP / fastest), recording.momentum, recording.torque,
    )  # fmt: skip
    inertia = testbed.body.inertia_P if params.inertia_P is None else params.inertia_P
    mass = testbed.body.mass
    body = body_of(mass, testbed.gravity, pack_symmetric(inertia), mass * state.com, params.torque)
    stops, added = stop_covariances(recording if masses else Recording(), testbed, line, state.t)
    noise = np.repeat([0.0, params.torque_walk, walk, params.bias_walk if len(rate) else 0.0], 3)
    n, m = int(new_q.sum()), int(new_w.sum())
    sd_q = testbed.attitude.noise if testbed.attitude else 1.0
    sd_w = testbed.gyro.noise if testbed.gyro else 1.0
    out = np.zeros((n + m, 1 + 4 + 9 + SIZE + 1))
    end = np.concatenate([state.q, state.rate, state.com, state.bias])
    covariance = state.covariance.copy()
    run_filter(
        body, stacked(mass_maps(testbed.masses)), line.t, line.known, line.error_mass,
        filter_columns(), np.ascontiguousarray(attitude.values[new_q]), line.attitude_node[1:],
        sd_q, np.ascontiguousarray(rate.values[new_w]), line.rate_node, sd_w,
        stops, added, noise, end, covariance, out,
    )  # fmt: skip
    last = State(float(line.t[-1]), end[:4], end[4:7], end[7:10], end[10:13], covariance)
    return Track(out[:, 0], out[:, 1:5], out[:, 5:8], out[:, 8:11], out[:, 11:14], out[:, 14:26],
                 out[:, 26], last)  # fmt: skip


def filter_columns() -> Columns:
    """Return the sensitivities that make the transition matrix."""
    return Columns(np.repeat([TURN, RATE, MOMENT], 3), np.tile([0, 1, 2], 3))
