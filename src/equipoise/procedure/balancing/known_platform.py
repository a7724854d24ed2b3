"""The testbed as a balancing by hand leaves it: the platform as loaded, as it is known by then.

A fit takes independent priors. With P the covariance of a posterior and rho its correlation,

    s_i = sqrt(P_ii sum_j |rho_ij|)

are the sds of independent errors whose covariance is no less than P in any direction: diag(s^2) - P
is diagonally dominant in units of sqrt(P_ii). What J and com share, their common scale, is not
counted twice therefore; s is up to 1.9 times the posterior's own sd (preset sputnix with weights).
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.regression.solvers.physically_consistent import nearest
from equipoise.maths.linalg import element_sizes, inverse_spd, unpack_symmetric
from equipoise.model.arrays import Floats, Square
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.testbed import Testbed
from equipoise.procedure.balancing.manual_estimate import J, Posterior, R, first_posterior


def as_known(testbed: Testbed, posterior: Posterior) -> Testbed:
    """Return the testbed with the platform as it is loaded: the weights are part of its body.

    What a simulated bench is made of is left out, as it is about the platform without them.
    """
    body, sd = possible_body(testbed, posterior), independent_sds(posterior.covariance)
    relative = float(np.max(sd[J] / element_sizes(body.inertia_P)))
    mass_sd = testbed.mass_sd * testbed.body.mass / body.mass
    return replace(testbed, body=body, mass_sd=mass_sd, inertia_sd=relative, com_sd=sd[R],
                   body_covariance=posterior.covariance, weights=(), grids=(),
                   truth=None)  # fmt: skip


def independent_sds(covariance: Square) -> Floats:
    """Return sds of independent errors whose covariance is no less in any direction."""
    sd = np.sqrt(np.diag(covariance))
    correlation = covariance / np.outer(sd, sd)
    return sd * np.sqrt(np.abs(correlation).sum(axis=1))


def possible_body(testbed: Testbed, posterior: Posterior) -> MassProperties:
    """Return the posterior's mean, or the most likely body that can exist where it is none."""
    if is_possible(posterior.body):
        return posterior.body
    six, com = list(range(J.start, J.stop)), list(range(R.start, R.stop))
    information, stated = inverse_spd(posterior.covariance), first_posterior(testbed).mean
    found = nearest(information, posterior.mean, six, com, posterior.mass, stated)
    return MassProperties(posterior.mass, found[R], unpack_symmetric(found[J]))
