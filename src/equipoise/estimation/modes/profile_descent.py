"""A profile likelihood by Gauss-Newton: what acts as known in a fit is sought beside it.

All else x is at its optimum x(theta) for every theta. The residuals there, priors and jumps among
them, have the derivative J by theta, and

    (J^T J + P) step = -J^T r - P theta

is Gauss-Newton in x and theta together with x taken out (variable projection: Golub and Pereyra
1973). The inverse of J^T J + P is the covariance of theta, x being free, and dx/dtheta carries it
on to x. theta counts from the mean of its prior, in natural sizes; J is by differences.

Cannot see another optimum than that next to where it begins.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.output_error.problem import posed
from equipoise.estimation.output_error.solution import Fitted, cost_of
from equipoise.estimation.parameters.fit_parameters import TURN, physical
from equipoise.estimation.search_budget import Stage
from equipoise.model.arrays import Floats, Square

FINE = 1.0  # sd, chosen: by which the data change in a difference
COARSEST = 0.2  # natural sizes, chosen: of a difference
MOST = 12  # steps, chosen: those that settle take half
SETTLED = 0.3  # of chi-square, chosen: half a sd of one unknown
BOLDEST = 1e4  # chosen: damping of a step at which the search ends


@dataclass(frozen=True, slots=True, eq=False)
class Profile:
    """What is sought, in natural sizes."""

    at: Callable[[RecordModel, Floats], RecordModel]  # the model fitted with a theta, from another
    sd: Floats  # of the prior of theta
    bold: Floats  # the most that a step may change each; infinite: any
    varied: Floats  # by how much each is varied at first


@dataclass(frozen=True, slots=True, eq=False)
class ProfileFit:
    """The optimum."""

    model: RecordModel
    theta: Floats
    covariance: Square  # of theta
    information: Square  # of the record alone, J^T J
    chi_square: float  # twice the cost, with the prior of theta


def total(profile: Profile, model: RecordModel, theta: Floats) -> float:
    """Return the chi-square, with priors."""
    return 2.0 * cost_of(model.fitted) + float(np.sum((theta / profile.sd) ** 2))


def residuals(fitted: Fitted) -> Floats:
    """Return all residuals of a fit in sd: of rows, priors and jumps."""
    problem, at = fitted.problem, fitted.at
    x = physical(fitted.point, problem.mass, problem.layout)
    off = np.sqrt(problem.prior.weight) * (x - problem.prior.mean)
    off[TURN] = 0.0  # of which a point counts from itself
    off[problem.prior.held] = 0.0
    jumped = fitted.jumps * np.sqrt(posed(problem).cuts.weight)
    return np.concatenate([np.ravel(part) for part in (at.left_q, at.left_w, at.left_v)]
                          + [off, np.ravel(jumped)])  # fmt: skip


def derivative(
    profile: Profile, model: RecordModel, theta: Floats, varied: Floats
) -> tuple[Floats, Floats]:
    """Return J by differences, and by how much to vary theta the next time, by what J says."""
    r = residuals(profile.at(model, theta).fitted)  # gone as long a way as the others
    found = np.zeros((len(r), len(theta)))
    for k, h in enumerate(varied):
        ahead = theta + h * (np.arange(len(theta)) == k)
        found[:, k] = (residuals(profile.at(model, ahead).fitted) - r) / h
    size = np.linalg.norm(found, axis=0)
    better = np.clip(FINE / np.maximum(size, 1e-12), 0.01 * varied, 3 * varied)
    return found, np.minimum(better, COARSEST)


def tried_step(
    profile: Profile, by_theta: Floats, r: Floats, theta: Floats, damping: float
) -> tuple[Floats, float]:
    """Return the damped step of Gauss-Newton, and by how much chi-square should fall."""
    P = profile.sd**-2.0
    normal, descent = by_theta.T @ by_theta + np.diag(P), -(by_theta.T @ r) - P * theta
    damped = normal + damping * np.diag(np.diag(normal))
    step = np.linalg.solve(damped, descent).astype(np.float64, copy=False)
    step /= max(1.0, float(np.max(np.abs(step) / profile.bold)))
    return step, float(step @ (2.0 * descent - normal @ step))


def descended(profile: Profile, model: RecordModel, theta: Floats) -> ProfileFit:
    """Return the optimum of theta and all else, from a first theta."""
    damping, here = 1e-3, profile.at(model, theta)
    by_theta, varied = derivative(profile, here, theta, profile.varied)
    for _ in range(MOST):
        step, promised = tried_step(profile, by_theta, residuals(here.fitted), theta, damping)
        if promised < SETTLED or damping > BOLDEST or not model.may(Stage.TERMS):
            break
        there = profile.at(here, theta + step)
        gained = total(profile, here, theta) - total(profile, there, theta + step)
        if gained <= 0.0:
            damping *= 10.0
            continue
        theta, here, damping = theta + step, there, max(0.1 * damping, 1e-6)
        by_theta, varied = derivative(profile, here, theta, varied)
        if gained < SETTLED:
            break
    return fit_with(profile, here, theta, by_theta)


def fit_with(profile: Profile, model: RecordModel, theta: Floats, by_theta: Floats) -> ProfileFit:
    """Return what J says at a model that is fitted with a theta: (J^T J + P)^-1."""
    information = by_theta.T @ by_theta
    covariance = np.linalg.inv(information + np.diag(profile.sd**-2.0))
    return ProfileFit(
        model,
        theta,
        covariance.astype(np.float64, copy=False),
        information,
        total(profile, model, theta),
    )


def fit_here(profile: Profile, model: RecordModel, theta: Floats) -> ProfileFit:
    """Return what a model says of the theta that it is fitted with."""
    _, varied = derivative(profile, model, theta, profile.varied)  # as the record shows each
    by_theta, _ = derivative(profile, model, theta, varied)
    return fit_with(profile, model, theta, by_theta)
