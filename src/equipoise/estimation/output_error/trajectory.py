"""Trajectory: the maximum-likelihood output-error fit, the reference estimator.

    minimise  sum |log(q_pred^-1 q_meas)|^2 / sd_q^2 + sum |w_meas - w_pred - b|^2 / sd_w^2 + priors

over first attitude and rate, J, com, torque coefficients, gyro bias, and where the masses really
stop, through every known move in the record (Ivanov 2021 section 3 with errata I1-I6, I15: all
about P, multiplicative residual, first attitude free, realised displacements as unknowns with
their accuracy as prior). J moves in log-Cholesky coordinates and is always possible.

Starts from the linear methods; where these are too wrong, the horizon grows step by step.
Reaches the Cramer-Rao bound when the model holds; the outcome says when it does not.

Cannot see: the common scale of J and com without a known move, stored momentum or held value; com
along gravity without tilt; J_33 and products without spin about more than one axis; heading
without a camera.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.actuators.mass_errors import MassErrors
from equipoise.estimation.motion.sensor_noise import camera_noise, gyro_noise, with_noise
from equipoise.estimation.output_error.fixed_parameters import settle_pinned
from equipoise.estimation.output_error.initial_guess import as_measured, start
from equipoise.estimation.output_error.multiple_shooting import shot
from equipoise.estimation.output_error.problem import (
    ANCHOR,
    Problem,
    changes,
    errors_of,
    longest_step,
    pose,
    prior_of,
    with_typical_torques,
)
from equipoise.estimation.output_error.segment_jumps import UNCUT, Jump
from equipoise.estimation.output_error.solution import (
    Evaluation,
    Fitted,
    chi_square_share,
    cost_of,
    evaluate,
    finite_cost,
    settle,
)
from equipoise.estimation.parameters.fit_parameters import Layout, Unknowns, core_of
from equipoise.estimation.search_budget import UNLIMITED, Budget, Stage
from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError, nearest
from equipoise.model.estimate import BODY, INERTIA
from equipoise.model.recording import Recording, arranged, window
from equipoise.model.testbed import Testbed

METHOD = "trajectory"
CAPTURE = 0.5  # rad rms, chosen: beyond this the first guess is not followed to the end
LOST = 3.0  # chosen: chi-square a degree of freedom beyond which another start is tried
HUBER = 3.0  # sd of a residual vector; 97 % of clean ones are shorter
FOLLOWED = (
    0.05  # rad rms, chosen: a part is longer than the one before by what is predicted so well
)
GROWTH, SLOWEST = (
    2.0,
    1.06,
)  # chosen: times that a part is longer than the one before, at most; least
SHORTEST = 0.02  # of the record, the least part to begin with
FEW = 1 / 16  # of a record on which other starts are lost, chosen
FEW_SWINGS = 1 / 32  # of a long record, chosen: 56 s of half an hour
FEW_ROWS = 50  # chosen: fewer are no motion
GUIDED = 0.1  # natural sizes of torques, on the way
COARSE = 0.01  # rad, rad/s, chosen: half a degree


@dataclass(frozen=True, slots=True, eq=False)
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
    typical: bool = False  # torques are as large as benches have them (``model.torque_terms``)
    budget: Budget = UNLIMITED  # of the search


def layout_of(recording: Recording, testbed: Testbed, params: Params) -> Layout:
    """Return the unknowns of a record; InputError if a held name is not among them."""
    return layout_with(errors_of(recording, testbed), recording, params)


def layout_with(errors: MassErrors, recording: Recording, params: Params) -> Layout:
    """Return the unknowns of a record whose masses may be off in this way."""
    layout = Layout(params.terms, errors.names, recording.rate is not None, params.sensor)
    for name in params.hold:
        if name not in layout.names[6:15]:
            wanted = nearest(name, list(layout.names[6:15]))
            raise InputError("hold", f"'{name}'", wanted)
    return layout


def fastest_rate(recording: Recording) -> float:
    """Return the greatest rate (rad/s) measured, roughly; 0 where nothing says."""
    rates: list[Floats] = []
    if recording.rate is not None and len(recording.rate):
        rates.append(np.linalg.norm(recording.rate.values, axis=1))
    if recording.attitude is not None and len(recording.attitude) > 1:
        q, t = recording.attitude.values, recording.attitude.t
        cosine = np.clip(np.abs(np.sum(q[1:] * q[:-1], axis=1)), 0, 1)
        rates.append(2 * np.arccos(cosine) / np.diff(t))
    return max((float(np.percentile(r, 95)) for r in rates), default=0.0)


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


def problem_of(
    recording: Recording, testbed: Testbed, params: Params, torque_anchor: float = ANCHOR
) -> Problem:
    """Return the least-squares problem of a record."""
    errors = errors_of(recording, testbed)
    layout = layout_with(errors, recording, params)
    scale_open = is_scale_open(recording, testbed, params)
    hold = held_names(recording, testbed, params)
    prior = prior_of(testbed, errors, layout, params.use_prior, hold, torque_anchor)
    if params.typical:
        prior = with_typical_torques(prior, layout)
    limit = HUBER if params.robust else 0.0
    longest = longest_step(testbed, fastest_rate(recording), recording.rows) / params.fineness
    posed = pose(
        recording, testbed, layout, errors, prior, longest, limit, scale_open, params.jumps
    )
    return replace(posed, budget=params.budget)


def misfit(problem: Problem, point: Unknowns) -> float:
    """Return the rms residual vector in rad (with a camera) or rad/s."""
    return misfit_at(problem, evaluate(problem, point))


def misfit_at(problem: Problem, at: Evaluation) -> float:
    """Return the same of residuals that are at hand."""
    left = at.left_q * problem.observed.attitude_sd if len(at.left_q) else at.left_w
    square: Floats = np.sum(left**2, axis=1)
    return float(np.sqrt(np.mean(square)))


def approach(
    recording: Recording,
    testbed: Testbed,
    params: Params,
    point: Unknowns,
    most: float = 1.0,
) -> Unknowns:
    """Return a point from which the whole record can be fitted: fit a growing first part.

    The first is of the share ``most`` of the record, or as short as the point can be followed. Each
    is as much longer than the one before as its fit still predicts: a move of masses first shows a
    scale that was open till then, which half a swing behind it is far off.

    On the way the testbed's inertia counts as prior, torques are kept small and the camera counts
    as coarse, so that a part too short to show them, or a model that does not hold, cannot drive
    the search away.
    """
    start_t, end_t = recording.span
    coarse, guided = coarsened(testbed), replace(params, use_prior=True)

    def part(share: float) -> Recording:
        return window(recording, start_t, start_t + share * (end_t - start_t))

    def posed(share: float) -> tuple[Problem, Unknowns]:
        problem = problem_of(part(share), coarse, guided, GUIDED)
        return problem, at_rest(problem, point)

    share = most
    while share > SHORTEST and misfit(*posed(share)) > CAPTURE:
        share /= 2
    while True:
        found = settle(*posed(share))
        point = replace(found.point, error=point.error)
        if share >= 1.0 or not params.budget.allows(Stage.MOTION):
            return point
        predicted, growth = max(FOLLOWED, 2 * misfit_at(found.problem, found.at)), GROWTH
        while growth > SLOWEST and misfit(*posed(min(growth * share, 1.0))) > predicted:
            growth = growth**0.5
        share = min(growth * share, 1.0)


def few_swings(recording: Recording) -> float:
    """Return the first share of a long record to fit: ``FEW_SWINGS``, or more if it is sparse."""
    start_t, end_t = recording.span
    channels = [c.t for c in (recording.attitude, recording.rate) if c is not None]
    share, rows = FEW_SWINGS, np.concatenate(channels)
    while np.sum(rows < start_t + share * (end_t - start_t)) < FEW_ROWS:
        share *= 2
    return share


def coarsened(testbed: Testbed) -> Testbed:
    """Return the testbed with sensors that are no better than the model is early in the search."""
    camera, gyro = camera_noise(testbed), gyro_noise(testbed)
    return with_noise(testbed, max(camera, COARSE), max(gyro, COARSE))


def at_rest(problem: Problem, point: Unknowns) -> Unknowns:
    """Return a point with the displacement errors that a part of a record has, all zero."""
    return replace(point, error=np.zeros(len(problem.layout.errors)))


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
        grown = approach(recording, testbed, params, first, FEW)
        found = min(found, settle_pinned(problem, grown), key=cost_of)
    return found


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
