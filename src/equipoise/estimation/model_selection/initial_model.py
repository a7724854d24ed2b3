"""The fit that a survey begins with: plain, or with the little that it cannot begin without.

Over some turns drag takes the heading so far away that no step leads back, and a guess that is far
off pulls at what the data show; both are put right before anything else is sought.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.output_error.growing_horizon import CAPTURE, misfit_at
from equipoise.estimation.output_error.solution import Fitted, chi_square_share
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.estimation.search_budget import Stage
from equipoise.model import torque_terms
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

DAMPING = torque_terms.GROUPS["viscous"]
MUCH_BETTER = 10.0  # chosen: times less is left; damping that stands for touches is no such help
FARTHEST = np.log(100.0)  # of the ratio of mean moments, chosen: a guess is less wrong than that
OUTLYING = 0.5  # chosen: of a moment, by which the guess may be off and its anchor biases nothing


def plainly(recording: Recording, testbed: Testbed, params: Params) -> tuple[Params, Fitted]:
    """Return the plain fit, or one with damping where only that follows the motion.

    Over some turns drag takes the heading so far away that no step leads back: only a search that
    has the term from the start finds it. Behind a long gap the plain fit may even be a whole turn
    off, and so near. Where the plain fit follows nearly as well, the survey finds out what is
    missing: damping may stand for touches, too.
    """
    plain = fit(recording, testbed, params)
    if set(DAMPING) <= set(params.terms) or is_close(plain):
        return params, plain
    if not params.budget.allows(Stage.MOTION):
        return params, plain
    richer = replace(params, terms=torque_terms.among((*params.terms, *DAMPING)))
    damped = fit(recording, testbed, richer)
    return (richer, damped) if follows(damped, plain) else (params, plain)


def is_close(fitted: Fitted) -> bool:
    """Say whether a fit leaves so little that nothing can be ``MUCH_BETTER``."""
    return chi_square_share(fitted) < MUCH_BETTER**2


def follows(damped: Fitted, plain: Fitted) -> bool:
    """Say whether damping follows the motion where the plain fit does not, or far better."""
    if not is_near(damped):
        return False
    left, plain_left = (misfit_at(fitted.problem, fitted.at) for fitted in (damped, plain))
    return not is_near(plain) or left < plain_left / MUCH_BETTER


def is_near(fitted: Fitted) -> bool:
    """Say whether a fit follows the motion, however roughly."""
    return bool(np.isfinite(fitted.at.cost)) and misfit_at(fitted.problem, fitted.at) < CAPTURE


def anchored(
    recording: Recording, testbed: Testbed, params: Params, fitted: Fitted
) -> tuple[Testbed, Fitted]:
    """Return the testbed with the body that was found, and the fit, where the guess was far off.

    What the data leave open is kept near the guess (``Prior``), within sizes taken from it: those
    of a body ten times too small would pull at what the data do show. A body that is hundreds of
    times smaller than the guess is no body, but a fit that is lost.
    """
    found, guess = fitted.point.body(testbed.body.mass), testbed.body
    moved = np.diag(found.inertia_P - guess.inertia_P) / guess.mean_moment
    if params.use_prior or not is_close(fitted) or float(np.abs(moved).max()) < OUTLYING:
        return testbed, fitted
    if abs(np.log(found.mean_moment / guess.mean_moment)) > FARTHEST:
        return testbed, fitted
    nearer = replace(testbed, body=found)
    return nearer, fit(recording, nearer, params, fitted.point)
