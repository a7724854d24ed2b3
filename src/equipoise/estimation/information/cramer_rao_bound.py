"""The Cramer-Rao bound of a record whose truth is known: what no unbiased method can do better.

    sd(x_i) >= sqrt([I^-1]_ii),     I of ``information_matrix``, at the true body and torques

``fisher_information`` linearises along the motion that a fit follows; here body and torques are the
true ones, and only how the motion began, where masses stop and how sensors are off is found from
the rows. The bound is that of a fit which is asked the same: what is held counts as exact, what has
a prior (the body when asked, the masses' errors, the gyro's zero, the camera's vertical) counts as
known so far.

Cannot see what the model leaves out: torque noise, slips and touches in a record make every method
worse than its bound. A method that begins from more than it was asked to may well be better.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.information.information_matrix import ended_at, visibility_at
from equipoise.estimation.output_error.fit_estimate import parameters_of
from equipoise.estimation.output_error.free_vertical import with_free_vertical
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.output_error.solution import settle
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.estimation.parameters.fit_parameters import CORE, FIXED, Unknowns
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import Testbed


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
    return {p.name: p.sd for p in parameters_of(fitted, visibility_at(fitted), 1.0, None)[0]}


def given_body(problem: Problem) -> Problem:
    """Return the problem with body and torques held where they are."""
    held = problem.prior.held.copy()
    held[CORE] = True
    held[FIXED : FIXED + len(problem.layout.terms)] = True
    return replace(problem, prior=replace(problem.prior, held=held))
