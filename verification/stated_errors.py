"""Centre of mass and inertia of a record: their errors, in the standard deviations stated."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from equipoise.maths.linalg import pack_symmetric
from equipoise.model.estimate import COM, INERTIA, Estimate

NAMES = COM + INERTIA
Array = NDArray[np.float64]


class Body(Protocol):
    """What is true, masses at home: mass properties, or a platform made of bodies."""

    @property
    def com(self) -> Array:
        """Return the centre of mass from P, m."""
        ...

    @property
    def inertia_P(self) -> Array:
        """Return the inertia about P, kg m^2."""
        ...


def true_values(truth: Body) -> Array:
    """Return what an estimate should say, in the order of ``NAMES``."""
    return np.concatenate([truth.com, pack_symmetric(truth.inertia_P)])


def stated_sd(estimate: Estimate) -> Array:
    """Return the standard deviations stated (9,)."""
    return np.array([estimate.parameters[estimate.index(name)].sd for name in NAMES])


def stated_errors(estimate: Estimate, truth: Body) -> Array:
    """Return the errors (9,) in stated standard deviations; 0 where nothing is stated."""
    return (estimate.values(NAMES) - true_values(truth)) / stated_sd(estimate)


def stated_correlation(estimate: Estimate) -> Array:
    """Return how the nine errors are correlated by what is stated; all must be seen."""
    sd = stated_sd(estimate)
    return estimate.covariance_of(NAMES) / np.outer(sd, sd)
