"""The tracker's walk along its rows, compiled: predict, correct by a row, test for contacts.

The walk ends early where the estimate has moved away from the point of linearisation, or where a
contact was corrected or the attitude taken anew: the caller then decides from where to go on.
"""

import numpy as np

from equipoise.dynamics.forcing import groups_of
from equipoise.dynamics.propagation import step
from equipoise.dynamics.rigid_body import KNOWN_WARMTH, Body, Now, body_at, rate_of
from equipoise.dynamics.sensitivities import Inputs
from equipoise.estimation.tracker import event_signatures as onsets
from equipoise.estimation.tracker.contact_test import LOST, judged, suspect
from equipoise.estimation.tracker.kernel_records import (
    END,
    EVENTS,
    MOVED,
    NOTED,
    REASON,
    TOUCHED,
    Carried,
    Model,
    Place,
    Tools,
    Walk,
    Written,
    new_tools,
)
from equipoise.estimation.tracker.linearisation_point import bent, distance, transport
from equipoise.estimation.tracker.measurement_update import by_attitude, by_rate
from equipoise.estimation.tracker.measurements import Rows
from equipoise.estimation.tracker.mixture import mend, report
from equipoise.estimation.tracker.noise_level import settled
from equipoise.estimation.tracker.predict_correct import (
    add_stops,
    apply,
    begin,
    carry,
    carry_beside,
    lean,
    note,
    placed,
    predict_covariance,
    transition,
    unit_columns,
)
from equipoise.estimation.tracker.sag import bend, bend_signatures, halfway_down
from equipoise.estimation.tracker.stored_covariance import (
    DRIFT,
    SIZE,
    WARM_ROW,
    coupled,
    drifts,
    give,
    take,
)
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.model.arrays import Floats


@part
def warmer(known: Floats, i: int) -> float:
    """Return by how much (K) it becomes warmer in step i."""
    return known[i + 1, KNOWN_WARMTH] - known[i, KNOWN_WARMTH]


@part
def predict(
    model: Model, inputs: Inputs, body: Body, i: int, point: Floats, end: Floats, tools: Tools
) -> Now:
    """Take estimate and covariance over step i; return the platform at its end."""
    moving, work, t = tools.moving, tools.work, inputs.t
    y, phi, kelvins = moving.y, moving.phi, warmer(inputs.known, i)
    carry(WARM_ROW, kelvins, end, work.P)
    now = body_at(body, inputs.maps, t, inputs.known, i, 0.0)
    lapse = t[i + 1] - t[i]
    drifted = 0.5 * lapse if drifts(work.P) else 0.0
    carry(DRIFT, drifted, end, work.P)
    if work.size > SIZE:
        carry_beside(WARM_ROW, kelvins, work)
        carry_beside(DRIFT, drifted, work)
        halfway_down(end, lapse, moving)
        bend(moving.down, 1.0, body.torque, end, work)
    begin(now, end, y)
    unit_columns(now, rate_of(now, y), y)
    step(body, inputs, i, y, moving.step)
    now = body_at(body, inputs.maps, t, inputs.known, i, 1.0)
    transition(now, body.mass, y, moving.step.fb, phi)
    predict_covariance(body.inertia, phi, model.walks, lapse, work)
    lean(now, phi, point, y, end)
    if work.size > SIZE:
        bend(moving.down, -1.0, body.torque, end, work)
        carry_beside(DRIFT, drifted, work)
    carry(DRIFT, drifted, end, work.P)
    begin(now, end, y)
    return now


@part
def noted(t: float, surprise: float, place: Place, P: Floats, written: Written) -> None:
    """Write a row down."""
    done = written.done
    note(t, place.posterior, P, surprise, written.out[done[NOTED]])
    done[NOTED] += 1


@part
def see(
    model: Model, rows: Rows, walk: Walk, node: int, iq: int, iw: int, now: Now, known: bool,
    carried: Carried, written: Written, tools: Tools,
) -> tuple[int, int]:  # fmt: skip
    """Correct by the rows at a node and write them down; return the rows that are next."""
    place, y, t = carried.place, tools.moving.y, float(rows.t[node])
    if iq < rows.q_node.shape[0] and rows.q_node[iq] == node:
        surprise = by_attitude(model, rows, iq, now, known, walk, carried, tools, written.done)
        begin(now, place.posterior, y)
        iq += 1
        if not walk.again:
            noted(t, surprise, place, tools.work.P, written)
    if iw < rows.w_node.shape[0] and rows.w_node[iw] == node:
        surprise = by_rate(model, rows, iw, now, known, walk, carried, tools)
        begin(now, place.posterior, y)
        iw += 1
        if not walk.again:
            noted(t, surprise, place, tools.work.P, written)
    return iq, iw


@part
def touched(model: Model, now: Now, carried: Carried, written: Written, tools: Tools) -> bool:
    """Test for a contact; correct the estimate if there was one."""
    work, room, place, done = tools.work, tools.room, carried.place, written.done
    kind, best = judged(carried.watch, model.alarm, room)
    if kind < 0:
        return False
    give(work.P, place.covariance)
    mend(carried.watch, place.covariance, work.x, room)
    take(place.covariance, work.P)
    y = tools.moving.y
    apply(work.x, rate_of(now, y), y, place.posterior)
    if done[EVENTS] < written.events.shape[0]:
        report(carried.watch, kind, best, room, written.events[done[EVENTS]])
        done[EVENTS] += 1
    done[REASON] = TOUCHED
    return True


@part
def report_loss(walk: Walk, t: float, written: Written) -> None:
    """Write that the attitude was taken anew."""
    events, done = written.events, written.done
    if not walk.again and done[EVENTS] < events.shape[0]:
        events[done[EVENTS]] = 0.0
        events[done[EVENTS], 0], events[done[EVENTS], 1] = t, LOST
        done[EVENTS] += 1


@part
def mended(
    model: Model, t: float, now: Now, known: bool, linear: bool, carried: Carried, written: Written,
    tools: Tools,
) -> bool:  # fmt: skip
    """Say whether a contact was found and corrected; the test waits until the noise is known.

    Where the motion may not be ``linear`` in what is unknown, a contact is suspected, no more.
    """
    watch = carried.watch
    if known and linear and touched(model, now, carried, written, tools):
        return True
    if known and not linear:
        suspect(watch, model.alarm, tools.room)
    onsets.take_up(watch, t)
    return False


@part
def follow_events(watch: onsets.Watch, kelvins: float, lapse: float, tools: Tools) -> None:
    """Take what events would have done to the estimate over a step, as ``predict`` takes it."""
    moving, sags = tools.moving, tools.work.size > SIZE
    if sags:
        bend_signatures(moving.down, 1.0, watch.X)
    onsets.follow(watch, moving.phi, kelvins, lapse, tools.room)
    if sags:
        bend_signatures(moving.down, -1.0, watch.X)


@part
def is_gone(point: Floats, end: Floats, sags: bool) -> bool:
    """Say whether the point has to move, for r and J or for a sag."""
    if distance(point, end) > 1.0:
        return True
    return sags and bent(point, end) > 1.0


@part
def fold(point: Floats, place: Place, P: Floats) -> None:
    """Let the point follow the estimate."""
    give(P, place.covariance)
    transport(place.covariance, point, place.posterior)
    take(place.covariance, P)


@part
def walk_on(
    model: Model, rows: Rows, walk: Walk, point: Floats, carried: Carried, written: Written,
    tools: Tools,
) -> int:  # fmt: skip
    """Filter rows; return the node reached. The covariance is the tools' own.

    A point with a sag is not folded on the way: the sag of the body has to go along.
    """
    place, levels, watch, done = carried.place, carried.levels, carried.watch, written.done
    body, P, sags = placed(model.body, point), tools.work.P, tools.work.size > SIZE
    groups = groups_of(model.columns)
    inputs = Inputs(model.maps, rows.t, rows.known, rows.owners, model.columns, groups)
    iq = int(np.searchsorted(rows.q_node, walk.first + 1))
    iw = int(np.searchsorted(rows.w_node, walk.first + 1))
    stop = int(np.searchsorted(rows.stop_node, walk.first + 1))
    for i in range(walk.first, walk.last):
        now = predict(model, inputs, body, i, point, place.posterior, tools)
        stop = add_stops(stop, i + 1, rows.stop_node, rows.stop_added, P)
        if walk.testing:
            kelvins, lapse = warmer(rows.known, i), rows.t[i + 1] - rows.t[i]
            follow_events(watch, kelvins, lapse, tools)
        known, before = settled(levels), iq + iw
        iq, iw = see(model, rows, walk, i + 1, iq, iw, now, known, carried, written, tools)
        if done[REASON] != END:
            report_loss(walk, float(rows.t[i + 1]), written)
            onsets.forget(watch)
            return i + 1
        if iq + iw == before or not walk.testing:
            continue
        gone = is_gone(point, place.posterior, sags)
        linear = walk.folding or walk.again or not gone
        t = float(rows.t[i + 1])
        if mended(model, t, now, known, linear, carried, written, tools):
            onsets.forget(watch)
            return i + 1
        if gone and walk.folding and not sags:
            fold(point, place, P)
            body = placed(model.body, point)
        elif gone and not walk.again and (walk.folding or i + 1 >= walk.stop_at):
            done[REASON] = MOVED
            return i + 1
    return walk.last


@kernel
def run_filter(
    model: Model, rows: Rows, walk: Walk, point: Floats, carried: Carried, written: Written
) -> int:
    """Filter rows; return the node reached. ``point`` and what is carried come and go."""
    covariance = carried.place.covariance
    warms = rows.known[:, KNOWN_WARMTH].min() != rows.known[:, KNOWN_WARMTH].max()
    biased = rows.w_node.shape[0] > 0 or warms or coupled(covariance)
    tools = new_tools(biased, covariance.shape[0])
    written.done[REASON] = END
    take(covariance, tools.work.P)
    reached = walk_on(model, rows, walk, point, carried, written, tools)
    give(tools.work.P, covariance)
    return reached
