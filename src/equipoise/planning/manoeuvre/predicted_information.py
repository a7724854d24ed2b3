"""How well a manoeuvre determines a body: the predicted information of its recording.

    covariance = (sum S_k^T S_k / sd_k^2 + priors + information of earlier recordings)^-1

at the true point of a noiseless recording (``noiseless_record``). Problem, information and
unobservable directions are those of a trajectory fit and of ``fisher_information``, of a recording
that has to be fitted first. Attitude and rate at the start, stops, lags and sags of masses, the
camera's vertical and the gyro's bias are unknowns alike.

It is the least that any unbiased method reaches when the model holds and the noise is white. A
torque that wanders, a contact, or a term that the record needs and the testbed does not state makes
the estimate worse, and is not included here.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.dynamics.regressor import N_TORQUES
from equipoise.estimation.information.information_matrix import bound_at, ended_at
from equipoise.estimation.output_error.free_vertical import with_free_vertical
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.estimation.parameters.fit_parameters import Layout, Unknowns
from equipoise.maths import pseudo_inertia
from equipoise.maths.attitude import tilt
from equipoise.model.arrays import Bools, Floats, Square
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.mass_properties import MassProperties
from equipoise.model.reasons.reason import Reason
from equipoise.model.testbed import Testbed
from equipoise.planning.manoeuvre.noiseless_record import Imagined, imagined
from equipoise.sensors.camera import N_SENSOR


@dataclass(frozen=True, slots=True, eq=False)
class Known:
    """The information of earlier recordings on some unknowns, by the names of the layout."""

    names: tuple[str, ...]
    information: Square  # SI


@dataclass(frozen=True, slots=True, eq=False)
class Predicted:
    """The predicted covariance of a manoeuvre, in the order of ``names``, and its peaks."""

    names: tuple[str, ...]
    units: tuple[str, ...]  # SI
    sd: Floats  # SI; infinite: unobservable; 0: held
    covariance: Square  # of what is observable
    hidden: Bools
    unobservable: tuple[Reason, ...]  # directions
    peak_tilt: float  # rad
    peak_momentum: float  # N m s, stored in wheels and gyros

    def sd_of(self, names: tuple[str, ...]) -> Floats:
        """Return several sd, SI."""
        return self.sd[[self.names.index(name) for name in names]]


def predicted(
    testbed: Testbed,
    body: MassProperties,
    manoeuvre: Manoeuvre,
    params: Params,
    known: Known | None = None,
) -> Predicted:
    """Return the predicted covariance of a manoeuvre of a platform with this body."""
    observed = imagined(testbed, body, manoeuvre)
    problem = posed(observed, testbed, params, known)
    return prediction(at_truth(problem, observed, body, manoeuvre, known), observed, testbed)


def posed(observed: Imagined, testbed: Testbed, params: Params, known: Known | None) -> Problem:
    """Return the problem of a noiseless recording.

    Earlier information fixes the scale too; then only the requested parameters are held.
    """
    params = with_free_vertical(observed.recording, testbed, params)
    problem = problem_of(observed.recording, testbed, params)
    if known is None or not problem.scale_open:
        return problem
    held = np.isin(problem.layout.names, params.hold)
    return replace(problem, scale_open=False, prior=replace(problem.prior, held=held))


def at_truth(
    problem: Problem,
    observed: Imagined,
    body: MassProperties,
    manoeuvre: Manoeuvre,
    known: Known | None,
) -> Fitted:
    """Return the fit of a noiseless recording, which ends where the truth is."""
    point = true_point(observed, body, manoeuvre, problem.layout)
    return informed(problem, point, known)


def true_point(
    observed: Imagined, body: MassProperties, manoeuvre: Manoeuvre, layout: Layout
) -> Unknowns:
    """Return the truth as a point of the search: masses where commanded, sensors without error."""
    return Unknowns(
        observed.motion.q[0], manoeuvre.rate, pseudo_inertia.from_inertia(body.inertia_C), body.com,
        np.zeros(N_TORQUES), np.zeros(N_SENSOR), np.zeros(len(layout.errors)), np.zeros(3),
    )  # fmt: skip


def informed(problem: Problem, point: Unknowns, known: Known | None) -> Fitted:
    """Return the fit that ended at a point, with earlier information added."""
    fitted = ended_at(problem, point)
    if known is None:
        return fitted
    normal = fitted.at.normal.copy()
    add_known(normal, problem.layout.names, known)
    return replace(fitted, at=replace(fitted.at, normal=normal))


def add_known(information: Floats, names: tuple[str, ...], known: Known) -> None:
    """Add earlier information to that on the unknowns of a layout, (n, n) or several of them."""
    here = [k for k, name in enumerate(known.names) if name in names]
    where = [names.index(known.names[k]) for k in here]
    information[..., *np.ix_(where, where)] += known.information[np.ix_(here, here)]


def prediction(fitted: Fitted, observed: Imagined, testbed: Testbed) -> Predicted:
    """Return the covariance of a fit at the truth, with the peaks of its motion."""
    problem, stored = fitted.problem, observed.recording.momentum
    held = problem.prior.held
    bound = bound_at(fitted, np.zeros_like(held) if problem.scale_open else held)
    return Predicted(
        bound.names,
        bound.units,
        bound.sd,
        bound.view.covariance,
        bound.view.hidden,
        bound.view.unobservable,
        float(tilt(observed.motion.q, testbed.up).max()),
        0.0 if stored is None else float(np.linalg.norm(stored.values, axis=1).max()),
    )
