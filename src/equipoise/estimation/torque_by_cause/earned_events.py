"""Which events of an estimate stand out from a torque that wanders.

An identification finds an event where its terms explain a record worse than a jump does. Jumps
explain a torque that wanders, too: with two or three of them what is left looks still, and all
intervals are too short. Here the Gauss-Markov torque acts in any case, with an event as large as it
is then, without it as large as the record wants it instead:

    the event stays if   max_(s, T) p(rows | s, T, event)  >  max_(s, T) p(rows | s, T)

Both are integrated over all other unknowns, among them the event's size, whose prior is as wide as
events are. Those that earn nothing go one by one, the least likely first.

Cannot tell a weak touch from a gust: it counts as air, whose band is then wider.
"""

import numpy as np

from equipoise.estimation.torque_by_cause.gauss_markov import Chain
from equipoise.estimation.torque_by_cause.process_sizes import least_improbability

NONE = np.zeros(0, dtype=np.int64)


def earned(chain: Chain) -> Chain:
    """Return the chain without the events that do not stand out from an unmodelled torque."""
    there = [k for k, changed in enumerate(chain.events) if len(changed)]
    if not there:
        return chain
    best = least_improbability(chain)
    while there:
        trials = [without(chain, k) for k in there]
        worths = [least_improbability(trial) for trial in trials]
        k = int(np.argmin(worths))
        if worths[k] >= best:
            break
        chain, best = trials[k], worths[k]
        del there[k]
    return chain


def without(chain: Chain, k: int) -> Chain:
    """Return the chain with nothing that jumps at cut k."""
    return chain._replace(events=(*chain.events[:k], NONE, *chain.events[k + 1 :]))
