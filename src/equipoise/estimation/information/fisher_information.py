"""What a recording can and cannot show: its Fisher information, and the Cramer-Rao bound.

The information matrix (``information_matrix``) is that of all that a trajectory fit seeks, of the
rows of camera and gyro with the testbed's noise, and of the sensitivities of the one propagator
along the motion that a plain fit follows (``reference_motion``). Priors are the testbed's for where
masses stop, the gyro's zero and the camera's vertical, and for the body when asked. No unbiased
method does better; the trajectory fit does as well where the model holds.

    rank        of D I D, D natural sizes: directions whose sd is below half of one, each that is
                not costs one, an open scale too (``observability``)
    condition   of I with unit diagonal; infinite where a direction is wholly unobservable
    sweep       least eigenvalue of int (|g|^2 E - g g^T) dt / (g^2 T), g in body axes: how far
                gravity leaves its mean direction, the mean square of the sine of that angle. Zero
                when it never does; the centre of mass along it is unobservable then. 2/3 at most.

A held parameter is not sought, and not counted. When nothing fixes the common scale of J and com,
neither is observable; bounds of their ratios are given.

Cannot see what is wrong with the model (torques nobody asked for, touches), or with the noise: rows
that err together say less than is stated here.
"""

import numpy as np

from equipoise.estimation.information.information_matrix import bound_at, free_information
from equipoise.estimation.information.reference_motion import Followed, followed, halfway
from equipoise.estimation.output_error.problem import prior_of
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.parameters.fit_parameters import CORE, physical
from equipoise.estimation.parameters.scale_free_ratios import ratios_of
from equipoise.maths.attitude import tilt, to_matrix
from equipoise.maths.linalg import unit_eigenvalues
from equipoise.model.arrays import Floats, Series3, Square
from equipoise.model.errors import InputError
from equipoise.model.observability import Observability
from equipoise.model.reasons.reason import distinct
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

ROUNDING = 1e-13  # of the largest eigenvalue, chosen: smaller ones are zero


def information_by(recording: Recording, testbed: Testbed, params: Params) -> Observability:
    """Return what a recording can show, bounds in SI units."""
    return information_along(followed(recording, testbed, params))


def information_along(motion: Followed) -> Observability:
    """Return what a motion that was followed can show, bounds in SI units.

    InputError for a fit that ended at a body whose motion has no end: a needle, say.
    """
    fitted = motion.fitted
    problem, layout = fitted.problem, fitted.problem.layout
    values = physical(fitted.point, problem.mass, layout)
    held = np.isin(layout.names, motion.params.hold)
    bound = bound_at(fitted, held)
    view = bound.view
    unobservable = distinct(view.unobservable)
    line, path = halfway(fitted)
    if not np.isfinite(path.q).all():
        where = problem.recording.source or "recording"
        raise InputError(where, "a motion that the fit did not find", "a shorter part of it")
    upward = tilt(path.q, motion.testbed.up)
    return Observability(
        bound.names,
        bound.units,
        bound.sd,
        stated_before(motion),
        view.hidden,
        held,
        unobservable,
        motion.cautions,
        ratios_of(values[CORE], view.covariance[CORE, CORE], view.unseen[CORE])
        if problem.scale_open
        else (),
        condition(free_information(fitted, held)),
        gravity_sweep(line.t, -to_matrix(path.q)[:, 2, :]),
        (float(upward.min()), float(upward.max())),
        int(np.sum(~held)) - len(unobservable),
        int(np.sum(~held)),
        fitted.point.body(problem.mass).inertia_P,
    )


def stated_before(motion: Followed) -> Floats:
    """Return the sd of what the testbed states of each unknown."""
    problem, testbed = motion.fitted.problem, motion.testbed
    prior = prior_of(testbed, problem.errors, problem.layout, True, ())
    with np.errstate(divide="ignore"):
        return 1.0 / np.sqrt(np.maximum(prior.weight - prior.anchor, 0.0))


def condition(information: Square) -> float:
    """Return the condition number of information with unit diagonal."""
    values = unit_eigenvalues(information)
    return float(values[-1] / values[0]) if values[0] > ROUNDING * values[-1] else np.inf


def gravity_sweep(t: Floats, down: Series3) -> float:
    """Return the least eigenvalue of the mean of E - n n^T; n are unit vectors, t in s."""
    outer = np.eye(3) - down[:, :, None] * down[:, None, :]
    mean = np.trapezoid(outer, t, axis=0) / (t[-1] - t[0])
    return max(float(np.linalg.eigvalsh(mean)[0]), 0.0)
