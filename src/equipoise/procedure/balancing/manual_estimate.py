"""The posterior of a platform from recording to recording, weights being placed in between.

Inertia and centre of mass with their joint covariance. A recording adds its information
(``estimation.single_record``); weights of known first moment change both by a known step,

    r <- (M r + dmu) / M',   J <- J + dJ,   cov(r) grows by cov(dmu) / M'^2

and this known step between two free swings determines the scale of J and r.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.actuators.placed_weights import handling_covariance, load_of
from equipoise.estimation.information.single_record_information import Shown
from equipoise.maths.linalg import element_sizes, inverse_spd, pack_symmetric, unpack_symmetric
from equipoise.model.arrays import Floats, Ints, Matrix3, Square, Vector3
from equipoise.model.estimate import COM, INERTIA, Estimate, Parameter
from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import Testbed

J, R = slice(0, 6), slice(6, 9)


@dataclass(frozen=True, slots=True, eq=False)
class Posterior:
    """A platform as it is loaded."""

    mass: float  # kg
    mean: Floats  # J_P (6), com (3)
    covariance: Square

    @property
    def com(self) -> Vector3:
        """Centre of mass, m."""
        return self.mean[R]

    @property
    def com_covariance(self) -> Matrix3:
        """Covariance of ``com``, m^2."""
        return self.covariance[R, R]

    @property
    def sd(self) -> Vector3:
        """Standard deviations of ``com``, m."""
        return np.sqrt(np.diag(self.com_covariance))

    @property
    def body(self) -> MassProperties:
        """The mean as a body, which need not be physically consistent."""
        return MassProperties(self.mass, self.com, unpack_symmetric(self.mean[J]))


def first_posterior(testbed: Testbed) -> Posterior:
    """Return the prior by the testbed's nominal values."""
    body = testbed.body
    sd = np.append(testbed.inertia_sd * element_sizes(body.inertia_P), testbed.com_sd)
    mean = np.append(pack_symmetric(body.inertia_P), body.com)
    return Posterior(body.mass, mean, np.diag(sd**2))


def reloaded(posterior: Posterior, testbed: Testbed, before: Ints, after: Ints) -> Posterior:
    """Return the posterior after weights have been placed."""
    old, new = load_of(testbed, before), load_of(testbed, after)
    mass = posterior.mass + new.mass - old.mass
    moment = posterior.mass * posterior.com + new.first_moment - old.first_moment
    inertia = posterior.mean[J] + pack_symmetric(new.inertia_P - old.inertia_P)
    gain = np.append(np.ones(6), np.full(3, posterior.mass / mass))
    covariance = posterior.covariance * np.outer(gain, gain)
    covariance[R, R] += handling_covariance(testbed, before, after) / mass**2
    return Posterior(mass, np.append(inertia, moment / mass), covariance)


def taught(posterior: Posterior, shown: Shown) -> Posterior:
    """Return the posterior with a recording added."""
    return _added(posterior, inverse_spd(posterior.covariance), shown)


def alone(posterior: Posterior, shown: Shown) -> Posterior:
    """Return the posterior by a recording without the prior of the centre of mass."""
    information = np.zeros((9, 9))
    information[J, J] = inverse_spd(posterior.covariance[J, J])
    return _added(posterior, information, shown)


def _added(posterior: Posterior, information: Square, shown: Shown) -> Posterior:
    covariance = inverse_spd(information + shown.information)
    mean = covariance @ (information @ posterior.mean + shown.pull)
    return Posterior(posterior.mass, mean, covariance)


def as_estimate(posterior: Posterior, latest: Estimate) -> Estimate:
    """Return a posterior as an estimate, with outcome and residual of the latest recording."""
    order = [*range(R.start, R.stop), *range(J.start, J.stop)]
    mean, covariance = posterior.mean[order], posterior.covariance[np.ix_(order, order)]
    names = [*((name, "m") for name in COM), *((name, "kg m2") for name in INERTIA)]
    found = tuple(
        Parameter(*name, float(value), float(variance**0.5))
        for name, value, variance in zip(names, mean, np.diag(covariance), strict=True)
    )
    return Estimate(latest.method, latest.outcome, found, covariance, latest.residual,
                    provenance=latest.provenance)  # fmt: skip
