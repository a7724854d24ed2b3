"""The tracker's walk along its rows, compiled: predict, judge the row, correct, look for contacts.

A row whose squared innovation is beyond ``GATE`` is not used. The walk ends early where the belief
has moved away from the point of linearisation, or where a contact was mended or the attitude taken
anew: the caller then decides from where to go on.
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.propagation import Columns, step
from equipoise.dynamics.regressor import WIDTH, Triple
from equipoise.dynamics.rigid_body import ROWS, Body, Now, body_at, rate_of
from equipoise.dynamics.sensitivities import BLOCK
from equipoise.estimation import tracker_contacts as contacts
from equipoise.estimation.tracker_contacts import LOST, MANY, Room, Watch
from equipoise.estimation.tracker_contacts import WIDTH as WIDE
from equipoise.estimation.tracker_noise import learn_noise, settled
from equipoise.estimation.tracker_point import AT, moved, transport
from equipoise.estimation.tracker_step import (
    SIZE,
    N,
    Work,
    add_stops,
    apply,
    begin,
    expect,
    innovation,
    lean,
    note,
    placed,
    predict_covariance,
    shrink,
    transition,
    unit_columns,
    weigh,
)
from equipoise.maths.compiled import kernel, part
from equipoise.maths.turns import turn
from equipoise.model.arrays import Floats, Ints

GATE = 30.7  # chi-square of 3 that one sound row in a million exceeds
EARLY_GATE = 10 * GATE  # chosen: while the noise is not known; it may be three times as stated
UNSURE = (0.5, 0.03)  # rad, chosen: beyond it an attitude is taken anew rather than corrected; the
# second after a gap: with more, the phase of a swing of 10 deg is not linear to a camera's noise
PATIENT, HASTY = 25, 5  # gated rows in a run, chosen, after which it is: in motion, at the start
STILLEST = 0.1  # rad/s, least sd of a rate that is taken anew without a row shortly before
SHORTLY = 1.0  # s
END, MOVED, BROKEN, ASTRAY = 0, 1, 2, 3  # why the walk ended


class Model(NamedTuple):
    """What does not change along the walk."""

    body: Body  # its inertia and moment are not used
    maps: Floats
    columns: Columns
    sd: Floats  # (2,) rad, rad/s: stated noise of camera and gyro
    walks: Floats  # (18,)
    alarm: float  # l of a contact


class Rows(NamedTuple):
    """What was seen and known from one moment on."""

    t: Floats  # (n+1,) s
    known: Floats  # (n+1, 6 + k)
    owners: Ints
    q: Floats  # (n_q, 4)
    q_node: Ints
    w: Floats  # (n_w, 3) rad/s
    w_node: Ints
    stop_node: Ints
    stop_added: Floats  # (n_s, 3, 3) m^2


class Walk(NamedTuple):
    """From which node to which, and what is wanted of it."""

    first: int
    last: int
    look: int  # node from which it ends where the belief has moved
    folding: bool  # the point goes with the belief
    again: bool  # rows that have been passed before: nothing is noted or learnt


@part
def lag_of(rows: Rows, iq: int, first: float) -> float:
    """Return the time (s) since the attitude row before, or since the walk's first node."""
    return float(rows.t[rows.q_node[iq]] - (rows.t[rows.q_node[iq - 1]] if iq > 0 else first))


@part
def unsure(P: Floats, lag: float) -> bool:
    """Say whether the predicted attitude, all axes together, is too doubtful to be corrected."""
    limit = UNSURE[1] if lag > SHORTLY else UNSURE[0]
    return P[0, 0] + P[1, 1] + P[2, 2] > limit * limit


@part
def take_anew(rows: Rows, iq: int, t: float, sd: float, end: Floats, P: Floats) -> None:
    """Write attitude and rate from a row and the one before, and their covariance."""
    for j in range(4):
        end[j] = rows.q[iq, j]
    speed = (end[4] ** 2 + end[5] ** 2 + end[6] ** 2) ** 0.5
    spread = max(STILLEST, speed)
    lag = t - rows.t[rows.q_node[iq - 1]] if iq > 0 else SHORTLY
    if lag < SHORTLY:
        rate = turn(rows.q[iq - 1], rows.q[iq])
        spread = 2.0 * sd / lag
        for j in range(3):
            end[4 + j] = rate[j] / lag
            spread += 0.1 * abs(rate[j]) / lag
    for i in range(6):
        for j in range(SIZE):
            P[i, j] = 0.0
            P[j, i] = 0.0
    for j in range(3):
        P[j, j], P[3 + j, 3 + j] = sd * sd, spread * spread


class Moving(NamedTuple):
    """Arrays that a step of the propagator works in."""

    y: Floats  # (7 + 96,) attitude, momentum, sensitivities
    at: Floats
    dy: Floats
    total: Floats
    regress: Floats  # (3, 25)
    fb: Floats
    phi: Floats  # (6, 15)


@part
def predict(
    model: Model, rows: Rows, body: Body, i: int, point: Floats, end: Floats, P: Floats,
    moving: Moving, A: Floats,
) -> Now:  # fmt: skip
    """Take belief and covariance over step i; return the platform at its end."""
    y, regress, phi, t, inputs = moving.y, moving.regress, moving.phi, rows.t, rows.known
    now = body_at(body, model.maps, t, inputs, i, 0.0)
    begin(now, end, y)
    unit_columns(now, rate_of(now, y), regress, y)
    step(body, model.maps, t, inputs, rows.owners, model.columns, i, y, regress, moving.fb,
         moving.at, moving.dy, moving.total)  # fmt: skip
    now = body_at(body, model.maps, t, inputs, i, 1.0)
    transition(now, body.mass, y, regress, phi)
    predict_covariance(body.inertia, phi, model.walks, t[i + 1] - t[i], P, A)
    lean(now, phi, point, y, end)
    begin(now, end, y)
    return now


@part
def judge(
    P: Floats, first: int, second: int, z: Triple, sd: float, level: Floats, known: bool,
    again: bool, watch: Watch, work: Work, room: Room,
) -> float:  # fmt: skip
    """Write x and P+ (x = 0 and P for a row that is not used); return the squared innovation."""
    expect(P, first, second, sd, work)
    surprise = weigh(z, work)
    odd = surprise > (GATE if known else EARLY_GATE)
    if not again:
        run = watch.counts[contacts.GATED] + 1 if odd else 0
        watch.counts[contacts.GATED] = run
        if run < 2:
            S = work.S
            learn_noise(level, surprise, 3.0 * sd * sd / (S[0, 0] + S[1, 1] + S[2, 2]))
        contacts.felt(watch, first, second, room)
        if run != 1:
            contacts.gather(watch, z, work, room)
        if not odd:
            contacts.respond(watch, work, room)
    if odd:
        work.x[:] = 0.0
    else:
        shrink(P, work)
    return surprise


@part
def by_attitude(
    rows: Rows, iq: int, now: Now, sd: float, levels: Floats, known: bool, again: bool,
    end: Floats, P: Floats, y: Floats, watch: Watch, work: Work, room: Room, done: Ints,
) -> float:  # fmt: skip
    """Correct by a row of the camera, or take attitude and rate from it anew."""
    late = watch.counts[contacts.GATED] >= (PATIENT if known else HASTY) and not again
    if late or unsure(P, lag_of(rows, iq, rows.t[0])):
        done[0] = ASTRAY if late else BROKEN
        take_anew(rows, iq, float(rows.t[rows.q_node[iq]]), sd, end, P)
        return 0.0
    z = turn(y, rows.q[iq])
    surprise = judge(P, 0, -1, z, sd, levels[0], known, again, watch, work, room)
    apply(work.x, rate_of(now, y), y, end)
    return surprise


@part
def see(
    model: Model, rows: Rows, again: bool, node: int, iq: int, iw: int, now: Now, known: bool,
    end: Floats, P: Floats, y: Floats, levels: Floats, watch: Watch, work: Work, room: Room,
    out: Floats, done: Ints,
) -> tuple[int, int]:  # fmt: skip
    """Correct by the rows at a node and write them down; return the rows that are next."""
    for source in range(2):
        sd = model.sd[source] * levels[source, 0] ** 0.5
        if source == 0 and iq < rows.q_node.shape[0] and rows.q_node[iq] == node:
            surprise = by_attitude(rows, iq, now, sd, levels, known, again, end, P, y, watch, work,
                                   room, done)  # fmt: skip
            iq += 1
        elif source == 1 and iw < rows.w_node.shape[0] and rows.w_node[iw] == node:
            z = innovation(now, y, end[AT + 9 :], rows.w[iw])
            surprise = judge(P, 3, N, z, sd, levels[1], known, again, watch, work, room)
            apply(work.x, rate_of(now, y), y, end)
            iw += 1
        else:
            continue
        begin(now, end, y)
        if not again:
            note(float(rows.t[node]), end, P, surprise, out[done[1]])
            done[1] += 1
    return iq, iw


@part
def touched(
    model: Model, now: Now, y: Floats, end: Floats, P: Floats, watch: Watch, work: Work,
    room: Room, events: Floats, done: Ints,
) -> bool:  # fmt: skip
    """Look for a contact; mend the belief if there was one."""
    kind, best = contacts.judged(watch, model.alarm, room)
    if kind < 0:
        return False
    contacts.mend(watch, P, work.x, room)
    apply(work.x, rate_of(now, y), y, end)
    if done[2] < events.shape[0]:
        contacts.report(watch, kind, best, room, events[done[2]])
        done[2] += 1
    done[0] = BROKEN
    return True


@part
def report_loss(t: float, events: Floats, done: Ints) -> None:
    """Write that the attitude was taken anew."""
    if done[2] < events.shape[0]:
        events[done[2]] = 0.0
        events[done[2], 0], events[done[2], 1] = t, LOST
        done[2] += 1


@kernel
def run_filter(
    model: Model, rows: Rows, walk: Walk, point: Floats, end: Floats, P: Floats,
    levels: Floats, watch: Watch, out: Floats, events: Floats, done: Ints,
) -> int:  # fmt: skip
    """Filter rows; return the node reached. ``done``: why, rows and events written.

    ``point``, ``end`` (q, w, com, J, bias), P, levels and watch come and go.
    """
    again = walk.again
    y = np.zeros(ROWS + BLOCK)
    moving = Moving(y, np.empty_like(y), np.empty_like(y), np.empty_like(y), np.zeros((3, WIDTH)),
                    np.zeros(BLOCK), np.zeros((6, N)))  # fmt: skip
    work = Work(np.zeros(SIZE), np.zeros((3, SIZE)), np.zeros((3, 3)), np.zeros((3, 3)),
                np.zeros((3, SIZE)), np.zeros((3, SIZE)), np.zeros((6, SIZE)))  # fmt: skip
    room = Room(np.zeros((6, WIDE)), np.zeros((3, WIDE)), np.zeros((3, WIDE)), np.zeros((6, MANY)),
                np.zeros((3, MANY)), np.zeros(MANY), np.zeros(MANY), np.zeros(SIZE),
                np.zeros(SIZE))  # fmt: skip
    body = placed(model.body, point)
    iq = int(np.searchsorted(rows.q_node, walk.first + 1))
    iw = int(np.searchsorted(rows.w_node, walk.first + 1))
    stop = int(np.searchsorted(rows.stop_node, walk.first + 1))
    done[0] = END
    for i in range(walk.first, walk.last):
        now = predict(model, rows, body, i, point, end, P, moving, work.A)
        stop = add_stops(stop, i + 1, rows.stop_node, rows.stop_added, P)
        if not again:
            contacts.follow(watch, moving.phi, room)
        known, before = settled(levels), iq + iw
        iq, iw = see(model, rows, again, i + 1, iq, iw, now, known, end, P, y, levels, watch, work,
                     room, out, done)  # fmt: skip
        if done[0] != END:
            report_loss(float(rows.t[i + 1]), events, done)
            contacts.forget(watch)
            return i + 1
        if iq + iw == before or again:
            continue
        gone = moved(point, end)
        sound = known and (walk.folding or not gone)
        if sound and touched(model, now, y, end, P, watch, work, room, events, done):
            contacts.forget(watch)
            return i + 1
        contacts.take_up(watch, float(rows.t[i + 1]))
        if gone and walk.folding:
            transport(P, point, end)
            body = placed(model.body, point)
        elif gone and i + 1 >= walk.look:
            done[0] = MOVED
            return i + 1
    return walk.last
