"""The tracker's walk along its rows, compiled: predict, correct by a row, test for contacts.

The walk ends early where the estimate has moved away from the point of linearisation, or where a
contact was corrected or the attitude taken anew: the caller then decides from where to go on.
"""

import numpy as np

from equipoise.dynamics.propagation import step
from equipoise.dynamics.rigid_body import Body, Now, body_at, rate_of
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
from equipoise.estimation.tracker.linearisation_point import distance, transport
from equipoise.estimation.tracker.measurement_update import by_attitude, by_rate
from equipoise.estimation.tracker.measurements import Rows
from equipoise.estimation.tracker.mixture import mend, report
from equipoise.estimation.tracker.noise_level import settled
from equipoise.estimation.tracker.predict_correct import (
    add_stops,
    apply,
    begin,
    lean,
    note,
    placed,
    predict_covariance,
    transition,
    unit_columns,
)
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.model.arrays import Floats


@part
def predict(
    model: Model, rows: Rows, body: Body, i: int, point: Floats, place: Place, tools: Tools
) -> Now:
    """Take estimate and covariance over step i; return the platform at its end."""
    moving, end = tools.moving, place.posterior
    y, regress, phi, t = moving.y, moving.step.regress, moving.phi, rows.t
    inputs = Inputs(model.maps, t, rows.known, rows.owners, model.columns)
    now = body_at(body, model.maps, t, rows.known, i, 0.0)
    begin(now, end, y)
    unit_columns(now, rate_of(now, y), regress, y)
    step(body, inputs, i, y, moving.step)
    now = body_at(body, model.maps, t, rows.known, i, 1.0)
    transition(now, body.mass, y, regress, phi)
    predict_covariance(
        body.inertia, phi, model.walks, t[i + 1] - t[i], place.covariance, tools.work.A
    )
    lean(now, phi, point, y, end)
    begin(now, end, y)
    return now


@part
def noted(t: float, surprise: float, place: Place, written: Written) -> None:
    """Write a row down."""
    done = written.done
    note(t, place.posterior, place.covariance, surprise, written.out[done[NOTED]])
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
            noted(t, surprise, place, written)
    if iw < rows.w_node.shape[0] and rows.w_node[iw] == node:
        surprise = by_rate(model, rows, iw, now, known, walk, carried, tools)
        begin(now, place.posterior, y)
        iw += 1
        if not walk.again:
            noted(t, surprise, place, written)
    return iq, iw


@part
def touched(model: Model, now: Now, carried: Carried, written: Written, tools: Tools) -> bool:
    """Test for a contact; correct the estimate if there was one."""
    work, room, place, done = tools.work, tools.room, carried.place, written.done
    kind, best = judged(carried.watch, model.alarm, room)
    if kind < 0:
        return False
    mend(carried.watch, place.covariance, work.x, room)
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


@kernel
def run_filter(
    model: Model, rows: Rows, walk: Walk, point: Floats, carried: Carried, written: Written
) -> int:
    """Filter rows; return the node reached. ``point`` and what is carried come and go."""
    place, levels, watch, done = carried.place, carried.levels, carried.watch, written.done
    tools = new_tools()
    body = placed(model.body, point)
    iq = int(np.searchsorted(rows.q_node, walk.first + 1))
    iw = int(np.searchsorted(rows.w_node, walk.first + 1))
    stop = int(np.searchsorted(rows.stop_node, walk.first + 1))
    done[REASON] = END
    for i in range(walk.first, walk.last):
        now = predict(model, rows, body, i, point, place, tools)
        stop = add_stops(stop, i + 1, rows.stop_node, rows.stop_added, place.covariance)
        if walk.testing:
            onsets.follow(watch, tools.moving.phi, tools.room)
        known, before = settled(levels), iq + iw
        iq, iw = see(model, rows, walk, i + 1, iq, iw, now, known, carried, written, tools)
        if done[REASON] != END:
            report_loss(walk, float(rows.t[i + 1]), written)
            onsets.forget(watch)
            return i + 1
        if iq + iw == before or not walk.testing:
            continue
        gone = distance(point, place.posterior) > 1.0
        linear = walk.folding or walk.again or not gone
        t = float(rows.t[i + 1])
        if mended(model, t, now, known, linear, carried, written, tools):
            onsets.forget(watch)
            return i + 1
        if gone and walk.folding:
            transport(place.covariance, point, place.posterior)
            body = placed(model.body, point)
        elif gone and not walk.again and i + 1 >= walk.stop_at:
            done[REASON] = MOVED
            return i + 1
    return walk.last
