"""The information matrix of a fit at a point, and the bound that it sets to every unbiased method.

    I  = sum S_k^T S_k / sd_k^2 + priors          S_k = d(row k)/dx along the motion
    sd(x_i) >= sqrt([I^-1]_ii)

All bounds come from here: along the motion that a plain fit follows (``fisher_information``), at
the truth (``least_sd``), and of a recording that does not exist yet
(``planning.manoeuvre.predicted_information``).

The Cramer-Rao bound of a record whose truth is known is what no unbiased method can do better.
``fisher_information`` linearises along the motion that a fit follows; in ``least_sd`` body and
torques are the true ones, and only how the motion began, where masses stop and how sensors are off
is found from the rows. The bound is that of a fit which is asked the same: what is held counts as
exact, what has a prior (the body when asked, the masses' errors, the gyro's zero, the camera's
vertical) counts as known so far.

Cannot see what the model leaves out: torque noise, slips and touches in a record make every method
worse than its bound. A method that begins from more than it was asked to may well be better.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.estimation.output_error.fit_estimate import parameters_of
from equipoise.estimation.output_error.fit_visibility import visibility_of, without_anchor
from equipoise.estimation.output_error.free_vertical import with_free_vertical
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.output_error.solution import Fitted, evaluate, settle
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.estimation.parameters.fit_parameters import CORE, Unknowns
from equipoise.estimation.parameters.observability import Visibility
from equipoise.maths.linalg import symmetrise
from equipoise.model.arrays import Bools, Floats, Square
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import Testbed


class Bound(NamedTuple):
    """What no unbiased method does better. Arrays are in the order of ``names``."""

    names: tuple[str, ...]
    units: tuple[str, ...]  # SI
    sd: Floats  # SI; infinite: the data do not show it; 0: exact
    view: Visibility


def ended_at(problem: Problem, point: Unknowns) -> Fitted:
    """Return the fit of a problem as if it had ended at a point, without jumps."""
    return replace(settle(problem, point, most=1), converged=True)


def bound_at(fitted: Fitted, exact: Bools) -> Bound:
    """Return the bound where a fit ended; parameters that are ``exact`` have no sd."""
    layout, view = fitted.problem.layout, visibility_of(fitted)
    sd = np.sqrt(np.maximum(np.diag(view.covariance), 0.0))
    bound = np.where(view.hidden, np.inf, np.where(exact, 0.0, sd))
    return Bound(layout.names, layout.units, bound, view)


def free_information(fitted: Fitted, held: Bools) -> Square:
    """Return the information about all but ``held``, that is about an open scale too."""
    problem = fitted.problem
    loose = replace(problem, prior=replace(problem.prior, held=held))
    at = evaluate(loose, fitted.point, fitted.jumps)
    whole = without_anchor(at.normal, replace(fitted, problem=loose))
    return symmetrise(whole[np.ix_(~held, ~held)])


def least_sd(
    recording: Recording, testbed: Testbed, params: Params, truth: Unknowns
) -> dict[str, float]:
    """Return the bound of each parameter that a fit reports, SI; infinite: unobservable.

    ``truth`` has the true body and torques (the errors of masses may be left out) and a motion at
    the record's beginning to search from.
    """
    recording = arranged(recording, testbed.mass_names)
    problem = problem_of(recording, testbed, with_free_vertical(recording, testbed, params))
    point = replace(truth, error=np.zeros(len(problem.layout.errors)))
    fitted = settle(given_body(problem), point)
    there = replace(fitted.point, six=truth.six, com=truth.com, torque=truth.torque)
    fitted = ended_at(problem, there)
    return {p.name: p.sd for p in parameters_of(fitted, visibility_of(fitted), 1.0, None)[0]}


def given_body(problem: Problem) -> Problem:
    """Return the problem with body and torques held where they are."""
    held = problem.prior.held.copy()
    held[CORE] = True
    held[problem.layout.torques] = True
    return replace(problem, prior=replace(problem.prior, held=held))
