"""Events in their place: moved to the moment that explains most, merged, taken back at need."""

from dataclasses import replace

import numpy as np

from equipoise.estimation.believed_model import (
    Believed,
    Happening,
    refitted,
    slowest,
    smoothed,
)
from equipoise.estimation.event_moments import FARTHEST, later, rows_of, timed
from equipoise.estimation.event_price import KINDS, threshold
from equipoise.model.arrays import Floats

NEAR = 1.6  # spacings, chosen: with process noise, events nearer than this may be one
FAR = (-1.5, -1.0, -0.5, 0.5, 1.0, 1.5)  # of the time within which a swing turns by a radian
DOUBTFUL = 4.0  # thresholds, chosen: an event so sure is not put to the test


def of_either_kind(belief: Believed, k: int) -> Believed:
    """Return the belief with one event of the kind, and at the moment, that explain most."""
    event, models = belief.events[k], list[Believed]()
    for kind in KINDS:
        events = (*belief.events[:k], Happening(event.t, kind), *belief.events[k + 1 :])
        models.append(timed(refitted(replace(belief, events=events)), k))
    return min(models, key=lambda model: model.fitted.at.cost)


def alone(belief: Believed, keep: int, drop: int) -> Believed:
    """Return the belief without one event, another in the place that is then best for it."""
    events = belief.events[:drop] + belief.events[drop + 1 :]
    return of_either_kind(replace(belief, events=events), keep - (drop < keep))


def merged(belief: Believed) -> Believed:
    """Return the belief with neighbouring events as one, where one explains as much as two.

    A touch between two cuts first shows as an event at either; one that was put at a wrong moment
    draws another near, which mends that.
    """
    reach = (NEAR if belief.wanders else FARTHEST[False]) * belief.spacing
    belief = replace(belief, events=tuple(sorted(belief.events, key=lambda event: event.t)))
    k = 0
    while k + 1 < len(belief.events):
        if belief.events[k + 1].t - belief.events[k].t < reach:
            trials = [alone(belief, k, k + 1), alone(belief, k + 1, k)]
            one = min(trials, key=lambda trial: trial.fitted.at.cost)
            if 2 * (one.fitted.at.cost - belief.fitted.at.cost) < threshold(belief.spacing):
                belief, k = one, max(k - 1, 0)
                continue
        k += 1
    return belief


def surprises_of(belief: Believed) -> Floats:
    """Return the chi-square (of 3) with which each event differs from nothing."""
    fit, after = smoothed(belief)
    rows = rows_of(fit, belief.events)
    jump, spread = fit.jumps[rows, :3], after.jump_covariance[rows, :3, :3]
    return np.einsum("ka,ka->k", jump, np.linalg.solve(spread, jump[..., None])[..., 0])


def without(belief: Believed, k: int) -> Believed:
    """Return the belief without one event, all others where they are then best."""
    events = belief.events[:k] + belief.events[k + 1 :]
    return timed(refitted(replace(belief, events=events)))


def pruned(belief: Believed) -> Believed:
    """Return the belief without the events that do not earn their place.

    An event may owe its surprise to another at a wrong moment: those of doubt are judged by what is
    lost without them when all others have moved.
    """
    price = threshold(belief.spacing)
    while belief.events:
        worth = surprises_of(belief)
        doubtful = [k for k in np.argsort(worth) if worth[k] < DOUBTFUL * price]
        trials = (without(belief, k) for k in doubtful)
        lost = (t for t in trials if 2 * (t.fitted.at.cost - belief.fitted.at.cost) < price)
        simpler = next(lost, None)
        if simpler is None:
            break
        belief = simpler
    return belief


def relocated(belief: Believed, k: int) -> Believed:
    """Return the belief with one event within a swing of where it is, where it explains most.

    What explains it best may lie at several moments of a swing; Newton steps find the nearest.
    """
    row = np.arange(len(belief.events)) == k
    trials = [later(belief, share * slowest(belief) * row) for share in FAR]
    best = timed(min(trials, key=lambda trial: trial.fitted.at.cost))
    return min(belief, best, key=lambda model: model.fitted.at.cost)


def settled(belief: Believed) -> Believed:
    """Return the belief with its events in their place and none that is not needed."""
    if not belief.events:
        return belief
    belief = timed(merged(belief))
    if not belief.wanders:
        for k in range(len(belief.events)):
            belief = relocated(belief, k)
    return pruned(belief)
