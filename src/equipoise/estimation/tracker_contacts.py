"""Was the platform touched, or did its centre of mass step? A test of the innovations, compiled.

Willsky and Jones (1976), generalised likelihood ratio: had the rate jumped by v (or r stepped by
u) after some row, truth and filter would differ by X (v, u) from then on,

    X = [0 E 0 0 0; 0 0 E 0 0]^T,    X <- Phi X (prediction),    X <- X - K H X (correction)

and innovations by G = H X. Sums over the rows give the size and what it explains:

    C = sum G^T S^-1 G,   d = sum G^T S^-1 z,   v = (C + L)^-1 d,   l = d^T (C + L)^-1 d

each for jump and step alone, 3 degrees of freedom; L are wide priors. What is believed is mended
exactly: x + X v, P + X (C + L)^-1 X^T. Onsets are kept at a dozen ages, dense where they are
young, up to 50 rows. A jump turns the attitude by t, a step by t^2: so after some rows they differ.
"""

from typing import NamedTuple

from equipoise.dynamics.regressor import Triple
from equipoise.estimation.tracker_step import SIZE, N, Work, invert3
from equipoise.maths.compiled import part
from equipoise.model.arrays import Floats, Ints

ONSETS, KINDS = 12, 6  # onsets kept; columns of each: jump of rate, step of r
WIDTH = ONSETS * KINDS
OLDEST = 50  # rows
YOUNGEST = 3  # rows, chosen: a contact shows in more than two
PRIOR = (0.1, 2e-4)  # rad/s and m, one sd, wide: a jump, a step
SURE = 9.0  # chosen: a likelihood ratio of 90 tells a jump from a step
PATIENCE = 15  # rows, chosen: to wait for that
SPREAD = 0.3  # uniform: of the gap between onsets, one sd
COUNT, GATED, WAITED = 0, 1, 2  # in Watch.counts
JUMP, STEP, EITHER, LOST = 0, 1, 2, 3


class Watch(NamedTuple):
    """What the test remembers."""

    X: Floats  # (18, 72)
    C: Floats  # (12, 6, 6)
    d: Floats  # (12, 6)
    age: Ints  # (12,) rows
    since: Floats  # (12,) s
    order: Ints  # (12,) onsets, oldest first
    counts: Ints  # (3,) onsets in use, gated rows in a run, rows waited


class Room(NamedTuple):
    """Arrays that the test works in."""

    ahead: Floats  # (6, 72)
    G: Floats  # (3, 72)
    weighed: Floats  # (3, 72) S^-1 G
    small: Floats  # (3, 3)
    V: Floats  # (6, 6)
    v: Floats  # (6,)
    XV: Floats  # (18, 6)


@part
def forget(watch: Watch) -> None:
    """Begin anew."""
    watch.counts[:] = 0
    watch.X[:] = 0.0


@part
def follow(watch: Watch, phi: Floats, room: Room) -> None:
    """Write X <- Phi X."""
    X, ahead = watch.X, room.ahead
    for r in range(6):
        for c in range(WIDTH):
            ahead[r, c] = 0.0
        for k in range(N):
            for c in range(WIDTH):
                ahead[r, c] += phi[r, k] * X[k, c]
    for r in range(6):
        for c in range(WIDTH):
            X[r, c] = ahead[r, c]


@part
def gather(watch: Watch, first: int, second: int, z: Triple, work: Work, room: Room) -> None:
    """Add a row to C and d."""
    X, G, weighed, inverse = watch.X, room.G, room.weighed, work.inverse
    for r in range(3):
        for c in range(WIDTH):
            G[r, c] = X[first + r, c] + (X[second + r, c] if second >= 0 else 0.0)
    for r in range(3):
        for c in range(WIDTH):
            weighed[r, c] = (
                inverse[r, 0] * G[0, c] + inverse[r, 1] * G[1, c] + inverse[r, 2] * G[2, c]
            )
    for k in range(watch.counts[COUNT]):
        onset = watch.order[k]
        c = KINDS * onset
        for a in range(KINDS):
            for r in range(3):
                watch.d[onset, a] += weighed[r, c + a] * z[r]
                for b in range(KINDS):
                    watch.C[onset, a, b] += G[r, c + a] * weighed[r, c + b]


@part
def respond(watch: Watch, first: int, second: int, work: Work, room: Room) -> None:
    """Write X <- X - K H X."""
    X, G, K = watch.X, room.G, work.K
    for r in range(3):
        for c in range(WIDTH):
            G[r, c] = X[first + r, c] + (X[second + r, c] if second >= 0 else 0.0)
    for i in range(SIZE):
        for c in range(WIDTH):
            X[i, c] -= K[i, 0] * G[0, c] + K[i, 1] * G[1, c] + K[i, 2] * G[2, c]


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
    c = KINDS * onset
    watch.age[onset], watch.since[onset] = 0, t
    for a in range(KINDS):
        watch.d[onset, a] = 0.0
        for i in range(SIZE):
            watch.X[i, c + a] = 1.0 if i == 3 + a else 0.0
        for b in range(KINDS):
            watch.C[onset, a, b] = 0.0


@part
def explained(watch: Watch, onset: int, kind: int, room: Room) -> float:
    """Return l of a jump (0) or a step (1)."""
    small, V, C, d, o = room.small, room.V, watch.C, watch.d, 3 * kind
    for a in range(3):
        for b in range(3):
            small[a, b] = C[onset, o + a, o + b]
        small[a, a] += PRIOR[kind] ** -2
    invert3(small, V)
    total = 0.0
    for a in range(3):
        for b in range(3):
            total += d[onset, o + a] * V[a, b] * d[onset, o + b]
    return total


@part
def strongest(watch: Watch, kind: int, room: Room) -> tuple[float, int]:
    """Return the greatest l of a kind, and which in order it is."""
    best, which = 0.0, 0
    for k in range(watch.counts[COUNT]):
        if watch.age[watch.order[k]] >= YOUNGEST:
            l = explained(watch, watch.order[k], kind, room)
            if l > best:
                best, which = l, k
    return best, which


@part
def judged(watch: Watch, alarm: float, room: Room) -> tuple[int, int, float]:
    """Return the kind (or -1: nothing, or not yet told), the onset and l."""
    jump, by_jump = strongest(watch, JUMP, room)
    step, by_step = strongest(watch, STEP, room)
    best = max(jump, step)
    if best < alarm:
        watch.counts[WAITED] = 0
        return -1, 0, best
    watch.counts[WAITED] += 1
    if abs(jump - step) < SURE:
        if watch.counts[WAITED] < PATIENCE:
            return -1, 0, best
        return EITHER, by_jump if jump > step else by_step, best
    return (JUMP, by_jump, best) if jump > step else (STEP, by_step, best)


@part
def invert_within(A: Floats, low: int, high: int) -> None:
    """Invert a positive block in place (Gauss and Jordan)."""
    for p in range(low, high):
        pivot = 1.0 / A[p, p]
        A[p, p] = 1.0
        for j in range(low, high):
            A[p, j] *= pivot
        for i in range(low, high):
            if i != p:
                factor = A[i, p]
                A[i, p] = 0.0
                for j in range(low, high):
                    A[i, j] -= factor * A[p, j]


@part
def fit(watch: Watch, onset: int, low: int, high: int, room: Room) -> None:
    """Write V = (C + L)^-1 and v = V d of the columns from low to high."""
    V, v = room.V, room.v
    for a in range(low, high):
        for b in range(low, high):
            V[a, b] = watch.C[onset, a, b]
        V[a, a] += PRIOR[a // 3] ** -2
    invert_within(V, low, high)
    for a in range(low, high):
        v[a] = 0.0
        for b in range(low, high):
            v[a] += V[a, b] * watch.d[onset, b]


@part
def mend(watch: Watch, kind: int, which: int, P: Floats, x: Floats, room: Room) -> None:
    """Write x = X v and P + X V X^T, and the doubt from the onset's; V and v stay in room."""
    onset = watch.order[which]
    low, high = (0 if kind != STEP else 3), (KINDS if kind != JUMP else 3)
    fit(watch, onset, low, high, room)
    older = watch.age[watch.order[which - 1]] if which > 0 else OLDEST
    share = SPREAD * (older - watch.age[onset]) / watch.age[onset]
    XV, c = room.XV, KINDS * onset
    for i in range(SIZE):
        x[i] = 0.0
        for a in range(low, high):
            x[i] += watch.X[i, c + a] * room.v[a]
            XV[i, a] = 0.0
            for b in range(low, high):
                XV[i, a] += watch.X[i, c + b] * room.V[b, a]
    for i in range(SIZE):
        for j in range(SIZE):
            P[i, j] += share * share * x[i] * x[j]
            for a in range(low, high):
                P[i, j] += XV[i, a] * watch.X[j, c + a]


@part
def report(watch: Watch, kind: int, which: int, l: float, room: Room, out: Floats) -> None:
    """Write onset (s), kind, l, jump and step and their sds; what was not fitted is 0."""
    low, high = (0 if kind != STEP else 3), (KINDS if kind != JUMP else 3)
    out[:] = 0.0
    out[0], out[1], out[2] = watch.since[watch.order[which]], kind, l
    for a in range(low, high):
        out[3 + a], out[9 + a] = room.v[a], room.V[a, a] ** 0.5
