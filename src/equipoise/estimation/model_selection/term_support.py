"""Which torques of a fit its record supports, where each has a size that is known beforehand.

For coefficients b with the prior N(0, P), and N(d, C) when the record counts, the record is
likelier with them than without by

    2 ln ratio = d^T C^-1 d + ln det C - ln det P

(Savage and Dickey: the density at b = 0 before over that behind; Dickey 1971). It is the ratio of
``model_choice.surplus`` at the optimum of the richer model instead of the poorer one.

Cannot see terms that the fit does not have.
"""

import numpy as np

from equipoise.estimation.model_selection.model_choice import SURE
from equipoise.model.estimate import Estimate
from equipoise.model.torque_terms import typical


def support(estimate: Estimate, terms: tuple[str, ...]) -> float:
    """Return 2 ln of how much likelier the record is with terms of typical size than without."""
    value, covariance = estimate.values(terms), estimate.covariance_of(terms)
    unit = np.array([typical(term) for term in terms])
    d, C = value / unit, covariance / np.outer(unit, unit)
    return float(d @ np.linalg.solve(C, d) + np.linalg.slogdet(C)[1])


def is_supported(estimate: Estimate, terms: tuple[str, ...]) -> bool:
    """Say whether a record supports terms for sure (``SURE``); an unusable fit supports none."""
    return estimate.outcome.usable and support(estimate, terms) > SURE
