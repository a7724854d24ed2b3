"""Carrying q and H over a step, for every filter: Runge-Kutta of order 4, and the walks.

Where the attitude is an input, g_B is a straight line between the nodes: the rate does not turn it.
The simplified model has no w x H.

The state has H, not w: H goes on steadily where a mass sets off, and w does not. Parameters are
the same after a step as before, so their block of P is not touched but by the walk, and only the
rows of attitude and rate are computed (``extended``, ``unscented``).
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.propagation import steady, to_unit
from equipoise.dynamics.regressor import WIDTH
from equipoise.dynamics.rigid_body import (
    Body,
    Now,
    between,
    body_at,
    body_within,
    gravity_of,
    motion,
    rate_of,
    times,
)
from equipoise.estimation.filters.model import Model
from equipoise.estimation.tracker.predict_correct import placed
from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats, Six, Triple

COM, INERTIA = 7, 10  # where they stand in a state: q, H, com, J


class Drive(NamedTuple):
    """The grid of steps, and what is known at its nodes."""

    t: Floats  # (g,) s
    known: Floats  # (g, 6 + k) stored momentum, torque, displacements
    q: Floats  # (g, 4) the attitude, where it is an input; where it is measured, at rows
    stopped: Floats  # (g, 3, 3) m^2, what masses that stopped add to the covariance of r


class Work(NamedTuple):
    """Arrays that the steps work in, made once."""

    y: Floats  # (7,) q, H
    at: Floats
    dy: Floats
    total: Floats
    point: Floats  # (16,)
    regress: Floats  # (3, WIDTH)
    Y: Floats  # (3, 6)
    Z: Floats
    F0: Floats  # (6, n)
    F1: Floats
    D: Floats
    A: Floats
    L: Floats  # (n, n)
    E: Floats  # (2n, 6) errors of the points
    Q: Floats  # (2n, 4) their attitudes
    K: Floats  # (n, 3)
    left: Floats  # (n, 3)
    B: Floats  # (n, n)
    S: Floats  # (3, 3)
    inverse: Floats
    x: Floats  # (n,)


@part
def placed_at(model: Model, mean: Floats) -> Body:
    """Return the body with the centre of mass and the inertia of a state."""
    return placed(model.body, mean[COM:])


@part
def gravity_at(model: Model, y: Floats, g0: Triple, g1: Triple, share: float) -> Triple:
    """Return g_B of the state, or of the input at ``share`` of a step."""
    if model.attitude:
        return gravity_of(y, model.body.gravity)
    return (between(g0[0], g1[0], share), between(g0[1], g1[1], share),
            between(g0[2], g1[2], share))  # fmt: skip


@part
def slope(
    model: Model, rigid: Body, now: Now, g: Triple, y: Floats, regress: Floats, dy: Floats
) -> None:
    """Write q' and H'; of the simplified model without w x H."""
    w = rate_of(now, y)
    if not model.gyroscopic:
        w = (0.0, 0.0, 0.0)
    motion(rigid, now, y, w, g, regress, dy)


@part
def stride(
    model: Model, drive: Drive, i: int, rigid: Body, ends: tuple[Now, Now], work: Work
) -> None:
    """Take work.y over step i, between the platforms at its ends."""
    t, h, y, at, dy, total = (drive.t, drive.t[i + 1] - drive.t[i], work.y, work.at, work.dy,
                              work.total)  # fmt: skip
    g0, g1 = (gravity_of(drive.q[i], model.body.gravity),
              gravity_of(drive.q[i + 1], model.body.gravity))  # fmt: skip
    still = steady(drive.known, i)
    middle = body_within(rigid, model.maps, t, drive.known, i, 0.5, still, ends[0])
    for j in range(7):
        at[j] = y[j]
        total[j] = 0.0
    for k in range(4):
        share, weight = 0.5 * ((k + 1) // 2), 1.0 if k in (0, 3) else 2.0
        ahead = h if k == 2 else 0.5 * h
        now = ends[0] if k == 0 else ends[1] if k == 3 else middle
        slope(model, rigid, now, gravity_at(model, at, g0, g1, share), at, work.regress, dy)
        for j in range(7):
            total[j] += weight * dy[j]
            at[j] = y[j] + ahead * dy[j]
    for j in range(7):
        y[j] += h / 6 * total[j]
    to_unit(y)


@part
def ends_of(model: Model, drive: Drive, i: int, rigid: Body) -> tuple[Now, Now]:
    """Return the platform at both ends of step i."""
    here = body_at(rigid, model.maps, drive.t, drive.known, i, 0.0)
    still = steady(drive.known, i)
    return here, body_within(rigid, model.maps, drive.t, drive.known, i, 1.0, still, here)


@part
def add_walks(model: Model, inverse: Six, dt: float, P: Floats) -> None:
    """Add Q dt: torque noise reaches the rate through J."""
    row = 3 if model.attitude else 0
    for k in range(3):
        e = times(inverse, (1.0 * (k == 0), 1.0 * (k == 1), 1.0 * (k == 2)))
        v = times(inverse, e)
        for j in range(3):
            P[row + j, row + k] += model.torque_walk**2 * dt * v[j]
    for j in range(row + 3, min(row + 6, P.shape[0])):
        P[j, j] += model.com_walk**2 * dt


@part
def write_back(model: Model, drive: Drive, i: int, mean: Floats, y: Floats) -> None:
    """Write q and H after step i."""
    for j in range(7):
        mean[j] = y[j]
    if not model.attitude:
        for j in range(4):
            mean[j] = drive.q[i + 1, j]


def work_of(n: int) -> Work:
    """Return room for a filter of n elements."""
    return Work(
        y=np.zeros(7), at=np.zeros(7), dy=np.zeros(7), total=np.zeros(7), point=np.zeros(16),
        regress=np.zeros((3, WIDTH)), Y=np.zeros((3, 6)), Z=np.zeros((3, 6)),
        F0=np.zeros((6, n)), F1=np.zeros((6, n)), D=np.zeros((6, n)), A=np.zeros((6, n)),
        L=np.zeros((n, n)), E=np.zeros((2 * n, 6)), Q=np.zeros((2 * n, 4)), K=np.zeros((n, 3)),
        left=np.zeros((n, 3)), B=np.zeros((n, n)), S=np.zeros((3, 3)), inverse=np.zeros((3, 3)),
        x=np.zeros(n),
    )  # fmt: skip
