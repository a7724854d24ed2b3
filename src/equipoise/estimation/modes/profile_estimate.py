"""What not knowing a profile's unknowns adds to an estimate, and their own numbers in it.

With L L^T the covariance of the unknowns theta, L by columns l_k, and x(theta) the estimate,

    covariance += sum_k c_k c_k^T,      c_k = (x(theta + l_k) - x(theta)) / max(1, rise_k)^(1/2)

and c_k l_k^T, summed, is the covariance of x with theta (``profile_descent``). Twice the cost rises
by 1 if it is a parabola; an unknown that is open goes so far that it is none, and rises by more.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from equipoise.estimation.events.event_time_covariance import columns_of, widened
from equipoise.estimation.modes.profile_descent import Profile, ProfileFit, total
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.trajectory import METHOD
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import Estimate, Parameter

Named = Callable[[Square], tuple[Parameter, ...]]  # the numbers reported, by their covariance


def with_unknowns(
    concluded: Estimate, profile: Profile, fit: ProfileFit, by_theta: Floats, named: Named
) -> Estimate:
    """Return an estimate that counts the unknowns of a profile; the numbers reported are its last.

    ``by_theta`` is the derivative of these numbers by theta.
    """
    factor = np.linalg.cholesky(fit.covariance)
    recording = fit.model.recording
    models = [profile.at(fit.model, fit.theta + column) for column in factor.T]
    shifted = [conclude(one.fitted, METHOD, recording) for one in models]
    rise = np.array([
        total(profile, one, fit.theta + column) - fit.chi_square
        for one, column in zip(models, factor.T, strict=True)
    ])  # fmt: skip
    wider, own = widened(concluded, shifted, rise), by_theta @ factor
    columns = columns_of(concluded.parameters, [one.parameters for one in shifted], rise)
    covariance = np.block([[wider.covariance, columns @ own.T], [own @ columns.T, own @ own.T]])
    parameters = (*wider.parameters, *named(own @ own.T))
    return replace(wider, parameters=parameters, covariance=covariance)
