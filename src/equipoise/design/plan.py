"""Plan: the manoeuvre that tells most of what is asked for, whatever platform it is.

    minimise  score(mean_k C_k) + STIFF (excess of tilt and rate over their limits)

over ``choices``, C_k being the covariance of what is asked for and k platforms that may be there,
let go by a hand that errs (``scenario``), by differential evolution (Storn and Price 1997, of
SciPy), which needs no gradient. The same seed finds the same plan.

A limit is to be kept by mean + ``SIGMAS`` sd of the peaks of many more such platforms: a search
finds the gaps between those that it is told of, and only a margin keeps the others within.

Finds a good manoeuvre, not the best: a second seed finds another that is as good within some
percent. Peaks have a longer tail than a normal distribution: ``promise`` counts how many platforms
keep the limit. Cannot see what ``predicted`` cannot see.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import Bounds, differential_evolution

from equipoise.design.choices import SPIN, Space, calm_choice, chosen, plain_choice
from equipoise.design.criterion import NAMES, Asked, Criterion, score, size_of
from equipoise.design.predicted import Known
from equipoise.design.rehearsal import (
    Peaks,
    Rehearsal,
    for_search,
    peaks,
    rehearsal,
    started,
    told,
)
from equipoise.design.scenario import Belief, Scenario, scenarios
from equipoise.estimation.trajectory import Params
from equipoise.model.arrays import Floats
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.testbed import Testbed

SIGMAS = 3.0  # chosen: of normal peaks one in 740 is beyond
STIFF = 30.0  # chosen: a thirtieth beyond a limit costs as much as sd that are e times as wide
HOPELESS = 1.0  # chosen: an excess at which nothing else counts
NEAR = 0.12  # chosen: of what there is to choose from, about the plain choice
NOTHING = 20.0  # chosen: worse than any score, for what leaves the scale open
SCENARIOS = 6  # chosen: with four, other platforms were told a third worse than these
FIRST, GUARDED = 24, 96  # chosen: platforms whose peaks are looked at, the others if these keep to
# the limits; with 24 alone, 6 % of other platforms passed them
CALMEST = 0.1  # chosen: of the way to the plain choice and what lies about it
SPUN = 0.7  # chosen: of the greatest rate, the greatest spin of a first try; the hand errs
POPULATION = 4  # chosen: manoeuvres tried at once, by number of a choice
TRIALS = 2400  # chosen: some half a minute for sputnix on one core of its own


@dataclass(frozen=True, slots=True, eq=False)
class Wish:
    """What is asked for, and what is known."""

    asked: Asked
    criterion: Criterion
    params: Params
    belief: Belief
    known: Known | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Search:
    """What does not change while manoeuvres are tried."""

    space: Space
    testbed: Testbed  # as for a search
    wish: Wish
    scenarios: list[Scenario]
    guarded: list[Scenario]  # whose limits are to be kept

    @property
    def names(self) -> tuple[str, ...]:
        """Return what is asked for, by name; what is held is not sought."""
        return tuple(n for n in NAMES[self.wish.asked] if n not in self.wish.params.hold)


def search_for(space: Space, wish: Wish, seed: int) -> Search:
    """Return a search, its platforms drawn."""
    rng = np.random.default_rng(seed)
    drawn = scenarios(wish.belief, SCENARIOS, rng)
    guarded = scenarios(wish.belief, GUARDED + 1, rng)[1:]
    return Search(space, for_search(space.testbed), wish, drawn, guarded)


def excess(space: Space, found: Sequence[Peaks]) -> float:
    """Return by how much of themselves the limits are passed, with a margin."""
    limits = np.array([space.tilt_limit, space.rate_limit])
    peak = np.array(found)
    guarded = peak.mean(axis=0) + SIGMAS * peak.std(axis=0, ddof=1)
    return float(np.sum(np.maximum(guarded / limits - 1, 0.0)))


def excess_of(search: Search, tried: Rehearsal) -> float:
    """Return the excess over the first platforms, and over all where these keep to the limits."""
    found = [peaks(tried, started(tried, scenario)) for scenario in search.guarded[:FIRST]]
    beyond = excess(search.space, found)
    if beyond > 0:
        return beyond
    found += [peaks(tried, started(tried, scenario)) for scenario in search.guarded[FIRST:]]
    return excess(search.space, found)


def merit(search: Search, manoeuvre: Manoeuvre) -> float:
    """Return what is to be small of a manoeuvre."""
    wish, names = search.wish, search.names
    expected = search.scenarios[0]
    tried = rehearsal(search.testbed, expected, manoeuvre, wish.params, wish.known)
    if tried.problem.scale_open:
        return NOTHING
    beyond = excess_of(search, tried)
    if beyond > HOPELESS:
        return NOTHING + STIFF * beyond
    truths = [started(tried, scenario) for scenario in search.scenarios]
    where = [tried.problem.layout.names.index(name) for name in names]
    size = size_of(wish.belief.body, names)
    each = [told(tried, truth, wish.known)[np.ix_(where, where)] for truth in truths]
    return score(np.mean(each, axis=0), size, wish.criterion) + STIFF * beyond


def silent(done: float) -> None:
    """Hear how far a search is, and say nothing."""


def first_tries(space: Space, count: int, rng: np.random.Generator) -> Floats:
    """Return the choices that a search begins with: half near the plain one, half anywhere.

    Those near are calmed to various degrees, so that some keep the limits, and spin either way:
    little is known of the moment about the vertical without it, and a spin tilts nothing.
    """
    anywhere, half = rng.random((count, space.size)), count // 2
    plain, calm = plain_choice(space), calm_choice(space)
    off = plain - calm + NEAR * rng.standard_normal((half, space.size))
    near = calm + rng.uniform(CALMEST, 1.0, (half, 1)) * off
    near[:, SPIN] = 0.5 + 0.5 * rng.uniform(-SPUN, SPUN, half)
    anywhere[:half] = np.clip(near, 0.0, 1.0)
    anywhere[0] = plain_choice(space)
    return anywhere


def planned(
    space: Space,
    wish: Wish,
    seed: int,
    trials: int = TRIALS,
    tell: Callable[[float], None] = silent,
) -> Manoeuvre:
    """Return the best manoeuvre found; ``tell`` hears what share of the search is done."""
    search, done = search_for(space, wish, seed), [0]
    at_once = POPULATION * space.size
    generations = max(trials // at_once - 1, 1)

    def worth(numbers: Floats) -> float:
        return merit(search, chosen(space, numbers))

    def after(*_: object) -> None:
        done[0] += 1
        tell(done[0] / generations)

    found = differential_evolution(
        worth,
        Bounds(np.zeros(space.size), np.ones(space.size)),
        popsize=POPULATION,
        maxiter=generations,
        init=first_tries(space, at_once, np.random.default_rng(seed)),
        polish=False,
        seed=seed,
        callback=after,
    )
    return chosen(space, found.x)
