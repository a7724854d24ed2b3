"""Was the platform touched, or did its centre of mass step? A test of the innovations, compiled.

Willsky and Jones (1976), generalised likelihood ratio: had the rate jumped by v (or r stepped by
v) after some row, truth and filter would differ by X v from then on,

    X = [0 E 0 0 0]^T or [0 0 E 0 0]^T,    X <- Phi X (prediction),    X <- X - K H X (correction)

and innovations by G = H X. Sums over the rows give the size and what it explains:

    C = sum G^T S^-1 G,   d = sum G^T S^-1 z,   V = (C + L)^-1,   v = V d,   l = d^T V d

with 3 degrees of freedom; L is a wide prior. Onsets are kept at a dozen ages, dense where they are
young, up to 50 rows. Each with a jump and a step is a hypothesis; once the best explains more than
chance does, the belief becomes their mixture, each weighing

    p = e^(l/2) x rows to the next older onset
    x + sum p X v,   P + sum p X V X^T + scatter of X v + half the way to the older onset's

which is exact for each (innovations are independent of what the filter errs by), and says what a
wrong kind or onset would cost.
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.regressor import Triple
from equipoise.estimation.tracker_step import SIZE, Work, ahead
from equipoise.maths.compiled import part
from equipoise.model.arrays import Floats, Ints

ONSETS = 12
MANY = 2 * ONSETS  # hypotheses: jumps of the rate, then steps of r
WIDTH = 3 * MANY  # columns of X: hypotheses along x, along y, along z
OLDEST = 50  # rows
YOUNGEST = 3  # rows, chosen: a contact shows in more than two
JUMP_SD, STEP_SD = 0.1, 1e-4  # rad/s and m, wide: what a contact may do
TEMPER = 0.25  # chosen: half of the log likelihood's, since an onset is between two that are kept
SURE, LIKELY = 0.99, 0.9  # chosen: probability of a kind, for which to wait, and to report
TELLING = 8  # rows, chosen: by when a jump and a step differ, whenever between rows they began
PATIENCE = 20  # rows, chosen: to wait for all that
ROUGH = 0.1  # chosen: of what is mended, one sd, for being linear in a motion that was far off
UNIFORM = 1 / 12  # variance of an onset between two that are kept
COUNT, GATED, WAITED = 0, 1, 2  # in Watch.counts
JUMP, STEP, EITHER, LOST = 0, 1, 2, 3  # kinds of event
EVENT = 15  # onset (s), kind, l, jump, its sd, step, its sd


class Watch(NamedTuple):
    """What the test remembers."""

    X: Floats  # (18, 72)
    C: Floats  # (6, 24) xx yy zz xy xz yz
    d: Floats  # (3, 24)
    age: Ints  # (12,) rows
    since: Floats  # (12,) s
    order: Ints  # (12,) onsets, oldest first
    counts: Ints  # (3,) onsets in use, gated rows in a run, rows waited


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
    """Return a test that has seen nothing."""
    return Watch(
        np.zeros((SIZE, WIDTH)), np.zeros((6, MANY)), np.zeros((3, MANY)),
        np.zeros(ONSETS, np.int64), np.zeros(ONSETS), np.zeros(ONSETS, np.int64),
        np.zeros(3, np.int64),
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
        for c in range(WIDTH):
            after[r, c] = ahead(phi, r, X, c)
    for r in range(6):
        for c in range(WIDTH):
            X[r, c] = after[r, c]


@part
def felt(watch: Watch, first: int, second: int, room: Room) -> None:
    """Write G = H X."""
    X, G = watch.X, room.G
    for r in range(3):
        for c in range(WIDTH):
            G[r, c] = X[first + r, c]
        if second >= 0:
            for c in range(WIDTH):
                G[r, c] += X[second + r, c]


@part
def gather(watch: Watch, z: Triple, work: Work, room: Room) -> None:
    """Add a row to C and d."""
    G, F, inverse, C, d = room.G, room.weighed, work.inverse, watch.C, watch.d
    for r in range(3):
        for c in range(WIDTH):
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
        for c in range(WIDTH):
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


@part
def explain(watch: Watch, room: Room) -> None:
    """Write V, v and l of every hypothesis."""
    C, d, V, v = watch.C, watch.d, room.V, room.v
    for h in range(MANY):
        prior = JUMP_SD**-2 if h < ONSETS else STEP_SD**-2
        xx, yy, zz = C[0, h] + prior, C[1, h] + prior, C[2, h] + prior
        xy, xz, yz = C[3, h], C[4, h], C[5, h]
        a, b, c = yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy
        k = 1.0 / (xx * a + xy * b + xz * c)
        V[0, h], V[3, h], V[4, h] = k * a, k * b, k * c
        V[1, h], V[2, h] = k * (xx * zz - xz * xz), k * (xx * yy - xy * xy)
        V[5, h] = k * (xy * xz - xx * yz)
        v[0, h] = V[0, h] * d[0, h] + V[3, h] * d[1, h] + V[4, h] * d[2, h]
        v[1, h] = V[3, h] * d[0, h] + V[1, h] * d[1, h] + V[5, h] * d[2, h]
        v[2, h] = V[4, h] * d[0, h] + V[5, h] * d[1, h] + V[2, h] * d[2, h]
        room.gain[h] = v[0, h] * d[0, h] + v[1, h] * d[1, h] + v[2, h] * d[2, h]


@part
def best_of(watch: Watch, first: int, room: Room) -> int:
    """Return which of a kind's hypotheses, old enough, explains most; -1 if none is."""
    best = -1
    for k in range(watch.counts[COUNT]):
        h = first + watch.order[k]
        if watch.age[watch.order[k]] >= YOUNGEST and (best < 0 or room.gain[h] > room.gain[best]):
            best = h
    return best


@part
def weigh_up(watch: Watch, top: float, room: Room) -> float:
    """Write p of every hypothesis; return that of the jumps together."""
    total, jumps = 0.0, 0.0
    room.p[:] = 0.0
    for k in range(watch.counts[COUNT]):
        onset = watch.order[k]
        age = watch.age[onset]
        older = watch.age[watch.order[k - 1]] if k > 0 else age + 1
        for kind in range(2 if age >= YOUNGEST else 0):
            h = kind * ONSETS + onset
            p = np.exp(TEMPER * (room.gain[h] - top)) * (older - age)
            room.p[h] = p
            total += p
            jumps += p * (kind == 0)
    for h in range(MANY):
        room.p[h] /= total
    return float(jumps / total)


@part
def judged(watch: Watch, alarm: float, room: Room) -> tuple[int, int]:
    """Return the kind, or -1 for nothing or not yet told, and the best hypothesis."""
    explain(watch, room)
    jump, step = best_of(watch, 0, room), best_of(watch, ONSETS, room)
    if jump < 0:
        return -1, 0
    best = jump if room.gain[jump] > room.gain[step] else step
    if room.gain[best] < alarm:
        watch.counts[WAITED] = 0
        return -1, 0
    share = weigh_up(watch, room.gain[best], room)
    watch.counts[WAITED] += 1
    told = max(share, 1.0 - share) > SURE and watch.age[best % ONSETS] >= TELLING
    if not told and watch.counts[WAITED] < PATIENCE:
        return -1, 0
    if max(share, 1.0 - share) < LIKELY:
        return EITHER, best
    return (JUMP, jump) if share > 0.5 else (STEP, step)


@part
def effect(watch: Watch, h: int, by: int, room: Room, out: Floats) -> None:
    """Write X v, with X of one hypothesis and v of another."""
    for i in range(SIZE):
        out[i] = 0.0
        for a in range(3):
            out[i] += watch.X[i, a * MANY + h] * room.v[a, by]


@part
def scatter(P: Floats, x: Floats, weight: float) -> None:
    """Add weight x x^T."""
    for i in range(SIZE):
        for j in range(SIZE):
            P[i, j] += weight * x[i] * x[j]


@part
def doubts(watch: Watch, h: int, room: Room, P: Floats) -> None:
    """Add p X V X^T."""
    X, V, one = watch.X, room.V, room.one
    for a in range(3):
        row = (0, 3, 4) if a == 0 else ((3, 1, 5) if a == 1 else (4, 5, 2))
        for i in range(SIZE):
            one[i] = 0.0
            for b in range(3):
                one[i] += room.p[h] * X[i, b * MANY + h] * V[row[b], h]
        for i in range(SIZE):
            for j in range(SIZE):
                P[i, j] += one[i] * X[j, a * MANY + h]


@part
def mean_effect(watch: Watch, x: Floats, room: Room) -> None:
    """Write x = sum p X v."""
    x[:] = 0.0
    for h in range(MANY):
        if room.p[h] > 0.0:
            effect(watch, h, h, room, room.one)
            for i in range(SIZE):
                x[i] += room.p[h] * room.one[i]


@part
def add_hypothesis(watch: Watch, k: int, kind: int, P: Floats, x: Floats, room: Room) -> None:
    """Add to P what one hypothesis of the mixture does."""
    one, other, h = room.one, room.other, kind * ONSETS + watch.order[k]
    p = float(room.p[h])
    effect(watch, h, h, room, one)
    if k > 0:
        effect(watch, kind * ONSETS + watch.order[k - 1], h, room, other)
        for i in range(SIZE):
            other[i] -= one[i]
        scatter(P, other, UNIFORM * p)
    for i in range(SIZE):
        one[i] -= x[i]
    scatter(P, one, p)
    doubts(watch, h, room, P)


@part
def mend(watch: Watch, P: Floats, x: Floats, room: Room) -> None:
    """Write x and P of the mixture."""
    mean_effect(watch, x, room)
    scatter(P, x, ROUGH**2)
    for k in range(watch.counts[COUNT]):
        for kind in range(2):
            if room.p[kind * ONSETS + watch.order[k]] > 0.0:
                add_hypothesis(watch, k, kind, P, x, room)


@part
def report(watch: Watch, kind: int, best: int, room: Room, out: Floats) -> None:
    """Write an event; jump and step are means of their kind's hypotheses, 0 where it is not."""
    out[:] = 0.0
    out[0], out[1], out[2] = watch.since[best % ONSETS], kind, room.gain[best]
    for which in range(2):
        share = 0.0
        for h in range(which * ONSETS, (which + 1) * ONSETS):
            share += room.p[h]
        if share < 1.0 - LIKELY:
            continue
        o = 3 + 6 * which
        for a in range(3):
            for h in range(which * ONSETS, (which + 1) * ONSETS):
                out[o + a] += room.p[h] / share * room.v[a, h]
                square = (1 + ROUGH**2) * room.v[a, h] ** 2
                out[o + 3 + a] += room.p[h] / share * (room.V[a, h] + square)
            out[o + 3 + a] = abs(out[o + 3 + a] - out[o + a] ** 2) ** 0.5
