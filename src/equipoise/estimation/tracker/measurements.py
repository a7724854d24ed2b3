"""Rows of a recording as the tracker's walk takes them: sensors, masses, stops of masses."""

from typing import NamedTuple

import numpy as np

from equipoise.actuators.stops import travels
from equipoise.dynamics.rigid_body import KNOWN_WARMTH
from equipoise.dynamics.timeline import TURN_PER_STEP, Timeline, timeline
from equipoise.model.arrays import Floats, Ints, Vector3
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import measured_at

LONGEST_STEP = 1.0  # s
NOTHING = Samples(np.zeros(0), np.zeros((0, 4)))
NO_RATE = Samples(np.zeros(0), np.zeros((0, 3)))


class Rows(NamedTuple):
    """What was measured and known from one moment on."""

    t: Floats  # (n+1,) s
    known: Floats  # (n+1, 7 + k), see ``Timeline``; warmth counts from the first row of all
    owners: Ints
    q: Floats  # (n_q, 4)
    q_node: Ints
    w: Floats  # (n_w, 3) rad/s
    w_node: Ints
    stop_node: Ints
    stop_added: Floats  # (n_s, 3, 3) m^2


def stop_covariances(
    recording: Recording, testbed: Testbed, line: Timeline, after: float
) -> tuple[Ints, Floats]:
    """Return the first nodes after stops of masses, and what that adds to the covariance of r.

    A mass that travels up to the end has not stopped yet: the record that goes on from there
    counts it.
    """
    nodes: list[int] = []
    added: list[Floats] = []
    track, total = recording.masses, testbed.body.mass
    for i, mass in enumerate(testbed.masses if track is not None else ()):
        assert track is not None
        for _, last in travels(track.t, track.values[:, i], mass.speed):
            when = float(track.t[last])
            if after <= when < line.t[-1] and mass.accuracy > 0:
                nodes.append(int(np.searchsorted(line.t, when, side="right")))
                shift: Vector3 = mass.mass * mass.accuracy / total * mass.axis
                added.append(shift[:, None] * shift)
    order = np.argsort(nodes, kind="stable")
    stacked_up = np.array(added).reshape(-1, 3, 3)
    return np.array(nodes, dtype=np.int64)[order], stacked_up[order]


def rows_of(recording: Recording, testbed: Testbed, fed: bool, since: float, speed: float) -> Rows:
    """Return what was measured later than ``since`` (s), of a platform that turns at ``speed``."""
    attitude, rate = recording.attitude or NOTHING, recording.rate or NO_RATE
    tq, tw = measured_at(attitude.t, testbed.attitude), measured_at(rate.t, testbed.gyro)
    new_q, new_w = tq > since, tw > since
    masses = recording.masses if fed else None
    line = timeline(
        np.append(since, tq[new_q]), tw[new_w], masses, len(testbed.masses),
        min(LONGEST_STEP, TURN_PER_STEP / (speed + 0.2)), recording.momentum, recording.torque,
        temperature=recording.temperature,
    )  # fmt: skip
    stops, added = stop_covariances(recording if masses else Recording(), testbed, line, since)
    return Rows(
        line.t, line.known, line.owners,
        np.ascontiguousarray(attitude.values[new_q]), line.attitude_node[1:],
        np.ascontiguousarray(rate.values[new_w]), line.rate_node, stops, added,
    )  # fmt: skip


def followed_by(a: Rows, b: Rows) -> Rows:
    """Return rows and those that begin where they end."""
    n, known = len(a.t) - 1, b.known.copy()
    known[:, KNOWN_WARMTH] += a.known[-1, KNOWN_WARMTH]
    return Rows(
        np.append(a.t, b.t[1:]), np.vstack([a.known[:-1], known]), a.owners,
        np.vstack([a.q, b.q]), np.append(a.q_node, b.q_node + n),
        np.vstack([a.w, b.w]), np.append(a.w_node, b.w_node + n),
        np.append(a.stop_node, b.stop_node + n), np.concatenate([a.stop_added, b.stop_added]),
    )  # fmt: skip


def later(rows: Rows, node: int) -> Rows:
    """Return the rows behind a node."""
    q, w, stop = rows.q_node > node, rows.w_node > node, rows.stop_node > node
    return Rows(
        rows.t[node:], rows.known[node:], rows.owners, rows.q[q], rows.q_node[q] - node,
        rows.w[w], rows.w_node[w] - node, rows.stop_node[stop] - node, rows.stop_added[stop],
    )  # fmt: skip
