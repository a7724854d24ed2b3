"""Events in their place: moved to the moment that explains most, merged, taken back at need."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from equipoise.actuators.travel_times import merged_travels
from equipoise.estimation.events.event_times import later, rows_of, timed
from equipoise.estimation.events.jump_test import KINDS, threshold
from equipoise.estimation.events.record_model import (
    Happening,
    RecordModel,
    farther,
    nearest,
    refitted,
    slowest,
)
from equipoise.estimation.output_error.problem import track_of
from equipoise.estimation.output_error.solution import smooth_at
from equipoise.estimation.search_budget import Stage
from equipoise.maths.attitude import tilt
from equipoise.maths.whiteness import spectral_peak
from equipoise.model.arrays import Floats

NEAR = 1.6  # spacings, chosen: with process noise, events nearer than this may be one
CLEAR = 9.0  # chosen: 2 ln of how much likelier one kind is than another, to be decided
OUTLYING = (-1.5, -1.0, -0.5, 0.5, 1.0, 1.5)  # of the time within which a swing turns by a radian
SWINGS = 3.0  # of the same time, chosen: without process noise, events nearer than this may be one
SHORT = 0.1  # of the farthest travel, chosen: less gives no scale beside it
PUSH = "impulse"  # what a stop does
DOUBTFUL = 4.0  # thresholds, chosen: an event so sure is not put to the test


def with_kind(model: RecordModel, k: int, kind: str) -> RecordModel:
    """Return the model with one event of that kind."""
    event = Happening(model.events[k].t, kind)
    return refitted(replace(model, events=(*model.events[:k], event, *model.events[k + 1 :])))


def of_either_kind(model: RecordModel, k: int) -> RecordModel:
    """Return the model with one event of the kind, and at the moment, that explain most."""
    models = [timed(with_kind(model, k, kind), k) for kind in KINDS]
    return nearest(models)


def spans_of_travels(model: RecordModel) -> list[tuple[float, float]]:
    """Return from when to when masses travelled far, s, each by a cut's spacing longer."""
    track = track_of(model.recording, model.testbed)
    if track is None or len(track) < 2:
        return []
    columns = zip(track.values.T, model.testbed.masses, strict=True)
    ways = [
        (abs(d[last] - d[first]) * mass.mass, track.t[first], track.t[last])
        for d, mass in columns
        for first, last in merged_travels(track.t, d, mass.speed)
    ]
    most = max((way for way, _, _ in ways), default=0.0)
    margin = model.spacing
    return [(float(a - margin), float(b + margin)) for way, a, b in ways if way > SHORT * most]


def during_travels(model: RecordModel, times: Sequence[float]) -> list[bool]:
    """Say of each time (s) whether masses travel far then, or within a cut's spacing of it."""
    spans = spans_of_travels(model)
    return [any(start <= t <= end for start, end in spans) for t in times]


def without_sure_travel(model: RecordModel) -> bool:
    """Say whether masses travel, but never far without an event."""
    spans, times = spans_of_travels(model), [event.t for event in model.events]
    return bool(spans) and all(any(a <= t <= b for t in times) for a, b in spans)


def is_at_stop(model: RecordModel, t: float) -> bool:
    """Say whether a camera shows the platform at its stop within a cut's spacing of ``t`` (s)."""
    rows = model.recording.attitude
    if rows is None:
        return False
    near = rows.where(np.abs(rows.t - t) <= model.spacing)
    return bool(np.any(tilt(near.values, model.testbed.up) > model.testbed.tilt_at_stop))


def doubted(model: RecordModel) -> RecordModel:
    """Return the model with all that may jump at events that may as well be of another kind.

    Without a swing behind them a contact and a part that shifts are alike in the rows; what follows
    for the centre of mass is not. While masses travel an event may be of the travel: what shifts
    then may be any part of what was recorded, and the scale is as open as that leaves it. Where the
    platform is at its stop, that is what pushes it, unless a part that shifts is clearly likelier.
    """
    travelling = during_travels(model, [event.t for event in model.events])
    for k, event in enumerate(model.events):
        if not model.may(Stage.EVENTS):
            break
        at_stop = is_at_stop(model, event.t)
        if at_stop and event.kind == PUSH:
            continue
        others = [other for other in KINDS if other != event.kind]
        models = [timed(with_kind(model, k, other), k) for other in others]
        rival = nearest(models)
        close = farther(rival, model) < CLEAR
        if at_stop:
            model = rival if close else model
        elif close or travelling[k]:
            open_to = replace(event, unclear=True, aside=rival.events[k].t - event.t)
            events = (*model.events[:k], open_to, *model.events[k + 1 :])
            model = replace(model, events=events)
    return refitted(model) if any(event.unclear for event in model.events) else model


def joined(model: RecordModel, k: int) -> RecordModel:
    """Return the model with one event for two neighbours, of the kind and moment that are best."""
    one, two = model.events[k : k + 2]
    models: list[RecordModel] = []
    for t in (one.t, 0.5 * (one.t + two.t), two.t):
        events = (*model.events[:k], replace(one, t=t), *model.events[k + 2 :])
        either = [with_kind(replace(model, events=events), k, kind) for kind in KINDS]
        models.append(timed(nearest(either), k))
    return timed(nearest(models))


def merged(model: RecordModel) -> RecordModel:
    """Return the model with neighbouring events as one, where one explains as much as two.

    A touch between two cuts first shows as an event at either; one that was put at a wrong moment
    draws another near, which mends that.
    """
    reach = NEAR * model.spacing if model.wanders else SWINGS * slowest(model)
    model = replace(model, events=tuple(sorted(model.events, key=lambda event: event.t)))
    k = 0
    while k + 1 < len(model.events) and model.may(Stage.EVENTS):
        if model.events[k + 1].t - model.events[k].t < reach:
            one = joined(model, k)
            if farther(one, model) < threshold(model.spacing):
                model, k = one, max(k - 1, 0)
                continue
        k += 1
    return model


def surprises_of(model: RecordModel) -> Floats:
    """Return the chi-square (of 3) with which each event differs from nothing."""
    fit, after = model.fitted, smooth_at(model.fitted)
    rows = rows_of(fit, model.events)
    jump, spread = fit.jumps[rows, :3], after.jump_covariance[rows, :3, :3]
    return np.einsum("ka,ka->k", jump, np.linalg.solve(spread, jump[..., None])[..., 0])


def colour_of(model: RecordModel) -> float:
    """Return the peak of the spectral density of what is left, over its mean."""
    at = model.fitted.at
    return max(spectral_peak(left) for left in (at.left_q, at.left_w))


def without(model: RecordModel, k: int) -> RecordModel:
    """Return the model without one event, all others where they are then best."""
    events = model.events[:k] + model.events[k + 1 :]
    return timed(refitted(replace(model, events=events)))


def pruned(model: RecordModel, colour: float = 1.0) -> RecordModel:
    """Return the model without the events that do not earn their place.

    An event may owe its surprise to another at a wrong moment: those of doubt are judged by what is
    lost without them when all others have moved. Where what is left is not white, a surprise by
    chance is greater: at most by its ``colour``, the peak of its spectral density.
    """
    price = threshold(model.spacing) * colour
    while model.events and model.may(Stage.EVENTS):
        worth = surprises_of(model)
        doubtful = [k for k in np.argsort(worth) if worth[k] < DOUBTFUL * price]
        trials = (without(model, k) for k in doubtful)
        lost = (t for t in trials if farther(t, model) < price)
        simpler = next(lost, None)
        if simpler is None:
            break
        model = simpler
    return model


def relocated(model: RecordModel, k: int) -> RecordModel:
    """Return the model with one event within a swing of where it is, as what explains most.

    What explains it best may lie at several moments of a swing; Newton steps find the nearest. A
    part that shifts bends the swing behind it as a touch half a swing before or later would.
    """
    row = np.arange(len(model.events)) == k
    moved = [later(model, share * slowest(model) * row) for share in OUTLYING]
    trials = [with_kind(one, k, kind) for one in moved for kind in KINDS]
    best = timed(nearest(trials))
    return nearest([model, best])


def settled(model: RecordModel) -> RecordModel:
    """Return the model with its events in their place and none that is not needed."""
    if not model.events:
        return model
    model = timed(merged(model))
    if not model.wanders:
        for k in range(len(model.events)):
            if not model.may(Stage.EVENTS):
                break
            model = relocated(model, k)
    return pruned(model)
