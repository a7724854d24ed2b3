"""Parameters by name with their covariance, as an estimate or its file gives them."""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import Estimate


@dataclass(frozen=True, slots=True, eq=False)
class GivenNumbers:
    """Values in SI; what the data do not show has an infinite variance."""

    names: tuple[str, ...]
    values: Floats  # (n,)
    covariance: Square  # (n, n)

    def known(self, names: tuple[str, ...]) -> bool:
        """Say whether all of these are given and were seen."""
        variance = dict(zip(self.names, np.diag(self.covariance), strict=True))
        return all(np.isfinite(variance.get(name, np.inf)) for name in names)

    def of(self, names: tuple[str, ...]) -> tuple[Floats, Square]:
        """Return the values of some parameters, and their covariance."""
        rows = [self.names.index(name) for name in names]
        return self.values[rows], self.covariance[np.ix_(rows, rows)]


NOTHING_GIVEN = GivenNumbers((), np.zeros(0), np.zeros((0, 0)))


def given_by(estimate: Estimate) -> GivenNumbers:
    """Return the parameters of an estimate."""
    names = tuple(each.name for each in estimate.parameters)
    covariance = estimate.covariance.copy()
    for k, each in enumerate(estimate.parameters):
        if not each.observable:
            covariance[k], covariance[:, k], covariance[k, k] = 0.0, 0.0, np.inf
    return GivenNumbers(names, estimate.values(names), covariance)
