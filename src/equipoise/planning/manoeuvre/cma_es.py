"""The least of a rough function of numbers between 0 and 1, by evolutions side by side.

Covariance matrix adaptation (CMA-ES; Hansen, "The CMA evolution strategy: a tutorial", 2016; the
package ``cmaes``) needs no gradient and learns which numbers belong together. It finds the valley
that it begins in. So

    1. all first choices are tried,
    2. from each of the best few an evolution begins,
    3. and when each has had its share of the trials, the best of those that have not settled
       goes on.

The same seed finds the same. There may be a better minimum elsewhere.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from cmaes import CMA

from equipoise.model.arrays import Floats

SIDE_BY_SIDE = 4  # chosen: of the best first choices, the best is seldom the one that ends best
SHARE = 0.1  # of all trials, chosen: for each before the best goes on
WIDTH = 0.08  # chosen: sd of first steps; at 0.2 the merit of a first choice was lost


Worths = Callable[[Sequence[Floats]], Iterable[float]]  # of choices that do not rest on each other


class Tried(NamedTuple):
    """A choice and what it is worth, the less the better."""

    worth: float
    numbers: Floats


@dataclass(slots=True)
class Evolution:
    """One evolution: its state, which moves on, and the best that it has met."""

    strategy: CMA
    best: Tried
    trials: int = 0

    @property
    def settled(self) -> bool:
        """Say whether it would find nothing more."""
        return self.strategy.should_stop()

    def go_on(self, worths: Worths) -> int:
        """Try one generation, and return how many trials that took."""
        requested = [self.strategy.ask() for _ in range(self.strategy.population_size)]
        tried = list(map(Tried, worths(requested), requested))
        self.strategy.tell([(each.numbers, each.worth) for each in tried])
        self.best = min(self.best, *tried, key=lambda each: each.worth)
        self.trials += len(tried)
        return len(tried)


def begun(first: Tried, seed: int) -> Evolution:
    """Return an evolution that begins at a choice."""
    bounds = np.tile([0.0, 1.0], (len(first.numbers), 1))
    return Evolution(CMA(first.numbers, WIDTH, bounds=bounds, seed=seed), first)


def least(
    worths: Worths,
    first: Sequence[Floats],
    trials: int,
    seed: int,
    on_progress: Callable[[float], None],
) -> Floats:
    """Return the best numbers found; ``on_progress`` receives the completed share of the trials."""
    tried: list[Tried] = []
    for each in map(Tried, worths(first), first):
        tried.append(each)
        on_progress(len(tried) / max(trials, len(first)))
    tried.sort(key=lambda each: each.worth)
    running = [begun(each, seed + k) for k, each in enumerate(tried[:SIDE_BY_SIDE])]
    done = len(tried)
    while done < trials and (going := [each for each in running if not each.settled]):
        young = [each for each in going if each.trials < SHARE * trials]
        done += (young or [best_of(going)])[0].go_on(worths)
        on_progress(min(done / trials, 1.0))
    return best_of(running).best.numbers


def best_of(evolutions: Sequence[Evolution]) -> Evolution:
    """Return the evolution that has met the best choice."""
    return min(evolutions, key=lambda each: each.best.worth)
