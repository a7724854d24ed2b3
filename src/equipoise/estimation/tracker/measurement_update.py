"""One row of a sensor: judged, used, left out, or taken as a new beginning; compiled.

A row whose squared innovation is beyond ``GATE`` is not used. Where the predicted attitude is so
doubtful that an innovation is not linear in what is unknown, attitude and rate are taken from the
row and the one before instead; the estimate of the body stays.
"""

from equipoise.dynamics.rigid_body import Now, rate_of
from equipoise.estimation.tracker import event_signatures as onsets
from equipoise.estimation.tracker.kernel_records import (
    ASTRAY,
    BROKEN,
    CAMERA,
    GYRO,
    REASON,
    Carried,
    Model,
    Tools,
    Walk,
)
from equipoise.estimation.tracker.linearisation_point import AT
from equipoise.estimation.tracker.measurements import Rows
from equipoise.estimation.tracker.noise_level import learn_noise
from equipoise.estimation.tracker.predict_correct import (
    apply,
    expect,
    innovation,
    shrink,
    weigh,
)
from equipoise.estimation.tracker.stored_covariance import ROW, N
from equipoise.maths.kernels.compiled import part
from equipoise.maths.turns import turn
from equipoise.model.arrays import Floats, Ints, Triple

GATE = 30.7  # chi-square of 3 that one sound row in a million exceeds
EARLY_GATE = 10 * GATE  # chosen: while the noise is not known; it may be three times as stated
UNSURE = (0.5, 0.03)  # rad, chosen: beyond it an attitude is taken anew rather than corrected; the
# second after a gap: with more, the phase of a swing of 10 deg is not linear to a camera's noise
PATIENT, HASTY = 25, 5  # gated rows in a run, chosen, after which it is: in motion, at the start
STILLEST = 0.1  # rad/s, least sd of a rate that is taken anew without a row shortly before
SHORTLY = 1.0  # s
ROUGHLY = 0.1  # chosen: of a rate that is a mean over the time between two rows


@part
def lag_of(rows: Rows, iq: int) -> float:
    """Return the time (s) since the attitude row before, or since the first node."""
    before = rows.t[rows.q_node[iq - 1]] if iq > 0 else rows.t[0]
    return float(rows.t[rows.q_node[iq]] - before)


@part
def unsure(P: Floats, lag: float) -> bool:
    """Say whether the predicted attitude, all axes together, is too doubtful to be corrected."""
    limit = UNSURE[1] if lag > SHORTLY else UNSURE[0]
    return P[0] + P[ROW + 1] + P[2 * ROW + 2] > limit * limit


@part
def take_anew(rows: Rows, iq: int, sd: float, end: Floats, P: Floats) -> None:
    """Write attitude and rate from a row and the one before, and their covariance.

    w = log(q_before^-1 q) / lag, sd 2 sd / lag and a share of w, which changes meanwhile. With no
    row shortly before, the rate stays as estimated, and its sd becomes as much.
    """
    for j in range(4):
        end[j] = rows.q[iq, j]
    spread = max(STILLEST, (end[4] ** 2 + end[5] ** 2 + end[6] ** 2) ** 0.5)
    lag = lag_of(rows, iq)
    if iq > 0 and lag < SHORTLY:
        rate = turn(rows.q[iq - 1], rows.q[iq])
        spread = 2.0 * sd / lag
        for j in range(3):
            end[4 + j] = rate[j] / lag
            spread += ROUGHLY * abs(rate[j]) / lag
    for i in range(6 * ROW):
        P[i] = 0.0
    for j in range(3):
        P[j * ROW + j], P[(3 + j) * ROW + 3 + j] = sd * sd, spread * spread


@part
def learn(z: Triple, odd: bool, carried: Carried, tools: Tools) -> None:
    """Add a row to the test for contacts; a single odd row is no contact, nor part of one."""
    watch = carried.watch
    if not odd or watch.counts[onsets.GATED] > 1:
        onsets.gather(watch, z, tools.work, tools.room)
    if not odd:
        onsets.respond(watch, tools.work, tools.room)


@part
def judge(
    model: Model, sensor: int, z: Triple, known: bool, walk: Walk, carried: Carried, tools: Tools
) -> float:
    """Write x and P+ (x = 0 and P for a row that is not used); return the squared innovation."""
    work, level, watch = tools.work, carried.levels[sensor], carried.watch
    first, second = (0, -1) if sensor == CAMERA else (3, N)
    R = model.sd[sensor] ** 2 * level[0]
    expect(first, second, R, work)
    surprise = weigh(z, work)
    odd = surprise > (GATE if known else EARLY_GATE)
    if not walk.again:
        watch.counts[onsets.GATED] = watch.counts[onsets.GATED] + 1 if odd else 0
        if watch.counts[onsets.GATED] < 2:
            S = work.S
            learn_noise(level, surprise, 3.0 * R / (S[0, 0] + S[1, 1] + S[2, 2]))
    if walk.testing:
        onsets.response(watch, first, second, tools.room)
        learn(z, odd, carried, tools)
    if odd:
        work.x[:] = 0.0
    else:
        shrink(first, second, R, work)
    return surprise


@part
def by_attitude(
    model: Model, rows: Rows, iq: int, now: Now, known: bool, walk: Walk, carried: Carried,
    tools: Tools, done: Ints,
) -> float:  # fmt: skip
    """Correct by a row of the camera, or take attitude and rate from it anew."""
    place, y = carried.place, tools.moving.y
    late = carried.watch.counts[onsets.GATED] >= (PATIENT if known else HASTY) and not walk.again
    if late or unsure(tools.work.P, lag_of(rows, iq)):
        done[REASON] = ASTRAY if late else BROKEN
        sd = model.sd[CAMERA] * carried.levels[CAMERA, 0] ** 0.5
        take_anew(rows, iq, sd, place.posterior, tools.work.P)
        return 0.0
    surprise = judge(model, CAMERA, turn(y, rows.q[iq]), known, walk, carried, tools)
    apply(tools.work.x, rate_of(now, y), y, place.posterior)
    return surprise


@part
def by_rate(
    model: Model, rows: Rows, iw: int, now: Now, known: bool, walk: Walk, carried: Carried,
    tools: Tools,
) -> float:  # fmt: skip
    """Correct by a row of the gyro."""
    end, y = carried.place.posterior, tools.moving.y
    z = innovation(now, y, end[AT + 9 :], rows.w[iw])
    surprise = judge(model, GYRO, z, known, walk, carried, tools)
    apply(tools.work.x, rate_of(now, y), y, end)
    return surprise
