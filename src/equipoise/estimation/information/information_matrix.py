"""The information matrix of a fit at a point, and the bound that it sets to every unbiased method.

    I  = sum S_k^T S_k / sd_k^2 + priors          S_k = d(row k)/dx along the motion
    sd(x_i) >= sqrt([I^-1]_ii)

All bounds come from here: along the motion that a plain fit follows (``fisher_information``), at
the truth (``cramer_rao_bound``), and of a recording that does not exist yet
(``design.manoeuvre.predicted_information``).
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.estimation.output_error.fit_estimate import visibility_of, without_anchor
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.output_error.solution import Fitted, evaluate
from equipoise.estimation.parameters.fit_parameters import Unknowns, physical
from equipoise.estimation.parameters.observability import Visibility
from equipoise.maths.linalg import symmetrise
from equipoise.model.arrays import Bools, Floats, Square


class Bound(NamedTuple):
    """What no unbiased method does better. Arrays are in the order of ``names``."""

    names: tuple[str, ...]
    units: tuple[str, ...]  # SI
    sd: Floats  # SI; infinite: the data do not show it; 0: exact
    view: Visibility


def ended_at(problem: Problem, point: Unknowns) -> Fitted:
    """Return the fit of a problem as if it had ended at a point, without jumps."""
    return Fitted(problem, point, evaluate(problem, point), True, 1, np.zeros((0, 1)))


def visibility_at(fitted: Fitted) -> Visibility:
    """Return covariance and visibility where a fit ended."""
    problem = fitted.problem
    return visibility_of(fitted, physical(fitted.point, problem.mass, problem.layout))


def bound_at(fitted: Fitted, exact: Bools) -> Bound:
    """Return the bound where a fit ended; parameters that are ``exact`` have no sd."""
    layout, view = fitted.problem.layout, visibility_at(fitted)
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
