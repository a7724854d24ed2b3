"""Passing the last rows again when the estimate has moved: the tracker's memory and its use.

While the inertia is uncertain, one linearisation will not do. The walk then keeps its rows from an
anchor on (an estimate with its covariance) and linearises about a point that stays, on which the
estimate leans. When the estimate has moved away, the point follows and the rows since the anchor
are passed again, from the same estimate there: Gauss-Newton steps of the least-squares
problem of anchor and rows. As each pass begins with the anchor's own covariance, every row counts
once. Passes come after windows that double, so that a row is passed some few times in all.

A contact bends the estimate away from the point, where the test for contacts does not hold. It is
then suspected only, and tested for again in a pass about the point where the estimate came to rest.
Where it is found the anchor follows, and the rest of the rows is passed.

Behind a gap the motion may be foreseen well enough about the first point, and not about a better
one: the attitude is then taken anew there in the pass, and the anchor follows, too. (Kept as it was
in the first pass, the information of the gap was up to 17 sd wrong.)

Once the shape of the inertia (all but its scale) is known, the anchor follows, and the covariance
is transported; with the inertia known, nothing is kept and the point follows the estimate.
"""

from copy import deepcopy
from dataclasses import dataclass, replace

import numpy as np

from equipoise.dynamics.regressor import SAG as FIRST
from equipoise.estimation.tracker.event_signatures import SUSPECT, Watch, new_watch
from equipoise.estimation.tracker.filter_kernel import run_filter
from equipoise.estimation.tracker.kernel_records import (
    ASTRAY,
    BROKEN,
    MOVED,
    REASON,
    TOUCHED,
    Carried,
    Model,
    Place,
    Walk,
    Written,
)
from equipoise.estimation.tracker.linearisation_point import (
    AT,
    STIFF,
    doubt,
    doubt_of_shape,
    linear_in,
    moved,
    nearer,
    transport,
    transport_sag,
)
from equipoise.estimation.tracker.measurements import Rows, followed_by, later
from equipoise.estimation.tracker.mixture import EVENT
from equipoise.estimation.tracker.noise_level import settled
from equipoise.estimation.tracker.stored_covariance import DRIFT
from equipoise.model.arrays import Floats

DOUBT = 0.015  # of a moment, chosen: where linearising once is good enough
SHAPE = 0.01  # of a moment, chosen: the same with the scale taken out
EDGE, LONGEST = 15.0, 239.0  # s between tests whether the anchor may follow; after which it must
EARLIEST, GROWTH = 4.0, 2.0  # s, and of the window: when rows may be passed again
PASSES, CLOSE = 3, 0.5  # at most; until the point moves by no more than this
LOUDER = 2.0  # of the variance of noise, chosen: well beyond what it wanders by
TINY = 1e-9
MOST_EVENTS = 64  # that one call reports
BODY = slice(AT, AT + STIFF)  # r and J in an estimate written as one array
TORQUES = slice(FIRST, FIRST + 5)  # of a sag among the coefficients of torques
ERRORS = slice(6, 15)  # and in the error state


@dataclass(frozen=True, slots=True, eq=False)
class Memory:
    """What the tracker keeps beside its estimate."""

    anchor: Place
    rows: Rows  # since the anchor
    point: Floats  # (9,) r and J about which it linearises; (14,) with a sag
    passed: float  # s, the window that was last passed again
    level: Floats  # (2,) of the noise at that time
    levels: Floats  # (2, 2) of the noise: share of the stated variance, rows counted
    watch: Watch
    keeping: bool  # rows


def first_memory(here: Place, rows: Rows) -> Memory:
    """Return the memory of a tracker that begins with these rows."""
    levels = np.array([[1.0, 0.0], [1.0, 0.0]])
    return Memory(here.copy(), rows, linear_in(here.posterior), 0.0, levels[:, 0].copy(), levels,
                  new_watch(len(here.covariance)), True)  # fmt: skip


def copied(memory: Memory) -> Memory:
    """Return a memory that can be written on."""
    watch = deepcopy(memory.watch)
    return replace(memory, point=memory.point.copy(), levels=memory.levels.copy(), watch=watch)


def anchored(memory: Memory, here: Place, node: int) -> Memory:
    """Return the memory with its anchor here, at a node; transports the covariance."""
    target, new = here.posterior.copy(), nearer(memory.point, linear_in(here.posterior))
    target[BODY] = new[:STIFF]
    if len(new) > STIFF:
        transport_sag(here.covariance, memory.point, new)
    transport(here.covariance, memory.point, target)
    keeping = doubt(memory.point, here.covariance) > DOUBT or not settled(memory.levels)
    rows, level = later(memory.rows, node), memory.levels[:, 0].copy()
    return replace(memory, anchor=here.copy(), rows=rows, passed=0.0, level=level, keeping=keeping)


def without(anchor: Place, here: Place) -> Place:
    """Return a place that knows of the body what the anchor did: rows since have misled it.

    Of r, J, v and k, and of a sag.
    """
    found = here.copy()
    misled = np.r_[BODY, AT + 12 : len(found.posterior)]
    in_errors = np.r_[ERRORS, DRIFT : len(found.covariance)]
    found.posterior[misled] = anchor.posterior[misled]
    found.covariance[in_errors] = found.covariance[:, in_errors] = 0.0
    block = np.ix_(in_errors, in_errors)
    found.covariance[block] = anchor.covariance[block]
    return found


def sagging(model: Model, point: Floats) -> Model:
    """Return the model with the sag of a point, if it has any, among the known torques."""
    if len(point) == STIFF:
        return model
    torque = list(model.body.torque)
    torque[TORQUES] = map(float, point[STIFF:])
    return model._replace(body=model.body._replace(torqued=True, torque=tuple(torque)))


def passed(
    model: Model, memory: Memory, point: Floats, node: int, testing: bool, written: Written
) -> tuple[Place, int]:
    """Return the place after a pass from the anchor up to a node, and the node reached."""
    found, silent = memory.anchor.copy(), Written(np.zeros((0, 0)), written.events, written.done)
    walk = Walk(0, node, node, False, True, testing)
    carried = Carried(found, memory.levels, memory.watch)
    bent = sagging(model, point)
    return found, run_filter(bent, memory.rows, walk, point, carried, silent)


def pass_again(
    model: Model, memory: Memory, here: Place, node: int, written: Written
) -> tuple[Memory, Place, int]:
    """Return memory, place and node after passes of the rows up to a node.

    They are as they were if that fails; behind a row at which the attitude is taken anew, the
    anchor follows to that row first. Where a contact was suspected on the way, which may have been
    for want of linearity, it is tested for once more about the point that was found.
    """
    point, found = memory.point.copy(), here
    for _ in range(PASSES):
        point = nearer(point, linear_in(found.posterior))
        found, reached = passed(model, memory, point, node, False, written)
        if written.done[REASON] == BROKEN:
            memory = anchored(replace(memory, point=point), found, reached)
            return pass_again(model, memory, here, node - reached, written)
        if reached < node or not np.all(np.isfinite(found.posterior)):
            point, found = memory.point, here
            break
        if moved(point, found.posterior) < CLOSE:
            break
    age = float(memory.rows.t[node] - memory.rows.t[0])
    level = memory.levels[:, 0].copy()
    suspected = bool(memory.watch.counts[SUSPECT]) and moved(point, found.posterior) < CLOSE
    memory.watch.counts[: SUSPECT + (1 if suspected else 0)] = 0
    memory = replace(memory, point=point, passed=age, level=level)
    return refine(model, memory, found, node, written) if suspected else (memory, found, node)


def refine(
    model: Model, memory: Memory, here: Place, node: int, written: Written
) -> tuple[Memory, Place, int]:
    """Return memory, place and node after a pass that ends at a contact, and passes of the rest."""
    found, reached = passed(model, memory, memory.point.copy(), node, True, written)
    if written.done[REASON] != TOUCHED:
        return memory, here, node
    memory = anchored(memory, found, reached)
    memory.watch.counts[SUSPECT] = 1
    return pass_again(model, memory, found, node - reached, written)


def advance(
    model: Model, memory: Memory, here: Place, node: int, written: Written
) -> tuple[Memory, Place, int]:
    """Walk until something is to be done or the rows end, and do it."""
    rows, keeping = memory.rows, memory.keeping
    last, start = len(rows.t) - 1, float(rows.t[0])
    edge, measurement, due = last, last, float(np.inf)
    if keeping:
        whole = int((float(rows.t[node]) - start) / EDGE + TINY)
        due = start + EDGE * (whole + 1) - TINY
        edge = min(int(np.searchsorted(rows.t, due)), last)
        measurement = int(np.searchsorted(rows.t, start + max(EARLIEST, GROWTH * memory.passed)))
    walk = Walk(node, edge, measurement, not keeping, False, True)
    carried = Carried(here, memory.levels, memory.watch)
    bent = sagging(model, memory.point)
    node = run_filter(bent, rows, walk, memory.point, carried, written)
    if written.done[REASON] == ASTRAY and keeping:
        here = without(memory.anchor, here)
    followed = written.done[REASON] == MOVED and not keeping
    if followed or written.done[REASON] in (BROKEN, ASTRAY, TOUCHED):
        return anchored(memory, here, node), here, 0
    if written.done[REASON] == MOVED:
        memory, here, node = pass_again(model, memory, here, node, written)
    elif rows.t[node] >= due:
        return at_edge(model, memory, here, node, written)
    return memory, here, node


def at_edge(
    model: Model, memory: Memory, here: Place, node: int, written: Written
) -> tuple[Memory, Place, int]:
    """Pass the rows again if anything has changed, and let the anchor follow where it may."""
    grown = np.log(memory.levels[:, 0] / memory.level)
    if grown.max() > np.log(LOUDER):  # noise has been taken for motion: from the anchor's point
        memory, here, node = pass_again(model, memory, memory.anchor.copy(), node, written)
    elif grown.min() < -np.log(LOUDER) or moved(memory.point, here.posterior) > CLOSE:
        memory, here, node = pass_again(model, memory, here, node, written)
    shaped = doubt_of_shape(memory.point, here.covariance) < SHAPE and settled(memory.levels)
    if shaped or memory.rows.t[node] - memory.rows.t[0] > LONGEST:
        return anchored(memory, here, node), here, 0
    return memory, here, node


def follow(
    model: Model, memory: Memory | None, here: Place, fresh: Rows
) -> tuple[Memory, Place, Written]:
    """Return memory and place after fresh rows, and what was written on the way."""
    n = len(fresh.q) + len(fresh.w)
    wide = 1 + len(here.posterior) + len(here.covariance) + 1
    written = Written(np.zeros((n, wide)), np.zeros((MOST_EVENTS, EVENT)), np.zeros(3, np.int64))
    if memory is None:
        memory = first_memory(here, fresh)
    else:
        memory = replace(copied(memory), rows=followed_by(memory.rows, fresh))
    here, node = here.copy(), len(memory.rows.t) - len(fresh.t)
    while node < len(memory.rows.t) - 1:
        memory, here, node = advance(model, memory, here, node, written)
    if not memory.keeping:
        memory = replace(memory, rows=later(memory.rows, node))
    return memory, here, written
