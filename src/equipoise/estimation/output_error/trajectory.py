"""Trajectory: the maximum-likelihood output-error fit, the reference estimator.

    minimise  sum |log(q_pred^-1 q_meas)|^2 / sd_q^2 + sum |w_meas - w_pred - b|^2 / sd_w^2
              + sum |v_meas - v_pred - b_v|^2 / sd_v^2 + priors

(v: what an accelerometer, a sun sensor or a magnetometer gives) over first attitude and rate, J,
com, torque coefficients, the sensors' biases and mountings, and where the masses really stop,
through every known move in the record (Ivanov 2021 section 3 with errata I1-I6, I15: all about P,
multiplicative residual, first attitude free, realised displacements as unknowns with their accuracy
as prior). J moves in log-Cholesky coordinates and is always possible.

Starts from the linear methods; where these are too wrong, the horizon grows (``growing_horizon``).
Reaches the Cramer-Rao bound when the model holds; the outcome says when it does not.

Cannot see: the common scale of J and com without a known move, stored momentum or held value; com
along gravity without tilt; J_33 and products without spin about more than one axis; heading
without a camera, or a lamp or field beside gravity.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from equipoise.actuators.mass_errors import MassErrors
from equipoise.dynamics.modal_inputs import ModalInputs
from equipoise.estimation.motion.observed_vectors import errors_of_vectors
from equipoise.estimation.motion.sensor_noise import (
    camera_noise,
    gyro_noise,
    with_noise,
    with_vector_noise,
)
from equipoise.estimation.output_error.fixed_parameters import settle_pinned
from equipoise.estimation.output_error.growing_horizon import (
    CAPTURE,
    FEW,
    few_swings,
    grown,
    misfit,
)
from equipoise.estimation.output_error.initial_guess import as_measured, start
from equipoise.estimation.output_error.multiple_shooting import shot
from equipoise.estimation.output_error.problem import (
    ANCHOR,
    NOTHING,
    Problem,
    changes,
    errors_of,
    longest_step,
    pose,
    prior_of,
    with_body_covariance,
    with_torque_sds,
)
from equipoise.estimation.output_error.segment_jumps import UNCUT, Jump
from equipoise.estimation.output_error.solution import (
    Fitted,
    chi_square_share,
    cost_of,
    finite_cost,
)
from equipoise.estimation.parameters.fit_parameters import Layout, Unknowns, core_of
from equipoise.estimation.search_budget import UNLIMITED, Budget, Stage
from equipoise.maths.attitude import exponential, multiply, to_matrix
from equipoise.model import sensor_terms
from equipoise.model.arrays import Floats, Series1
from equipoise.model.errors import InputError, nearest
from equipoise.model.estimate import BODY, INERTIA
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import Testbed
from equipoise.sensors.vector_sensors import vector_sensors

METHOD = "trajectory"
LOST = 3.0  # chosen: chi-square a degree of freedom beyond which another start is tried
HUBER = 3.0  # sd of a residual vector; 97 % of clean ones are shorter
AS_WELL = 1.0  # of half a chi-square, chosen: what does not tell two solutions apart
GUIDED = 0.1  # natural sizes of torques, on the way
COARSE = 0.01  # rad, rad/s, chosen: half a degree


@dataclass(frozen=True, slots=True)
class Params:
    """Options of the fit."""

    terms: tuple[str, ...] = ()  # torques to estimate, by name
    sensor: tuple[str, ...] = ()  # of what is wrong with the sensors, by name
    jumps: tuple[Jump, ...] = UNCUT
    use_prior: bool = False  # the testbed's inertia and centre of mass, with their sd
    hold: tuple[str, ...] = ()  # parameters kept at the testbed's value
    robust: bool = False  # Huber's loss
    fineness: float = 1.0  # by which integration steps are shorter than estimates need
    travels_count: bool = True  # masses went as recorded, so that travels give the scale
    torque_sds: tuple[tuple[str, float], ...] = ()  # one sd about zero of some terms, SI
    budget: Budget = UNLIMITED  # of the search
    modal: ModalInputs | None = None  # what modes do to the body, where there are any


def layout_of(recording: Recording, testbed: Testbed, params: Params) -> Layout:
    """Return the unknowns of a record; InputError if a held name is not among them."""
    return layout_with(errors_of(recording, testbed), recording, testbed, params)


def layout_with(
    errors: MassErrors, recording: Recording, testbed: Testbed, params: Params
) -> Layout:
    """Return the unknowns of a record whose masses may be off in this way."""
    sensor = sensor_terms.among((*params.sensor, *errors_of_vectors(recording, testbed)))
    layout = Layout(params.terms, errors.names, recording.rate is not None, sensor)
    for name in params.hold:
        if name not in layout.names[6:15]:
            wanted = nearest(name, list(layout.names[6:15]))
            raise InputError("hold", f"'{name}'", wanted)
    return layout


@lru_cache(maxsize=4)  # by identity, as ``mass_errors``
def fastest_rate(recording: Recording) -> float:
    """Return the greatest rate (rad/s) measured, roughly; 0 where nothing says."""
    attitude, rate = recording.attitude or NOTHING, recording.rate or NOTHING
    return float(fastest_of(attitude.t, attitude.values, rate.values))


def fastest_of(t: Series1, attitude: Floats, rate: Floats) -> Floats:
    """Return the same of attitudes (..., n, 4), at times t, and of rates (..., m, 3) of a gyro."""
    found = np.zeros(attitude.shape[:-2])
    if rate.shape[-2]:
        found = np.percentile(np.linalg.norm(rate, axis=-1), 95, axis=-1)
    if attitude.shape[-2] > 1:
        cosine = np.sum(attitude[..., 1:, :] * attitude[..., :-1, :], axis=-1)
        turns = 2 * np.arccos(np.clip(np.abs(cosine), 0, 1)) / np.diff(t)
        found = np.maximum(found, np.percentile(turns, 95, axis=-1))
    return np.asarray(found)


def is_scale_open(recording: Recording, testbed: Testbed, params: Params) -> bool:
    """Say whether nothing in the record or the options fixes the scale of J and com.

    A value that is held at zero does not: it is zero at any scale.
    """
    if params.use_prior or changes(recording, params.travels_count):
        return False
    values = dict(zip(BODY, core_of(testbed.body), strict=True))
    return not any(values[name] for name in params.hold)


def held_names(recording: Recording, testbed: Testbed, params: Params) -> tuple[str, ...]:
    """Return the parameters that do not move: the user's, and one moment for an open scale."""
    largest = INERTIA[int(np.argmax(np.diag(testbed.body.inertia_P)))]
    first = (largest,) if is_scale_open(recording, testbed, params) else ()
    return (*first, *params.hold)


@lru_cache(maxsize=2)  # what was fitted is smoothed; recording and testbed by identity
def problem_of(
    recording: Recording, testbed: Testbed, params: Params, torque_anchor: float = ANCHOR
) -> Problem:
    """Return the least-squares problem of a record."""
    errors = errors_of(recording, testbed)
    layout = layout_with(errors, recording, testbed, params)
    scale_open = is_scale_open(recording, testbed, params)
    hold = held_names(recording, testbed, params)
    prior = prior_of(testbed, errors, layout, params.use_prior, hold, torque_anchor)
    if params.use_prior and testbed.body_covariance is not None:
        prior = with_body_covariance(prior, testbed.body_covariance)
    if params.torque_sds:
        prior = with_torque_sds(prior, layout, params.torque_sds)
    limit = HUBER if params.robust else 0.0
    longest = longest_step(testbed, fastest_rate(recording), recording.rows) / params.fineness
    posed = pose(
        recording,
        testbed,
        layout,
        errors,
        prior,
        longest,
        limit,
        scale_open,
        params.jumps,
        params.modal,
    )
    return replace(posed, budget=params.budget)


def approach(
    recording: Recording,
    testbed: Testbed,
    params: Params,
    point: Unknowns,
    most: float = 1.0,
) -> Unknowns:
    """Return a point from which the whole record can be fitted, by a growing horizon.

    On the way the testbed's inertia counts as prior, torques are kept small and the camera counts
    as coarse, so that a part too short to show them, or a model that does not hold, cannot drive
    the search away.
    """
    coarse, guided = coarsened(testbed), replace(params, use_prior=True)
    return grown(recording, lambda part: problem_of(part, coarse, guided, GUIDED), point, most)


def coarsened(testbed: Testbed) -> Testbed:
    """Return the testbed with sensors that are no better than the model is early in the search."""
    camera, gyro = camera_noise(testbed), gyro_noise(testbed)
    coarse = {
        each.channel: max(each.noise, COARSE * float(np.linalg.norm(each.vector_N)))
        for each in vector_sensors(testbed)
    }
    testbed = with_vector_noise(testbed, coarse)
    return with_noise(testbed, max(camera, COARSE), max(gyro, COARSE))


def fit(
    recording: Recording,
    testbed: Testbed,
    params: Params,
    guess: Unknowns | None = None,
    early: Recording | None = None,
) -> Fitted:
    """Return the optimum for a record, from a given point or from the linear methods.

    A record so long that a point is lost by whole swings gives these only a first part, ``early``.
    """
    recording = arranged(recording, testbed.mass_names)
    problem = problem_of(recording, testbed, params)
    if guess is not None:
        return settle_pinned(problem, guess)
    point = first_point(recording, testbed, params, problem, early)
    found = settle_pinned(problem, point)
    motion = Stage.MOTION
    if not explains(found) and recording.attitude is not None and params.budget.allows(motion):
        shot_at = shoot(recording, testbed, params, point)
        found = min(found, settle_pinned(problem, shot_at), key=cost_of)
    if not explains(found) and early is None and params.budget.allows(motion):
        first = as_measured(recording, testbed, float(problem.line.t[0]), point)
        grown_to = approach(recording, testbed, params, first, FEW)
        found = min(found, settle_pinned(problem, grown_to), key=cost_of)
    return upright(found)


def upright(fit: Fitted) -> Fitted:
    """Return a fit in which the platform does not hang upside down, where that does as well.

    A gyro sees torque m g com x n alone: com and n, both reversed, move the platform alike.
    """
    problem, q0 = fit.problem, fit.point.q0
    shown = len(problem.observed.attitude) + len(problem.observed.vectors.values) > 0
    if shown or to_matrix(q0)[2] @ problem.testbed.up > 0:
        return fit
    turned = multiply(exponential(np.array([np.pi, 0.0, 0.0])), q0)
    found = settle_pinned(problem, replace(fit.point, q0=turned, com=-fit.point.com))
    return found if cost_of(found) < cost_of(fit) + AS_WELL else fit


def first_point(
    recording: Recording,
    testbed: Testbed,
    params: Params,
    problem: Problem,
    early: Recording | None,
) -> Unknowns:
    """Return the point of the linear methods, grown to the whole record where it is lost there."""
    first = float(problem.line.t[0])
    hold = held_names(recording, testbed, params)
    linear = start(early or recording, testbed, problem.layout, first, hold)
    if early is not None:
        return approach(recording, testbed, params, linear, few_swings(recording))
    point = nearer(problem, linear, as_measured(recording, testbed, first, linear))
    if params.terms or misfit(problem, point) > CAPTURE:
        return approach(recording, testbed, params, point)
    return point


def nearer(problem: Problem, *points: Unknowns) -> Unknowns:
    """Return the point from which the motion is nearest to the rows."""
    return min(points, key=lambda point: finite_cost(misfit(problem, point)))


def explains(fit: Fitted) -> bool:
    """Say whether a fit leaves so little that no other start need be tried."""
    return fit.converged and chi_square_share(fit) < LOST


def shoot(recording: Recording, testbed: Testbed, params: Params, body: Unknowns) -> Unknowns:
    """Return a point by multiple shooting, from the measured motion and a first body."""

    def posed_with(jumps: tuple[Jump, ...]) -> Problem:
        return problem_of(recording, testbed, replace(params, jumps=jumps))

    return shot(recording, testbed, posed_with, body)
