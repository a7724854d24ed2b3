"""The estimate after a contact whose onset and kind are not certain, compiled.

Each hypothesis weighs p, would correct the estimate by X v and add X V X^T to its covariance:

    x + sum p X v,   P + sum p X V X^T + scatter of X v + half the way to the older onset's

which is exact for each (innovations are independent of what the filter errs by), and says what a
wrong kind or onset would cost.
"""

from equipoise.estimation.tracker.contact_test import LIKELY
from equipoise.estimation.tracker.event_signatures import COLUMNS, COUNT, MANY, ONSETS, Room, Watch
from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats

ROUGH = 0.1  # chosen: of the correction, one sd, for being linear in a motion that was off
UNIFORM = 1 / 12  # variance of an onset between two that are kept
EVENT = 15  # onset (s), kind, l, jump, its sd, step, its sd


@part
def effect(watch: Watch, h: int, by: int, room: Room, out: Floats) -> None:
    """Write X v, with X of one hypothesis and v of another."""
    for i in range(out.shape[0]):
        out[i] = 0.0
        for a in range(3):
            out[i] += watch.X[i * COLUMNS + a * MANY + h] * room.v[a * MANY + by]


@part
def scatter(P: Floats, x: Floats, weight: float) -> None:
    """Add weight x x^T."""
    for i in range(P.shape[0]):
        for j in range(P.shape[0]):
            P[i, j] += weight * x[i] * x[j]


@part
def doubts(watch: Watch, h: int, room: Room, P: Floats) -> None:
    """Add p X V X^T."""
    X, V, one = watch.X, room.V, room.one
    for a in range(3):
        row = (0, 3, 4) if a == 0 else ((3, 1, 5) if a == 1 else (4, 5, 2))
        for i in range(P.shape[0]):
            one[i] = 0.0
            for b in range(3):
                one[i] += room.p[h] * X[i * COLUMNS + b * MANY + h] * V[row[b] * MANY + h]
        for i in range(P.shape[0]):
            for j in range(P.shape[0]):
                P[i, j] += one[i] * X[j * COLUMNS + a * MANY + h]


@part
def mean_effect(watch: Watch, x: Floats, room: Room) -> None:
    """Write x = sum p X v."""
    x[:] = 0.0
    for h in range(MANY):
        if room.p[h] > 0.0:
            effect(watch, h, h, room, room.one)
            for i in range(room.one.shape[0]):
                x[i] += room.p[h] * room.one[i]


@part
def add_hypothesis(watch: Watch, k: int, kind: int, P: Floats, x: Floats, room: Room) -> None:
    """Add to P what one hypothesis of the mixture does."""
    one, other, h = room.one, room.other, kind * ONSETS + watch.order[k]
    p = float(room.p[h])
    effect(watch, h, h, room, one)
    if k > 0:
        effect(watch, kind * ONSETS + watch.order[k - 1], h, room, other)
        for i in range(P.shape[0]):
            other[i] -= one[i]
        scatter(P, other, UNIFORM * p)
    for i in range(P.shape[0]):
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
                out[o + a] += room.p[h] / share * room.v[a * MANY + h]
                square = (1 + ROUGH**2) * room.v[a * MANY + h] ** 2
                out[o + 3 + a] += room.p[h] / share * (room.V[a * MANY + h] + square)
            out[o + 3 + a] = abs(out[o + 3 + a] - out[o + a] ** 2) ** 0.5
