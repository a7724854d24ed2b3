"""The filter ``ekf_9`` row by row: a grid of two nodes, which each row moves on.

    node 0 -> node 1    the step that a row ends; longer ones are cut as ``dynamics.timeline`` does

Time is counted from node 0, so that single precision knows a step after hours as well as at first.

``follow``, ``arrive`` and all below them are the filter's own kernels. The first row, and one
behind a gap, restarts attitude and rate. A mass that has travelled and stands adds where it stopped
to the covariance of r. Masses are known at rows; between two of them they travel evenly.
"""

import math
from typing import NamedTuple

import numpy as np

from equipoise.actuators.stops import STILL
from equipoise.dynamics.rigid_body import KNOWN_D, between
from equipoise.estimation.filters.driver import begin
from equipoise.estimation.filters.model import Kind, Model
from equipoise.estimation.filters.predict import COM, Drive, Work, work_of
from equipoise.estimation.filters.rows import LONGEST, Rows
from equipoise.estimation.filters.walk import NOTED, arrive, follow
from equipoise.estimation.motion.fused_motion import GAP, SHORTEST
from equipoise.estimation.motion.sensor_noise import camera_noise
from equipoise.model.arrays import Bools, Floats, Ints
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed
from equipoise.onboard.program.request import Request

KIND = Kind(attitude=True, estimated=9)
EDGE = 1 + 1e-5  # chosen: so that a way of whole motor steps is never just at the limit
ROUNDING = 1e-9  # of a step, as ``timeline.fill`` has it


class Masses(NamedTuple):
    """The masses as the filter takes them, one row each."""

    slowest: Floats  # (k,) m/s, above which a mass travels
    stop: Floats  # (k, 3) m, one sd of r by where a mass stops


class Filter(NamedTuple):
    """What does not change."""

    model: Model
    masses: Masses
    gap: float  # s, behind which attitude and rate are not known


class Memory(NamedTuple):
    """What changes with every row."""

    rows: Rows  # two nodes and one row
    mean: Floats  # (16,) q, H (N m s), com (m), J (kg m^2)
    covariance: Floats  # (n, n)
    work: Work
    noted: Floats  # (1, 20) t; com, J; their sd; surprise
    travelling: Bools  # (k,)
    row_count: Ints  # (1,) rows so far


def put_node(drive: Drive, node: int, q: Floats) -> None:
    """Write the attitude of a node, with nothing stopped there."""
    for j in range(4):
        drive.q[node, j] = q[j]
    for j in range(3):
        for k in range(3):
            drive.stopped[node, j, k] = 0.0


def put_masses(drive: Drive, node: int, d: Floats) -> None:
    """Write where the masses are at a node, m."""
    for k in range(d.shape[0]):
        drive.known[node, KNOWN_D + k] = d[k]


def go_on(drive: Drive) -> None:
    """Make the last node the first."""
    for j in range(4):
        drive.q[0, j] = drive.q[1, j]
    for j in range(drive.known.shape[1]):
        drive.known[0, j] = drive.known[1, j]


def put_stops(masses: Masses, memory: Memory, dt: float, d: Floats) -> None:
    """Write what masses that have stopped before this step add to the covariance of r."""
    drive = memory.rows.drive
    for k in range(d.shape[0]):
        moves = abs(d[k] - drive.known[0, KNOWN_D + k]) > masses.slowest[k] * dt
        if memory.travelling[k] and not moves:
            for i in range(3):
                for j in range(3):
                    drive.stopped[1, i, j] += masses.stop[k, i] * masses.stop[k, j]
        memory.travelling[k] = moves


def follow_step(own: Filter, memory: Memory, dt: float, q: Floats, d: Floats) -> None:
    """Take the estimate to a row, by as many steps as there have to be, and correct it."""
    drive, parts = memory.rows.drive, 1
    go_on(drive)
    put_node(drive, 1, q)
    put_stops(own.masses, memory, dt, d)
    memory.rows.fresh[0] = dt > own.gap
    if dt <= own.gap:
        parts = max(math.ceil(dt / LONGEST - ROUNDING), 1)
    drive.t[1] = dt / parts
    for k in range(1, parts):
        share = 1.0 / (parts - k + 1)
        for i in range(d.shape[0]):
            at = KNOWN_D + i
            drive.known[1, at] = between(drive.known[0, at], d[i], share)
        arrive(own.model, drive, 0, 1, memory.mean, memory.covariance, memory.work)
        go_on(drive)
        put_node(drive, 1, q)
    put_masses(drive, 1, d)
    memory.rows.node[0] = 1
    follow(own.model, memory.rows, memory.mean, memory.covariance, memory.work, memory.noted)


def take_row(own: Filter, memory: Memory, dt: float, q: Floats, rate: Floats, d: Floats) -> None:
    """Take the attitude (w x y z) dt s after the last, masses at d m; the rate is not used."""
    drive = memory.rows.drive
    if memory.row_count[0] == 0:
        for node in range(2):
            put_node(drive, node, q)
            put_masses(drive, node, d)
        memory.rows.fresh[0], memory.rows.node[0] = True, 0
        follow(own.model, memory.rows, memory.mean, memory.covariance, memory.work, memory.noted)
    else:
        follow_step(own, memory, dt, q, d)
    memory.row_count[0] = min(memory.row_count[0] + 1, COUNTED)


def put_estimate(memory: Memory, q: Floats, out: Request) -> None:
    """Write attitude, centre of mass (masses at home) and its sd, as the filter has them."""
    for j in range(4):
        out.attitude[j] = memory.mean[j]
    for j in range(3):
        out.com[j] = memory.mean[COM + j]
        out.com_sd[j] = memory.covariance[6 + j, 6 + j] ** 0.5


COUNTED = 30000  # rows, chosen: an int of two bytes does not run over


def filter_of(testbed: Testbed) -> tuple[Filter, Memory]:
    """Return the filter of a testbed before its first row; InputError without a camera."""
    camera = testbed.attitude
    if camera is None or camera.rate <= 0:
        raise InputError("method ekf_9", "a testbed without an attitude sensor and its rate",
                         "[attitude_sensor] with rate_Hz")  # fmt: skip
    state = begin(KIND, testbed, camera_noise(testbed))
    k, n = len(testbed.masses), len(state.covariance)
    drive = Drive(
        np.zeros(2), np.zeros((2, KNOWN_D + k)), np.zeros((2, 4)), np.zeros((2, 3, 3))
    )  # fmt: skip
    rows = Rows(drive, np.zeros(1, np.int64), np.zeros(1, np.bool_), np.zeros((1, 3)))
    total = testbed.body.mass
    stop = [m.mass * m.accuracy / total * m.axis for m in testbed.masses]
    speed = np.array([mass.speed for mass in testbed.masses])
    own = Filter(
        state.model, Masses(EDGE * STILL * speed, np.array(stop).reshape(-1, 3)),
        max(GAP / camera.rate, SHORTEST),
    )  # fmt: skip
    memory = Memory(
        rows, state.mean, state.covariance, work_of(n), np.zeros((1, NOTED)),
        np.zeros(k, np.bool_), np.zeros(1, np.int64),
    )  # fmt: skip
    return own, memory
