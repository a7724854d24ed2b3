"""Whether terms that nobody declared act: the models of a record with each of them and without.

An identification adds a term where that explains a record. A torque that wanders is explained by
terms, too, for as long as a record lasts; with them the Gauss-Markov torque looks small, and all
intervals are too short. So a group of terms that the testbed does not declare acts or does not:

    p(x | rows) ~ sum over groups that act of  p(x | rows, groups) p(rows | groups) p(groups)

Each acts at odds of one to all others before the record is seen: whichever of them resembles the
torque best was found by trying them all.

A term that does not act is known to be zero: its prior is a thousandth of what benches have. All
else that is unknown is integrated out, the size of the unmodelled torque included.

Cannot tell a term from a torque that wanders alike: both then have their share.
"""

from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.parameters.fit_parameters import physical
from equipoise.estimation.torque_by_cause.gauss_markov import Chain
from equipoise.estimation.torque_by_cause.process_sizes import least_improbability
from equipoise.model.arrays import Floats, Ints
from equipoise.model.torque_terms import GROUPS

NOTHING = 1e-3  # of what benches have, chosen: a term that does not act
ODDS = 1.0 / (len(GROUPS) - 1)  # chosen: of all groups one acts that nobody declared
COUNTS = 9.2  # of -2 ln, chosen: a model a hundred times less probable is left out
CONSTANT = "constant"  # the terms whose coordinates in the chain stand behind all others


class Doubted(NamedTuple):
    """Terms that act together or not at all: coordinates of the chain, and values of a point."""

    where: Ints
    at: Floats


def doubted(fitted: Fitted, chain: Chain, declared: Sequence[str]) -> tuple[Doubted, ...]:
    """Return the groups of terms of a fit that nobody declared."""
    layout = fitted.problem.layout
    at = physical(fitted.point, fitted.problem.mass, layout)
    found = list[Doubted]()
    for group, terms in GROUPS.items():
        own = [t for t in terms if t in layout.terms and t not in declared]
        where = np.array([layout.names.index(t) for t in own], dtype=np.int64)
        values = at[where]
        if group == CONSTANT:  # of which the layout's are the carrier's
            where = np.arange(layout.size, len(chain.prior)) if own else where[:0]
            values = np.zeros(len(where))
        if len(where):
            found.append(Doubted(where, values))
    return tuple(found)


def alternatives(chain: Chain, groups: Sequence[Doubted]) -> tuple[Chain, ...]:
    """Return the chains with and without each group of terms, as far as they are probable."""
    if not groups:
        return (chain,)
    chains = list[Chain]()
    for count in range(len(groups) + 1):
        for left in combinations(groups, count):
            model = chain
            for group in left:
                model = without(model, group)
            chains.append(model)
    worths = np.array([least_improbability(each) for each in chains])
    return tuple(chains[k] for k in np.flatnonzero(worths <= worths.min() + COUNTS))


def without(chain: Chain, group: Doubted) -> Chain:
    """Return the chain of a record on which a group of terms does not act."""
    where, prior, score = group.where, chain.prior.copy(), chain.prior_score.copy()
    wide = np.diag(chain.prior)[where]
    narrow = wide / NOTHING**2
    prior[where, where] = narrow
    score[where] = -narrow * group.at
    height = float(np.sum((narrow - wide) * group.at**2 - np.log(narrow / wide)))
    height += 2.0 * float(np.log(ODDS))
    return chain._replace(prior=prior, prior_score=score, height=chain.height + height)
