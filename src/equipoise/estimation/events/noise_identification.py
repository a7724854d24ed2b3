"""How noisy a record is: sensors' noise and process noise, set by the record itself.

Two ways, for two stages of a survey. While events are still unknown, by medians: half of all cuts
should be as surprised as chance has it, half of all residuals as large; what few events do does not
count. When they are known, by restricted maximum likelihood, which uses every row.

    walk^2 <- walk^2  sum u^2/sd^2 / sum (1 - C/sd^2),     noise^2 <- sum e^2 / (rows - unknowns)

with jumps u of smoothed covariance C (the fixed point of Helmert 1924; MacKay 1992). Both go to
their root by secant steps of ln walk. A walk that amounts to next to no unknown is left there.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import count
from typing import NamedTuple

import numpy as np

from equipoise.estimation.events.jump_test import KINDS, disturbances
from equipoise.estimation.events.record_model import (
    RecordModel,
    improbability,
    misfits,
    process_noise,
    refitted,
    smoothed,
)
from equipoise.estimation.motion.sensor_noise import (
    camera_noise,
    gyro_noise,
    vector_noise,
    with_noise,
    with_vector_noise,
)
from equipoise.estimation.output_error.initial_guess import stated_body
from equipoise.estimation.output_error.kernels.interval_smoother import Smoothed
from equipoise.estimation.output_error.multiple_shooting import shot_driven
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.output_error.segment_jumps import Jump
from equipoise.estimation.output_error.solution import Fitted, freedom
from equipoise.estimation.output_error.trajectory import problem_of
from equipoise.estimation.parameters.fit_parameters import RATE
from equipoise.estimation.search_budget import Stage
from equipoise.maths.secant_steps import Evaluated, secant_step
from equipoise.model.arrays import Bools, Floats, Series1, Vector3
from equipoise.model.estimate import RATE as RATES
from equipoise.model.testbed import Testbed
from equipoise.sensors.vector_sensors import CHANNELS as VECTORS

MEDIAN, MEDIAN_1 = 2.365973884375338, 0.454936423119572  # of chi-square of 3 and of 1
CALM, CHANCE = 0.1, 1.0  # chosen: noise known to 10 % is known; 1 / sqrt(rows), 1.7 sd of a median
CALIBRATIONS = 12
BEST = 0.02  # chosen: no sensor is fifty times better than stated
BOLDEST = 5.0  # factor by which a noise is changed at once; process noise lowered by its square
STEPS = 8
SETTLED = 0.02  # of ln of a noise, chosen: intervals change by a hundredth
IDLE = 0.1  # unknowns, chosen: process noise that amounts to less changes no estimate
STRETCH = 1.0  # s, chosen: camera rows within tell the rate, torques do not turn it by much
LEAST = 1e-3  # chosen: of the greatest process noise, so that no sd is zero
PRICE = 9.0  # chosen: -2 ln probability that process noise about three axes must gain


def quiet(model: RecordModel, cuts: Series1) -> Bools:
    """Return which cuts are away from every event."""
    calm = np.ones(len(cuts), dtype=bool)
    for event in model.events:
        calm &= np.abs(cuts - event.t) > 0.75 * model.spacing
    return calm


def surprises(calm: Bools, after: Smoothed) -> dict[str, Floats]:
    """Return the surprise of every cut for each kind of event; events themselves surprise not."""
    tests = {kind: disturbances(after, each.coordinates) for kind, each in KINDS.items()}
    return {kind: np.where(calm, test.surprise, 0.0) for kind, test in tests.items()}


def first_walk(model: RecordModel) -> float:
    """Return process noise that bends the motion by the misfit within ten cuts, N m sqrt(s)."""
    fit = model.fitted
    camera, gyro = misfits(fit)[:2]
    sd = fit.problem.observed.attitude_sd if len(camera) else fit.problem.observed.rate_sd
    left = float(np.sqrt(np.median(camera if len(camera) else gyro))) * sd
    moment = model.testbed.body.mean_moment
    span = 10 * model.spacing
    return moment * left / span ** (1.5 if len(camera) else 0.5)


def followed(model: RecordModel) -> RecordModel:
    """Return the model with process noise, and the fit that follows the motion with it.

    For a record whose plain fit is lost: torques that nobody knows may turn a spin by any angle.
    Begins at the stated body, and at the measured states (``multiple_shooting``).
    """
    recording, stated = model.recording, model.stated
    first = stated_body(stated, model.fitted.point)
    guided = replace(model.params, terms=(), use_prior=True)
    stride = max(1, int(STRETCH / model.spacing))
    times = model.cuts[::stride]

    def posed_with(joints: tuple[Jump, ...]) -> Problem:
        return problem_of(recording, model.testbed, replace(guided, jumps=joints))

    point, values = shot_driven(recording, stated, posed_with, first, times)
    moments = np.diag(stated.body.inertia_P)
    sd = np.sqrt(np.mean(values**2, axis=0) / (stride * model.spacing))
    driven = replace(model, walk=moments * np.maximum(sd, LEAST * sd.max()))
    jumps = tuple(Jump(float(t), RATES, (1.0, 1.0, 1.0)) for t in times)
    problem = problem_of(recording, model.testbed, replace(model.params, jumps=jumps))
    fitted = replace(model.fitted, problem=problem, point=point, jumps=values)
    return refitted(replace(driven, fitted=fitted))


def free_share(fit: Fitted, after: Smoothed) -> float:
    """Return the share of the rows that what was sought leaves free; a tenth at least."""
    sought = freedom(fit, after) + fit.problem.layout.size
    return max(1.0 - sought / fit.at.residuals, 0.1)


def noise_factors(fit: Fitted, after: Smoothed) -> tuple[float, ...]:
    """Return by how much the noise of each sensor (``misfits``) is off, by the median row."""
    share = free_share(fit, after)
    return tuple(
        float(np.sqrt(np.median(square) / MEDIAN / share)) if len(square) else 1.0
        for square in misfits(fit)
    )


def are_known(factors: Sequence[float], fit: Fitted) -> bool:
    """Say whether the noise of every sensor is near enough, for what its rows show."""
    rows = map(len, misfits(fit))
    return all(is_known(factor, n) for factor, n in zip(factors, rows, strict=True))


def is_known(factor: float, rows: int) -> bool:
    """Say whether a noise that is off by a factor is near enough, for what so many rows show."""
    return abs(np.log(factor)) < max(CALM, CHANCE / np.sqrt(max(rows, 1)))


def noisier(model: RecordModel, camera: float, gyro: float, *vectors: float) -> Testbed:
    """Return the testbed with its noise changed by these factors, within reason."""
    stated, factor = model.stated, dict[str, float](zip(VECTORS, vectors, strict=True))
    now, least = vector_noise(model.testbed), vector_noise(stated)
    noise = {name: max(sd * factor[name], BEST * least[name]) for name, sd in now.items()}
    testbed = with_vector_noise(model.testbed, noise)
    return with_noise(
        testbed,
        max(camera_noise(testbed) * camera, BEST * camera_noise(stated)),
        max(gyro_noise(testbed) * gyro, BEST * gyro_noise(stated)),
    )


def excesses(after: Smoothed, calm: Bools) -> Vector3:
    """Return, for each body axis, the median score of the cuts over what it should be."""
    test = disturbances(after, RATE)
    square = test.score**2 / np.einsum("kaa->ka", test.information)
    return np.sqrt(np.median(square[calm], axis=0) / MEDIAN_1)


def calibrated(model: RecordModel) -> tuple[RecordModel, dict[str, Floats], Fitted]:
    """Return the model with process noise and sensor noise as the record has them."""
    before: Evaluated | None = None
    for calibration in count():
        model = refitted(model)
        fit, after = smoothed(model)
        calm = quiet(model, np.array([jump.t for jump in fit.problem.jumps]))
        factors = noise_factors(fit, after)
        excess = np.log(np.maximum(excesses(after, calm), 1e-9))
        idle = (excess < 0) & (explained(fit, after).freedom < IDLE)
        steady = not model.wanders or bool(np.all((np.abs(excess) < CALM) | idle))
        found = (steady and are_known(factors, fit)) or calibration >= CALIBRATIONS
        if found or not model.may(Stage.NOISE):
            return model, surprises(calm, after), fit
        walk, before = stepped(model.walk, excess, before)
        testbed = noisier(model, *np.clip(factors, 1 / BOLDEST, BOLDEST))
        model = replace(model, walk=walk, testbed=testbed)
    raise AssertionError  # counting does not end


def stepped(
    walk: Vector3, excess: Vector3, before: Evaluated | None
) -> tuple[Vector3, Evaluated | None]:
    """Return the next process noise to try, given by how much ln of it is too small, and why."""
    if not np.all(walk > 0):
        return walk, None
    now = Evaluated(np.log(walk), excess)
    bold = np.log(BOLDEST)
    return walk * np.exp(np.clip(secant_step(now, before), -2 * bold, bold)), now


class Explained(NamedTuple):
    """What process noise about each body axis explains, and how many unknowns it amounts to."""

    square: Vector3  # sum u^2 / sd^2
    freedom: Vector3  # sum (1 - C / sd^2)


def explained(fit: Fitted, after: Smoothed) -> Explained:
    """Return what process noise explains in a fit: all zero where there is none."""
    noise, sd = process_noise(fit)
    if not any(noise):
        return Explained(np.zeros(3), np.zeros(3))
    u, spread = fit.jumps[noise, :3], np.einsum("kaa->ka", after.jump_covariance[noise, :3, :3])
    return Explained(np.sum(u**2 / sd**2, axis=0), np.sum(1 - spread / sd**2, axis=0))


def likeliest(model: RecordModel) -> RecordModel:
    """Return the model with the likeliest noise and process noise, as far as ``STEPS`` lead.

    What a variance explains is what it is free to: sum u^2 / sd^2 and sum (1 - C / sd^2) for
    jumps u of smoothed covariance C, and sum e^2 and the rows less all that was sought (the
    fixed point of restricted maximum likelihood; MacKay 1992, Helmert 1924).
    """
    before: Evaluated | None = None
    for _ in range(STEPS):
        fit, after = smoothed(model)
        square, freedom = explained(fit, after)
        share = free_share(fit, after)
        factors = [float(np.sqrt(np.mean(e) / 3 / share)) if len(e) else 1.0 for e in misfits(fit)]
        excess = 0.5 * np.log(np.maximum(square, 1e-9) / np.maximum(freedom, 1e-9))
        steady = np.all((np.abs(excess) < SETTLED) | (freedom < IDLE))
        settled = np.abs(np.log(np.maximum(factors, 1e-9))) < SETTLED
        if (steady and np.all(settled)) or not model.may(Stage.NOISE):
            break
        walk, before = stepped(model.walk, excess, before)
        walk = np.maximum(walk, LEAST * walk.max())
        model = refitted(replace(model, walk=walk, testbed=noisier(model, *factors)))
    return model


def weighed(record_model: RecordModel) -> RecordModel:
    """Return the model with the likeliest noise and process noise, or without the latter.

    The search begins at less process noise than the calibration left: of two that explain the
    record, the one that leaves more to the sensors is as a rule the likelier.
    """
    if not (record_model.wanders and record_model.may(Stage.NOISE)):
        return record_model
    trial = likeliest(refitted(replace(record_model, walk=0.3 * record_model.walk)))
    if not trial.may(Stage.NOISE):
        return record_model
    bare = refitted(replace(trial, walk=np.zeros(3)))
    for _ in range(3):
        fit, after = smoothed(bare)
        bare = refitted(replace(bare, testbed=noisier(bare, *noise_factors(fit, after))))
    worth = [improbability(model) for model in (record_model, trial, bare)]
    worth[2] -= PRICE
    return (record_model, trial, bare)[int(np.argmin(worth))]
