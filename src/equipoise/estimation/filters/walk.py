"""Along the rows: predict over every step to a row, correct by it; a new piece restarts.

Behind a gap attitude and rate are not known: their covariance is what it was before the first row,
their correlation with the parameters nought; the parameters stay, and have walked. The first row of
a piece says what the attitude is, or corrects a rate of 0 +- 0.1 rad/s.
"""

import numpy as np

from equipoise.dynamics.rigid_body import Now, body_at
from equipoise.estimation.filters.correct import correct
from equipoise.estimation.filters.extended import extended
from equipoise.estimation.filters.model import FIRST_RATE, Model
from equipoise.estimation.filters.predict import COM, Drive, Work, placed_at
from equipoise.estimation.filters.rows import Rows
from equipoise.estimation.filters.unscented import unscented
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.model.arrays import Floats

NOTED = 1 + 9 + 9 + 1  # t; com, J; sd of c and J; surprise


@part
def standing(model: Model, drive: Drive, node: int, mean: Floats, t: Floats, known: Floats) -> Now:
    """Return the platform at a node as if nothing changed there; t and known are room for that."""
    for j in range(known.shape[1]):
        known[0, j] = known[1, j] = drive.known[node, j]
    return body_at(placed_at(model, mean), model.maps, t, known, 0, 0.0)


@part
def restart(model: Model, now: Now, q: Floats, mean: Floats, P: Floats) -> None:
    """Forget attitude and rate; the measured attitude is all that is known of it."""
    n, rows = P.shape[0], 6 if model.attitude else 3
    for i in range(rows):
        for j in range(n):
            P[i, j] = P[j, i] = 0.0
    for k in range(3):
        P[rows - 3 + k, rows - 3 + k] = FIRST_RATE**2
        if model.attitude:
            P[k, k] = model.noise
        mean[4 + k] = now.momentum[k]
    for j in range(4):
        mean[j] = q[j]


@part
def add_stops(model: Model, stopped: Floats, P: Floats) -> None:
    """Add the covariance (m^2) of where masses stopped to that of c = axes^T r."""
    if stopped[0, 0] + stopped[1, 1] + stopped[2, 2] == 0.0:
        return
    row, B = 6 if model.attitude else 3, model.axes
    size = min(3, P.shape[0] - row)
    for a in range(size):
        for b in range(size):
            for i in range(3):
                for j in range(3):
                    P[row + a, row + b] += B[i, a] * stopped[i, j] * B[j, b]


@part
def add_drift(model: Model, dt: float, P: Floats) -> None:
    """Add the walk of the centre of mass over a gap."""
    row = 6 if model.attitude else 3
    for j in range(row, min(row + 3, P.shape[0])):
        P[j, j] += model.com_walk**2 * dt


@part
def note(model: Model, t: float, mean: Floats, P: Floats, surprise: float, out: Floats) -> None:
    """Write a row: t; com, J; the sd of c and J; surprise."""
    row, n = 6 if model.attitude else 3, P.shape[0]
    out[0], out[NOTED - 1] = t, surprise
    for j in range(9):
        at = row + j
        out[1 + j] = mean[COM + j]
        out[10 + j] = P[at, at] ** 0.5 if at < n else 0.0


@part
def arrive(
    model: Model, drive: Drive, first: int, last: int, mean: Floats, P: Floats, work: Work
) -> None:
    """Carry the estimate from one node to another."""
    for i in range(first, last):
        if model.unscented:
            unscented(model, drive, i, mean, P, work)
        else:
            extended(model, drive, i, mean, P, work)
        add_stops(model, drive.stopped[i + 1], P)


@kernel
def follow(model: Model, rows: Rows, mean: Floats, P: Floats, work: Work, out: Floats) -> None:
    """Take mean and covariance along rows, in place; write the estimate after each."""
    drive, node, fresh, observed = rows
    t, known, here = np.array([0.0, 1.0]), np.zeros((2, drive.known.shape[1])), 0
    for r in range(node.shape[0]):
        last, surprise = int(node[r]), np.nan
        if fresh[r]:
            add_drift(model, drive.t[last] - drive.t[here], P)
            for i in range(here + 1, last + 1):
                add_stops(model, drive.stopped[i], P)
            now = standing(model, drive, last, mean, t, known)
            restart(model, now, drive.q[last], mean, P)
            if not model.attitude:
                correct(model, now, drive.q[last], observed[r], mean, P, work)
        else:
            arrive(model, drive, here, last, mean, P, work)
            now = body_at(placed_at(model, mean), model.maps, drive.t, drive.known, last - 1, 1.0)
            surprise = correct(model, now, drive.q[last], observed[r], mean, P, work)
        note(model, drive.t[last], mean, P, surprise, out[r])
        here = last
