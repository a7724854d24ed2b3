"""Rows of a recording as the filters take them: a grid of steps, and which nodes carry rows.

Known inputs are straight lines within a step, so every corner of them is a node. A gyro's filter
is given the attitude at every node (``led_motion``), a camera's what it measured at its rows. A new
piece begins behind a gap; nothing is carried over one.

``taken`` cuts rows for a filter that runs as they come: the grid of a cut begins with the node of
the row before it. ``led_motion`` takes a whole record, rows to come included; a bench that runs
a gyro's filter live fills ``Rows`` with the attitude it has.

What is off in the attitude goes into com: a camera that leans by e turns com along gravity by e.
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.timeline import Timeline, timeline
from equipoise.estimation.filters.predict import Drive
from equipoise.estimation.motion.fused_motion import LedMotion, at_times, led_motion, pieces_of
from equipoise.estimation.tracker.measurements import LONGEST_STEP, stop_covariances
from equipoise.maths.attitude import continuous
from equipoise.model.arrays import Bools, Floats, Ints, Series1, Series3, Series4
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import measured_at

LONGEST = 0.25 * LONGEST_STEP  # s, chosen: Phi is good to (w dt)^3 / 6, 1e-3 at 45 deg/s


class Rows(NamedTuple):
    """What was measured and known."""

    drive: Drive
    node: Ints  # (n,) of each row
    fresh: Bools  # (n,) a piece begins here
    observed: Series3  # (n, 3) rad/s, of a gyro


def grid_of(recording: Recording, testbed: Testbed, t: Series1) -> Timeline:
    """Return the steps that lead through rows at times t (s)."""
    return timeline(
        np.zeros(0), t, recording.masses, len(testbed.masses), LONGEST, recording.momentum,
        recording.torque,
    )  # fmt: skip


def assembled(
    recording: Recording, testbed: Testbed, motion: LedMotion, moving: bool
) -> Rows:  # fmt: skip
    """Return the rows of all pieces; ``moving``: nodes between rows have attitudes of their own."""
    lines, nodes, attitudes, first = list[Timeline](), list[Ints](), list[Series4](), 0
    for k in range(int(motion.piece[-1]) + 1):
        t, q = motion.t[motion.piece == k], continuous(motion.q[motion.piece == k])
        line = grid_of(recording, testbed, t)
        at = at_times(t, q, line.t) if moving and len(t) > 1 else q[placed(line.t, t)]
        at[line.rate_node] = q
        lines.append(line)
        nodes.append(line.rate_node + first)
        attitudes.append(at)
        first += len(line.t)
    whole = lines[0]._replace(t=np.concatenate([line.t for line in lines]))
    drive = Drive(whole.t, np.vstack([line.known for line in lines]), np.vstack(attitudes),
                  stops_at(recording, testbed, whole))  # fmt: skip
    fresh = np.append(True, np.diff(motion.piece) > 0)
    return Rows(drive, np.concatenate(nodes), fresh, np.ascontiguousarray(motion.w))


def placed(grid: Series1, t: Series1) -> Ints:
    """Return the row at or before each node."""
    return np.searchsorted(t, grid, side="right") - 1


def stops_at(recording: Recording, testbed: Testbed, line: Timeline) -> Floats:
    """Return what masses that stopped add to the covariance of r at each node, m^2."""
    out = np.zeros((len(line.t), 3, 3))
    nodes, added = stop_covariances(recording, testbed, line, float(line.t[0]))
    np.add.at(out, nodes, added)
    return out


def gyro_rows(recording: Recording, testbed: Testbed) -> tuple[Rows, int] | None:
    """Return the rows of a gyro and how many of its own each is the mean of; None: too few."""
    motion, rate = led_motion(recording, testbed), recording.rate
    if rate is None or len(motion.t) < 2:
        return None
    share = round(float(np.median(np.diff(motion.t))) / rate.period)
    return assembled(recording, testbed, motion, True), max(share, 1)


def camera_rows(recording: Recording, testbed: Testbed) -> Rows | None:
    """Return the rows of a camera; None: too few."""
    attitude = recording.attitude
    if attitude is None or len(attitude) < 2:
        return None
    t = measured_at(attitude.t, testbed.attitude)
    w = np.zeros((len(t), 3))
    motion = LedMotion(t, attitude.values, w, pieces_of(t))
    return assembled(recording, testbed, motion, False)


def taken(rows: Rows, first: int, end: int) -> Rows:
    """Return the rows from ``first`` up to and without ``end``, for a filter that goes on there."""
    start = int(rows.node[max(first - 1, 0)])
    nodes = slice(start, int(rows.node[end - 1]) + 1)
    part = slice(first, end)
    drive = Drive(*(values[nodes] for values in rows.drive))
    return Rows(drive, rows.node[part] - start, rows.fresh[part], rows.observed[part])
