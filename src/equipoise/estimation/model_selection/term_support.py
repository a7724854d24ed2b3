"""Which terms of a fit its record supports, where each has a size that is known beforehand.

For coefficients b with the prior N(0, P), and N(d, C) when the record counts, the record is
likelier with them than without by

    2 ln ratio = d^T C^-1 d + ln det C - ln det P

(Savage and Dickey: the density at b = 0 before over that behind; Dickey 1971). It is the ratio of
``model_choice.surplus`` at the optimum of the richer model instead of the poorer one.

Cannot see terms that the fit does not have.
"""

import numpy as np

from equipoise.estimation.model_selection.model_choice import SURE
from equipoise.model.arrays import Floats
from equipoise.model.estimate import Estimate


def support(estimate: Estimate, terms: tuple[str, ...], sizes: Floats) -> float:
    """Return 2 ln of how much likelier the record is with terms of such sizes than without.

    ``sizes``: the sd of each term's prior, which the estimate contains.
    """
    value, covariance = estimate.values(terms), estimate.covariance_of(terms)
    d, C = value / sizes, covariance / np.outer(sizes, sizes)
    return float(d @ np.linalg.solve(C, d) + np.linalg.slogdet(C)[1])


def is_supported(estimate: Estimate, terms: tuple[str, ...], sizes: Floats) -> bool:
    """Say whether a record supports terms for sure (``SURE``); an unusable fit supports none."""
    return estimate.outcome.usable and support(estimate, terms, sizes) > SURE
