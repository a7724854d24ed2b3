"""Plan: the manoeuvre that tells most of what is asked for, whatever platform it is.

    minimise  score(mean_k C_k) + STIFF mean_k (excess of tilt and rate over their limits)_k

over ``choices``, C_k being the covariance of what is asked for and k platforms that may be there,
let go by a hand that errs (``scenario``), by differential evolution (Storn and Price 1997, of
SciPy), which needs no gradient. The same seed finds the same plan.

Finds a good manoeuvre, not the best: a second seed finds another that is as good within some
percent. Cannot see what ``predicted`` cannot see.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import Bounds, differential_evolution

from equipoise.design.choices import Space, chosen, plain_choice
from equipoise.design.criterion import NAMES, Asked, Criterion, score, size_of
from equipoise.design.predicted import Known
from equipoise.design.rehearsal import Peaks, for_search, peaks, rehearsal, started, told
from equipoise.design.scenario import Belief, Scenario, scenarios
from equipoise.estimation.trajectory import Params
from equipoise.model.arrays import Floats
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.testbed import Testbed

GUARD = 0.85  # of the tilt limit, chosen: as in ``procedure.foresight``
STIFF = 10.0  # chosen: a tenth beyond a limit costs as much as sd that are e times as wide
HOPELESS = 1.0  # chosen: an excess at which nothing else counts
NEAR = 0.12  # chosen: of what there is to choose from, about the plain choice
NOTHING = 20.0  # chosen: worse than any score, for what leaves the scale open
SCENARIOS = 6  # chosen: with four, other platforms were told a third worse than these
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

    @property
    def names(self) -> tuple[str, ...]:
        """Return what is asked for, by name; what is held is not sought."""
        return tuple(n for n in NAMES[self.wish.asked] if n not in self.wish.params.hold)


def search_for(space: Space, wish: Wish, seed: int) -> Search:
    """Return a search, its platforms drawn."""
    rng = np.random.default_rng(seed)
    drawn = scenarios(wish.belief, SCENARIOS, rng)
    return Search(space, for_search(space.testbed), wish, drawn)


def excess(space: Space, peak: Peaks) -> float:
    """Return by how much of themselves the limits are passed."""
    tilt = max(peak.tilt / (GUARD * space.tilt_limit) - 1, 0.0)
    return tilt + max(peak.rate / space.rate_limit - 1, 0.0)


def merit(search: Search, manoeuvre: Manoeuvre) -> float:
    """Return what is to be small of a manoeuvre."""
    wish, names = search.wish, search.names
    expected = search.scenarios[0]
    tried = rehearsal(search.testbed, expected, manoeuvre, wish.params, wish.known)
    if tried.problem.scale_open:
        return NOTHING
    truths = [started(tried, scenario) for scenario in search.scenarios]
    beyond = float(np.mean([excess(search.space, peaks(tried, truth)) for truth in truths]))
    if beyond > HOPELESS:
        return NOTHING + STIFF * beyond
    where = [tried.problem.layout.names.index(name) for name in names]
    size = size_of(wish.belief.body, names)
    each = [told(tried, truth, wish.known)[np.ix_(where, where)] for truth in truths]
    return score(np.mean(each, axis=0), size, wish.criterion) + STIFF * beyond


def silent(done: float) -> None:
    """Hear how far a search is, and say nothing."""


def first_tries(space: Space, count: int, rng: np.random.Generator) -> Floats:
    """Return the choices that a search begins with: half near the plain one, half anywhere."""
    anywhere = rng.random((count, space.size))
    near = plain_choice(space) + NEAR * rng.standard_normal((count // 2, space.size))
    anywhere[: count // 2] = np.clip(near, 0.0, 1.0)
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
