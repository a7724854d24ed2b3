"""What a contact or a step of the centre of mass would have done to the innovations, compiled.

Willsky and Jones (1976), generalised likelihood ratio: had the rate jumped by v (or r stepped by
v) after some row, truth and filter would differ by X v from then on,

    X = [0 E 0 0 0]^T or [0 0 E 0 0]^T,    X <- Phi X (prediction),    X <- X - K H X (correction)

and innovations by G = H X. Sums over the rows determine the size (``contact_test``):

    C = sum G^T S^-1 G,   d = sum G^T S^-1 z

Onsets are kept at a dozen ages, dense where they are young, up to 50 rows. Each with a jump and a
step is a hypothesis.
"""

from typing import NamedTuple

import numpy as np

from equipoise.estimation.tracker.predict_correct import SIZE, Work, ahead
from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats, Ints, Triple

ONSETS = 12
MANY = 2 * ONSETS  # hypotheses: jumps of the rate, then steps of r
COLUMNS = 3 * MANY  # of X: hypotheses along x, along y, along z
OLDEST = 50  # rows
COUNT, GATED, WAITED, SUSPECT = 0, 1, 2, 3  # in Watch.counts


class Watch(NamedTuple):
    """What the test remembers."""

    X: Floats  # (18, 72)
    C: Floats  # (6, 24) xx yy zz xy xz yz
    d: Floats  # (3, 24)
    age: Ints  # (12,) rows
    since: Floats  # (12,) s
    order: Ints  # (12,) onsets, oldest first
    counts: Ints  # (4,) onsets in use, gated rows in a run, rows waited, if one is suspected


class Room(NamedTuple):
    """Arrays that the test works in."""

    after: Floats  # (6, 72)
    G: Floats  # (3, 72)
    weighed: Floats  # (3, 72) S^-1 G
    V: Floats  # (6, 24)
    v: Floats  # (3, 24)
    gain: Floats  # (24,) l
    p: Floats  # (24,) probability
    one: Floats  # (18,)
    other: Floats  # (18,)


def new_watch() -> Watch:
    """Return a test that has no rows yet."""
    return Watch(
        np.zeros((SIZE, COLUMNS)), np.zeros((6, MANY)), np.zeros((3, MANY)),
        np.zeros(ONSETS, np.int64), np.zeros(ONSETS), np.zeros(ONSETS, np.int64),
        np.zeros(4, np.int64),
    )  # fmt: skip


@part
def forget(watch: Watch) -> None:
    """Begin anew."""
    watch.counts[:] = 0
    watch.X[:] = 0.0


@part
def follow(watch: Watch, phi: Floats, room: Room) -> None:
    """Write X <- Phi X."""
    X, after = watch.X, room.after
    for r in range(6):
        for c in range(COLUMNS):
            after[r, c] = ahead(phi, r, X, c)
    for r in range(6):
        for c in range(COLUMNS):
            X[r, c] = after[r, c]


@part
def response(watch: Watch, first: int, second: int, room: Room) -> None:
    """Write G = H X."""
    X, G = watch.X, room.G
    for r in range(3):
        for c in range(COLUMNS):
            G[r, c] = X[first + r, c]
        if second >= 0:
            for c in range(COLUMNS):
                G[r, c] += X[second + r, c]


@part
def gather(watch: Watch, z: Triple, work: Work, room: Room) -> None:
    """Add a row to C and d."""
    G, F, inverse, C, d = room.G, room.weighed, work.inverse, watch.C, watch.d
    for r in range(3):
        for c in range(COLUMNS):
            F[r, c] = inverse[r, 0] * G[0, c] + inverse[r, 1] * G[1, c] + inverse[r, 2] * G[2, c]
    for h in range(MANY):
        i, j, k = h, MANY + h, 2 * MANY + h
        C[0, h] += G[0, i] * F[0, i] + G[1, i] * F[1, i] + G[2, i] * F[2, i]
        C[1, h] += G[0, j] * F[0, j] + G[1, j] * F[1, j] + G[2, j] * F[2, j]
        C[2, h] += G[0, k] * F[0, k] + G[1, k] * F[1, k] + G[2, k] * F[2, k]
        C[3, h] += G[0, i] * F[0, j] + G[1, i] * F[1, j] + G[2, i] * F[2, j]
        C[4, h] += G[0, i] * F[0, k] + G[1, i] * F[1, k] + G[2, i] * F[2, k]
        C[5, h] += G[0, j] * F[0, k] + G[1, j] * F[1, k] + G[2, j] * F[2, k]
        d[0, h] += F[0, i] * z[0] + F[1, i] * z[1] + F[2, i] * z[2]
        d[1, h] += F[0, j] * z[0] + F[1, j] * z[1] + F[2, j] * z[2]
        d[2, h] += F[0, k] * z[0] + F[1, k] * z[1] + F[2, k] * z[2]


@part
def respond(watch: Watch, work: Work, room: Room) -> None:
    """Write X <- X - K H X."""
    X, G, K = watch.X, room.G, work.K
    for i in range(SIZE):
        for c in range(COLUMNS):
            X[i, c] -= K[0, i] * G[0, c] + K[1, i] * G[1, c] + K[2, i] * G[2, c]


@part
def thin(watch: Watch) -> int:
    """Return an onset to be used anew: an unused one, the oldest, or one with near neighbours."""
    n, order, age = watch.counts[COUNT], watch.order, watch.age
    if n < ONSETS:
        watch.counts[COUNT] = n + 1
        order[n] = n
        return n
    drop, least = 0, 1e9
    if age[order[0]] <= OLDEST:
        for k in range(1, ONSETS - 1):
            gap = (age[order[k - 1]] - age[order[k + 1]]) / age[order[k]]
            if gap < least:
                drop, least = k, gap
    onset = order[drop]
    for k in range(drop, ONSETS - 1):
        order[k] = order[k + 1]
    order[ONSETS - 1] = onset
    return onset


@part
def take_up(watch: Watch, t: float) -> None:
    """Let every onset age by a row, and take up one that begins now."""
    for k in range(watch.counts[COUNT]):
        watch.age[watch.order[k]] += 1
    onset = thin(watch)
    watch.age[onset], watch.since[onset] = 0, t
    for kind in range(2):
        h = kind * ONSETS + onset
        for a in range(6):
            watch.C[a, h] = 0.0
        for a in range(3):
            watch.d[a, h] = 0.0
            for i in range(SIZE):
                watch.X[i, a * MANY + h] = 1.0 if i == 3 + 3 * kind + a else 0.0
