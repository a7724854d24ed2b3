"""Was the platform touched, or did its centre of mass step? A test of the innovations, compiled.

With C and d of every hypothesis (``event_signatures``), what it would be and what it explains:

    V = (C + L)^-1,   v = V d,   l = d^T V d

with 3 degrees of freedom; L is a wide prior. Once the best explains more than chance does, and it
is clear whether the rate jumped or r stepped (or that it will not become clear), there is a
contact: the estimate becomes the mixture of all (``mixture``), each weighing

    p = e^(l/4) x rows to the next older onset
"""

import numpy as np

from equipoise.dynamics.rigid_body import invert, times
from equipoise.estimation.tracker.event_signatures import (
    COUNT,
    MANY,
    ONSETS,
    SUSPECT,
    WAITED,
    Room,
    Watch,
)
from equipoise.maths.kernels.compiled import part

YOUNGEST = 3  # rows, chosen: a contact shows in more than two
JUMP_SD, STEP_SD = 0.1, 1e-4  # rad/s and m, wide: what a contact may do
TEMPER = 0.25  # chosen: half of the log likelihood's, since an onset is between two that are kept
SURE, LIKELY = 0.99, 0.9  # chosen: probability of a kind, for which to wait, and to report
DECISIVE = 8  # rows, chosen: by when a jump and a step differ, whenever between rows they began
PATIENCE = 20  # rows, chosen: to wait for all that
JUMP, STEP, EITHER, LOST = 0, 1, 2, 3  # kinds of event


@part
def explain(watch: Watch, room: Room) -> None:
    """Write V, v and l of every hypothesis."""
    C, d, V, v, m = watch.C, watch.d, room.V, room.v, MANY
    for h in range(MANY):
        prior = JUMP_SD**-2 if h < ONSETS else STEP_SD**-2
        xx, yy, zz = C[h] + prior, C[m + h] + prior, C[2 * m + h] + prior
        xy, xz, yz = C[3 * m + h], C[4 * m + h], C[5 * m + h]
        x, y, z = d[h], d[m + h], d[2 * m + h]
        V_xx, V_yy, V_zz, V_xy, V_xz, V_yz = invert((xx, yy, zz, xy, xz, yz))
        V[h], V[m + h], V[2 * m + h] = V_xx, V_yy, V_zz
        V[3 * m + h], V[4 * m + h], V[5 * m + h] = V_xy, V_xz, V_yz
        a, b, c = times((V_xx, V_yy, V_zz, V_xy, V_xz, V_yz), (x, y, z))
        v[h], v[m + h], v[2 * m + h] = a, b, c
        room.gain[h] = a * x + b * y + c * z


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
def suspect(watch: Watch, alarm: float, room: Room) -> None:
    """Note that a contact would explain the innovations, where the motion may not be linear."""
    explain(watch, room)
    jump, step = best_of(watch, 0, room), best_of(watch, ONSETS, room)
    if jump >= 0 and max(room.gain[jump], room.gain[step]) > alarm:
        watch.counts[SUSPECT] = 1


@part
def judged(watch: Watch, alarm: float, room: Room) -> tuple[int, int]:
    """Return the kind, or -1 for nothing or not yet decided, and the best hypothesis."""
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
    reported = max(share, 1.0 - share) > SURE and watch.age[best % ONSETS] >= DECISIVE
    if not reported and watch.counts[WAITED] < PATIENCE:
        return -1, 0
    if max(share, 1.0 - share) < LIKELY:
        return EITHER, best
    return (JUMP, jump) if share > 0.5 else (STEP, step)
