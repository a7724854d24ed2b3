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

from equipoise.estimation.tracker.predict_correct import Work, ahead
from equipoise.estimation.tracker.stored_covariance import COM_ROW, DRIFT, ROW, SIZE, WARM_ROW
from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats, Ints, Triple

ONSETS = 12
MANY = 2 * ONSETS  # hypotheses: jumps of the rate, then steps of r
COLUMNS = 3 * MANY  # of X: hypotheses along x, along y, along z
OLDEST = 50  # rows
COUNT, GATED, WAITED, SUSPECT = 0, 1, 2, 3  # in Watch.counts


class Watch(NamedTuple):
    """What the test remembers; what has two dimensions lies row by row in one."""

    X: Floats  # (24, 72); (29, 72) of a platform that sags
    C: Floats  # (6, 24) xx yy zz xy xz yz
    d: Floats  # (3, 24)
    age: Ints  # (12,) rows
    since: Floats  # (12,) s
    order: Ints  # (12,) onsets, oldest first
    counts: Ints  # (4,) onsets in use, gated rows in a run, rows waited, if one is suspected


class Room(NamedTuple):
    """Arrays that the test works in, two dimensions in one as in ``Watch``."""

    after: Floats  # (6, 72)
    G: Floats  # (3, 72)
    weighed: Floats  # (3, 72) S^-1 G
    V: Floats  # (6, 24)
    v: Floats  # (3, 24)
    gain: Floats  # (24,) l
    p: Floats  # (24,) probability
    one: Floats  # (24,)
    other: Floats  # (24,)


def new_watch(size: int = SIZE) -> Watch:
    """Return a test that has no rows yet, of an error state of this size."""
    return Watch(
        np.zeros(size * COLUMNS), np.zeros(6 * MANY), np.zeros(3 * MANY),
        np.zeros(ONSETS, np.int64), np.zeros(ONSETS), np.zeros(ONSETS, np.int64),
        np.zeros(4, np.int64),
    )  # fmt: skip


@part
def forget(watch: Watch) -> None:
    """Restart."""
    watch.counts[:] = 0
    watch.X[:] = 0.0


@part
def follow(watch: Watch, phi: Floats, kelvins: float, dt: float, room: Room) -> None:
    """Write X <- D Phi W X over a step: warmer by some kelvins before it, dt (s) of drift after."""
    X, after = watch.X, room.after
    for c in range(3 * COLUMNS if kelvins != 0.0 else 0):
        X[COM_ROW * COLUMNS + c] += kelvins * X[WARM_ROW * COLUMNS + c]
    for r in range(6):
        for c in range(COLUMNS):
            after[r * COLUMNS + c] = ahead(phi, r, X, COLUMNS, c)
    for c in range(6 * COLUMNS):
        X[c] = after[c]
    for c in range(3 * COLUMNS):
        X[6 * COLUMNS + c] += dt * X[DRIFT * COLUMNS + c]


@part
def response(watch: Watch, first: int, second: int, room: Room) -> None:
    """Write G = H X."""
    X, G = watch.X, room.G
    for c in range(3 * COLUMNS):
        G[c] = X[first * COLUMNS + c]
    if second >= 0:
        for c in range(3 * COLUMNS):
            G[c] += X[second * COLUMNS + c]


@part
def product(A: Floats, a: int, B: Floats, b: int) -> float:
    """Return the product of two columns of three rows."""
    return A[a] * B[b] + A[COLUMNS + a] * B[COLUMNS + b] + A[2 * COLUMNS + a] * B[2 * COLUMNS + b]


@part
def gather(watch: Watch, z: Triple, work: Work, room: Room) -> None:
    """Add a row to C and d."""
    G, F, S, C, d = room.G, room.weighed, work.inverse, watch.C, watch.d
    for r in range(3):
        for c in range(COLUMNS):
            F[r * COLUMNS + c] = (S[r, 0] * G[c] + S[r, 1] * G[COLUMNS + c]
                                  + S[r, 2] * G[2 * COLUMNS + c])  # fmt: skip
    for h in range(MANY):
        i, j, k = h, MANY + h, 2 * MANY + h
        C[h] += product(G, i, F, i)
        C[MANY + h] += product(G, j, F, j)
        C[2 * MANY + h] += product(G, k, F, k)
        C[3 * MANY + h] += product(G, i, F, j)
        C[4 * MANY + h] += product(G, i, F, k)
        C[5 * MANY + h] += product(G, j, F, k)
    for h in range(COLUMNS):
        d[h] += F[h] * z[0] + F[COLUMNS + h] * z[1] + F[2 * COLUMNS + h] * z[2]


@part
def respond(watch: Watch, work: Work, room: Room) -> None:
    """Write X <- X - K H X."""
    X, G, K = watch.X, room.G, work.K
    for i in range(work.size):
        a, b, e = K[i], K[ROW + i], K[2 * ROW + i]
        for c in range(COLUMNS):
            X[i * COLUMNS + c] -= a * G[c] + b * G[COLUMNS + c] + e * G[2 * COLUMNS + c]


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
            watch.C[a * MANY + h] = 0.0
        for a in range(3):
            watch.d[a * MANY + h] = 0.0
            for i in range(watch.X.shape[0] // COLUMNS):
                watch.X[i * COLUMNS + a * MANY + h] = 1.0 if i == 3 + 3 * kind + a else 0.0
