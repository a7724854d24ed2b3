"""How well a manoeuvre will tell a body: the information of its recording, before there is one.

    covariance = (sum S_k^T S_k / sd_k^2 + priors + what is known already)^-1

at the true point of a noiseless recording (``noiseless_record``). Problem, information and what is
not seen are those of a trajectory fit and of ``fisher_information``, of a recording that has to be
fitted first: unknown attitude and rate at the start, where masses stop and how late and how far
they hang, the camera's vertical and the gyro's zero count alike.

It is the least that any unbiased method reaches when the model holds and the noise is white. A
torque that wanders, a touch, a term that the record asks for and the testbed does not: all of that
makes what is found worse, and cannot be seen here.
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
    """What earlier recordings tell of some unknowns, by the names of the layout."""

    names: tuple[str, ...]
    information: Square  # SI


@dataclass(frozen=True, slots=True, eq=False)
class Predicted:
    """What a manoeuvre will tell, in the order of ``names``, and how far it goes."""

    names: tuple[str, ...]
    units: tuple[str, ...]  # SI
    sd: Floats  # SI; infinite: not seen; 0: held
    covariance: Square  # of what is seen
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
    """Return what a manoeuvre of a platform with this body will tell."""
    observed = imagined(testbed, body, manoeuvre)
    problem = posed(observed, testbed, params, known)
    return prediction(at_truth(problem, observed, body, manoeuvre, known), observed, testbed)


def posed(observed: Imagined, testbed: Testbed, params: Params, known: Known | None) -> Problem:
    """Return the problem of a noiseless recording.

    What is known already fixes the scale too; nothing is held then but what is asked.
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
    """Return the truth as a point of the search: masses where told, sensors without fault."""
    return Unknowns(
        observed.motion.q[0], manoeuvre.rate, pseudo_inertia.from_inertia(body.inertia_C), body.com,
        np.zeros(N_TORQUES), np.zeros(N_SENSOR), np.zeros(len(layout.errors)), np.zeros(3),
    )  # fmt: skip


def informed(problem: Problem, point: Unknowns, known: Known | None) -> Fitted:
    """Return the fit that ended at a point, with what is known already in its information."""
    fitted = ended_at(problem, point)
    if known is None:
        return fitted
    normal, names = fitted.at.normal.copy(), problem.layout.names
    here = [k for k, name in enumerate(known.names) if name in names]
    where = [names.index(known.names[k]) for k in here]
    normal[np.ix_(where, where)] += known.information[np.ix_(here, here)]
    return replace(fitted, at=replace(fitted.at, normal=normal))


def prediction(fitted: Fitted, observed: Imagined, testbed: Testbed) -> Predicted:
    """Return what a fit at the truth says of itself, with the limits of its motion."""
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
