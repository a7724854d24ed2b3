"""Which weights to put where, so that the centre of mass goes to its target.

With counts n of weights m at x and a platform of mass M and centre of mass r, loaded by n0,

    left(n) = (M r + mu(n) - mu(n0)) / (M + m(n) - m(n0)) - target            (added mass counts)
    minimise  sum |n - n0| + STRICT |left / spread|^2

over whole counts within stock and piles: as few weights in the person's hands as the error allows.
Two steps, as whole numbers on a lattice are hard and only the last few weights are about them:

1. the bulk, by a linear programme in real counts at the middle of each pile, rounded towards n0;
2. up to four weights more, on or off: every single one, every pair, and the best of pairs of pairs
   by a tree of what pairs do (the lightest kind, and whatever lies there already); again until
   nothing is won.

The answer is not proved to be the best. With weights of mass m on a grid of step s, it cannot be
nearer than half of m s / M along each axis: 0.9 um for 1 g, 25 mm and 14 kg.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy

from equipoise.actuators.placed_weights import load_of, refusal
from equipoise.model.arrays import Floats, Ints, Vector3
from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import Testbed
from equipoise.model.weights import places_of, rack_of

STRICT = 100.0  # weights, chosen: an error of a tenth of the spread is worth one weight handled
MISSED = 1e4  # weights a spread, chosen: the bulk comes as near as it can
ALIKE = 1e-3  # spreads, chosen: a hundredth of what a placing leaves
KEYS = np.array([1, 1_000_003, 1_000_003**2])  # primes: three whole numbers as one
ROUNDING = 1e-6  # weights, chosen: what the programme leaves of whole numbers
SHORTLIST = 20  # chosen: of each number of weights, compared exactly


@dataclass(frozen=True, slots=True, eq=False)
class Wanted:
    """Where the centre of mass is and where it should be."""

    body: MassProperties  # as it is loaded now
    loading: Ints
    target: Vector3  # m
    spread: Vector3  # m, the weight of each axis: tolerance and sd


class Actions(NamedTuple):
    """Single weights put on or taken off."""

    place: Ints
    kind: Ints
    way: Ints  # +1 on, -1 off
    lever: Floats  # (a, 3) in spreads


def left_by(testbed: Testbed, wanted: Wanted, loading: Ints) -> Vector3:
    """Return by how much a loading leaves the centre of mass off the target, m."""
    old, new, body = load_of(testbed, wanted.loading), load_of(testbed, loading), wanted.body
    moment = body.first_moment + new.first_moment - old.first_moment
    return moment / (body.mass + new.mass - old.mass) - wanted.target


def price(testbed: Testbed, wanted: Wanted, loading: Ints) -> float:
    """Return the cost of a loading, to be minimised."""
    left = left_by(testbed, wanted, loading) / wanted.spread
    return float(abs(loading - wanted.loading).sum() + STRICT * (left @ left))


def chosen(testbed: Testbed, wanted: Wanted) -> Ints:
    """Return the loading to request; ``left_by`` returns the offset that it leaves."""

    def cost(loading: Ints) -> float:
        return price(testbed, wanted, loading)

    best = min([wanted.loading, bulk_of(testbed, wanted)], key=cost)
    while True:
        around = [loading for loading in nearby(testbed, wanted, best)
                  if not refusal(testbed, loading)]  # fmt: skip
        better = min([best, *around], key=cost)
        if better is best:
            return best
        best = better


def bulk_of(testbed: Testbed, wanted: Wanted) -> Ints:
    """Return the loading of the linear programme, rounded towards the present one."""
    rack, weights, now = rack_of(testbed.grids), testbed.weights, wanted.loading
    room, mass = rack.capacity - now.sum(axis=1), np.array([w.mass for w in weights])
    half = np.outer(rack.capacity, [w.height for w in weights]) / 2
    lever = rack.foot[:, None] + half[..., None] * rack.up[:, None] - wanted.target
    unit = mass[:, None] / (wanted.body.mass * wanted.spread)
    gain = (lever * unit).reshape(-1, 3).T
    n, goal = now.size, (wanted.target - wanted.body.com) / wanted.spread
    cost = np.concatenate([np.ones(2 * n), np.full(6, MISSED)])
    balance = np.hstack([gain, -gain, np.eye(3), -np.eye(3)])
    of_pile = np.kron(np.eye(len(room)), np.ones(len(mass)))
    of_kind = np.tile(np.eye(len(mass)), len(room))
    limits = np.vstack([of_pile, of_kind])
    within = np.hstack([limits, -limits, np.zeros((len(limits), 6))])
    spare = np.array([weight.count for weight in weights]) - now.sum(axis=0)
    limit = [(0, None)] * n + [(0, float(c)) for c in now.ravel()] + [(0, None)] * 6
    answer = scipy.optimize.linprog(
        cost, within, np.append(room, spare), balance, goal, limit, "highs"
    )
    assert answer.x is not None  # to leave everything where it is, is always allowed
    change = answer.x[:n] - answer.x[n : 2 * n]
    whole = np.trunc(change + ROUNDING * np.sign(change))
    return now + whole.astype(np.int64).reshape(now.shape)


def actions_of(testbed: Testbed, wanted: Wanted, loading: Ints) -> Actions:
    """Return the single steps from a loading: the lightest kind left in stock on, any kind off."""
    weights = testbed.weights
    spare = np.array([weight.count for weight in weights]) - loading.sum(axis=0)
    mass = np.where(spare > 0, [weight.mass for weight in weights], np.inf)
    found: list[tuple[int, int, int, Floats]] = []
    for p, place in enumerate(places_of(testbed.grids)):
        counts, up = loading[p], place.up
        top = float(counts @ np.array([weight.height for weight in weights]))
        on = int(np.argmin(mass))
        if counts.sum() < place.grid.capacity and spare[on] > 0:
            middle = place.foot + (top + weights[on].height / 2) * up
            found.append((p, on, 1, weights[on].mass * (middle - wanted.target)))
        for j in np.flatnonzero(counts):
            middle = place.foot + (top - weights[j].height / 2) * up
            found.append((p, int(j), -1, weights[j].mass * (wanted.target - middle)))
    unit = wanted.body.mass * wanted.spread
    where = np.array([row[:3] for row in found], dtype=np.int64).reshape(-1, 3)
    lever = np.array([row[3] for row in found]).reshape(-1, 3) / unit
    return Actions(where[:, 0], where[:, 1], where[:, 2], lever)


def nearby(testbed: Testbed, wanted: Wanted, here: Ints) -> Iterator[Ints]:
    """Yield loadings up to four weights from one that come nearest to the target."""
    actions = actions_of(testbed, wanted, here)
    if not len(actions.way):
        return
    rest = -left_by(testbed, wanted, here) / wanted.spread
    for steps in nearest(actions.lever, rest):
        loading = here.copy()
        for step in steps:
            loading[actions.place[step], actions.kind[step]] += actions.way[step]
        yield loading


def nearest(lever: Floats, rest: Vector3) -> Iterator[list[int]]:
    """Yield the sets of one, two, three and four steps whose sums come nearest to ``rest``."""
    one, lever = unlike(np.arange(len(lever))[:, None], lever)
    two = np.array(np.triu_indices(len(lever))).T
    two, sums = unlike(one[two, 0], lever[two[:, 0]] + lever[two[:, 1]])
    for steps, reached in ((one, lever), (two, sums)):
        yield from best(steps, np.linalg.norm(reached - rest, axis=1))
    for others, reached in ((one, lever), (two, sums)):
        distances, which = scipy.spatial.KDTree(reached).query(rest - sums)
        yield from best(np.hstack([two, others[which]]), np.asarray(distances))


def unlike(steps: Ints, reached: Floats) -> tuple[Ints, Floats]:
    """Return the first of each of those that do the same: on a grid most have many twins."""
    key = np.rint(reached / ALIKE).astype(np.int64) @ KEYS
    first = np.sort(np.unique(key, return_index=True)[1])
    return steps[first], reached[first]


def best(steps: Ints, miss: Floats) -> Iterator[list[int]]:
    """Yield the sets that miss least."""
    for k in np.argsort(miss, kind="stable")[:SHORTLIST]:
        yield [int(step) for step in steps[k]]
