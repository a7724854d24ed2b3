"""Survey: what happened during a record, and how noisy it is, without being told.

A platform that is touched, or whose parts shift, moves on by the same laws from another state. So
the record is cut into short stretches with a little process noise between them, which keeps each
cut's test local and lets a model that is slightly wrong pass; then

1. the process noise (a torque that wanders) is set so that half of all cuts are as surprised as
   they should be, and the sensors' noise so that half of all rows are;
2. the greatest surprise beyond the threshold becomes an event: an unknown impulse, or a step of the
   centre of mass, whichever explains more; go to 1 until no cut is surprised;
3. each event is moved to the moment that explains most; those that do not earn their place when
   all are known are taken back; process noise that explains nothing is left out.

The threshold is that of one false alarm in ``FALSE_ALARM`` seconds if cuts were independent, which
they are not: the rate is lower.

Cannot see events below the threshold, nor two within one stretch; an impulse is told from a step of
the centre of mass only when the rows behind it swing.
"""

from dataclasses import replace
from itertools import count

import numpy as np
from scipy.stats import chi2

from equipoise.estimation.believed_model import (
    Believed,
    Happening,
    active,
    evidence,
    fitted_in,
    misfits,
    refitted,
    smoothed,
)
from equipoise.estimation.disturbances import disturbances
from equipoise.estimation.fitted import Fitted, freedom
from equipoise.estimation.model_choice import best_group, predicts_better, with_group
from equipoise.estimation.smoothing import Smoothed
from equipoise.estimation.trajectory import Params
from equipoise.estimation.unknowns import RATE, R
from equipoise.model.arrays import Floats, Series1, Vector3
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

FALSE_ALARM = 600.0  # s between false alarms, at most
MEDIAN, MEDIAN_1 = float(chi2.median(3)), float(chi2.median(1))
FINEST, MOST_CUTS = 0.1, 2000  # s, -; chosen: shorter than a touch, and what memory holds
ROWS = 2  # camera rows between cuts
WRONG = 1.4  # chosen: beyond this root of the median surprise over its due, process noise comes in
CALM, CHANCE = 0.1, 3.0  # chosen: noise known to 10 % is known; 3 / sqrt(rows), five sd of a median
CALIBRATIONS = 12
BEST = 0.02  # chosen: no sensor is fifty times better than stated
BOLDEST = 5.0  # factor by which a noise is changed at once
MOST_EVENTS = 40
KINDS = {"impulse": RATE, "com_step": R}
NEAR = 1.6  # spacings, chosen: events nearer than this may be one
FEWEST = 8  # cuts, chosen: below this a median says nothing
STEPS, ROUNDS = 8, 3
PRICE = 9.0  # chosen: -2 ln probability that process noise about three axes must gain
FEW = 4  # evaluations to compare neighbouring models by
Refused = set[tuple[str, ...]]


def cut_times(recording: Recording) -> Series1:
    """Return where to look for events: evenly, a few rows apart."""
    start, end = recording.span
    rows = recording.attitude or recording.rate
    assert rows is not None
    usual = ROWS * float(np.median(np.diff(rows.t)))
    spacing = max(usual, FINEST, (end - start) / MOST_CUTS)
    return np.arange(start + spacing, end - 0.5 * spacing, spacing)


def threshold(spacing: float) -> float:
    """Return the surprise beyond which a cut is an event."""
    return float(chi2.isf(spacing / FALSE_ALARM / len(KINDS), 3))


def quiet(belief: Believed, cuts: Series1) -> Floats:
    """Return which cuts are away from every event."""
    far = np.ones(len(cuts), dtype=bool)
    for event in belief.events:
        far &= np.abs(cuts - event.t) > 0.75 * belief.spacing
    return far


def surprises(far: Floats, after: Smoothed) -> dict[str, Floats]:
    """Return the surprise of every cut for each kind of event; events themselves surprise not."""
    tests = {kind: disturbances(after, columns) for kind, columns in KINDS.items()}
    return {kind: np.where(far, test.surprise, 0.0) for kind, test in tests.items()}


def first_walk(belief: Believed) -> float:
    """Return process noise that bends the motion by the misfit within ten cuts, N m sqrt(s)."""
    fit = belief.fitted
    camera, gyro = misfits(fit)
    sd = fit.problem.seen.attitude_sd if len(camera) else fit.problem.seen.rate_sd
    left = float(np.sqrt(np.median(camera if len(camera) else gyro))) * sd
    moment = float(np.trace(belief.testbed.body.inertia_P)) / 3
    span = 10 * belief.spacing
    return moment * left / span ** (1.5 if len(camera) else 0.5)


def noise_factors(belief: Believed, fit: Fitted, after: Smoothed) -> tuple[float, float]:
    """Return by how much the camera's and the gyro's noise are off, by the median row."""
    camera, gyro = misfits(fit)
    rows = 3 * (len(camera) + len(gyro))
    left = max(1.0 - (freedom(fit, after) + fit.problem.layout.size) / rows, 0.1)
    factors = [
        float(np.sqrt(np.median(square) / MEDIAN / left)) if len(square) else 1.0
        for square in (camera, gyro)
    ]
    return factors[0], factors[1]


def is_known(factor: float, rows: int) -> bool:
    """Say whether a noise that is off by a factor is near enough, for what so many rows tell."""
    return abs(np.log(factor)) < max(CALM, CHANCE / np.sqrt(max(rows, 1)))


def noisier(belief: Believed, camera: float, gyro: float) -> Testbed:
    """Return the testbed with its noise changed by these factors, within reason."""
    testbed, stated = belief.testbed, belief.stated
    attitude, rate = testbed.attitude, testbed.gyro
    least_q = BEST * stated.attitude.noise if stated.attitude else 0.0
    least_w = BEST * stated.gyro.noise if stated.gyro else 0.0
    return replace(
        testbed,
        attitude=attitude and replace(attitude, noise=max(attitude.noise * camera, least_q)),
        gyro=rate and replace(rate, noise=max(rate.noise * gyro, least_w)),
    )


def excesses(after: Smoothed, far: Floats) -> Vector3:
    """Return, for each body axis, the median score of the cuts over what it should be."""
    test = disturbances(after, RATE)
    square = test.score**2 / np.einsum("kaa->ka", test.information)
    return np.sqrt(np.median(square[far], axis=0) / MEDIAN_1)


def calibrated(belief: Believed) -> tuple[Believed, dict[str, Floats], Fitted]:
    """Return the belief with process noise and sensor noise as the record has them."""
    for calibration in count():
        belief = refitted(belief)
        fit, after = smoothed(belief)
        far = quiet(belief, np.array([jump.t for jump in fit.problem.jumps]))
        surprise, excess = surprises(far, after), excesses(after, far)
        if not belief.wanders and excess.max() > WRONG:
            belief = replace(belief, walk=np.full(3, first_walk(belief)))
            continue
        factors = noise_factors(belief, fit, after)
        steady = not belief.wanders or bool(np.all(np.abs(np.log(excess)) < CALM))
        camera, gyro = (len(rows) for rows in (fit.at.left_q, fit.at.left_w))
        known = is_known(factors[0], camera) and is_known(factors[1], gyro)
        if (steady and known) or calibration >= CALIBRATIONS:
            return belief, surprise, fit
        bold = np.clip(excess, 1 / BOLDEST, BOLDEST)
        testbed = noisier(belief, *np.clip(factors, 1 / BOLDEST, BOLDEST))
        belief = replace(belief, walk=belief.walk * bold, testbed=testbed)
    raise AssertionError  # counting does not end


def most_surprising(
    belief: Believed, surprise: dict[str, Floats], fit: Fitted
) -> tuple[Happening, float]:
    """Return the event that explains most, and its surprise above the threshold."""
    kind = max(surprise, key=lambda name: float(np.max(surprise[name], initial=0.0)))
    k = int(np.argmax(surprise[kind]))
    event = Happening(fit.problem.jumps[k].t, kind)
    return event, float(surprise[kind][k]) - threshold(belief.spacing)


def moved(belief: Believed, k: int, shift: float) -> Believed:
    """Return the belief with one event moved by a share of the spacing."""
    event = belief.events[k]
    there = replace(event, t=event.t + shift * belief.spacing)
    events = (*belief.events[:k], there, *belief.events[k + 1 :])
    trial = replace(belief, events=events)
    return replace(trial, fitted=fitted_in(trial, active(trial), FEW))


def timed(belief: Believed) -> Believed:
    """Return the belief with each event at the moment that explains most, to a quarter spacing."""
    start, end = belief.recording.span
    for k in range(len(belief.events)):
        for reach in (1.0, 0.5, 0.25):
            t = belief.events[k].t
            shifts = [s for s in (-reach, 0.0, reach) if start < t + s * belief.spacing < end]
            trials = [moved(belief, k, s) for s in shifts]
            belief = min(trials, key=lambda trial: trial.fitted.at.cost)
    return refitted(belief)


def weakest(belief: Believed) -> tuple[float, int]:
    """Return the least chi-square with which an event differs from nothing, and which it is."""
    fit, after = smoothed(belief)
    values: list[float] = []
    for event in belief.events:
        k = [abs(jump.t - event.t) < 1e-9 for jump in fit.problem.jumps].index(True)
        jump = fit.jumps[k, :3]
        values.append(float(jump @ np.linalg.solve(after.jump_covariance[k, :3, :3], jump)))
    least = int(np.argmin(values))
    return values[least], least


def pruned(belief: Believed) -> Believed:
    """Return the belief without the events that do not earn their place."""
    while belief.events:
        value, k = weakest(belief)
        if value > threshold(belief.spacing):
            break
        events = belief.events[:k] + belief.events[k + 1 :]
        belief = refitted(replace(belief, events=events))
    return belief


def likelier(belief: Believed) -> Believed:
    """Return the belief with noise and process noise one step nearer to the likeliest.

    What a variance explains over what it is free to: sum u^2 / sd^2 over sum (1 - C / sd^2) for
    jumps u of smoothed covariance C, and sum e^2 over the rows less all that was sought (the
    fixed point of restricted maximum likelihood; MacKay 1992, Helmert 1924).
    """
    fit, after = smoothed(belief)
    noise = [bool(jump.names) and not jump.is_event for jump in fit.problem.jumps]
    sd = np.array([jump.sd for jump, one in zip(fit.problem.jumps, noise, strict=True) if one])
    u, spread = fit.jumps[noise, :3], np.einsum("kaa->ka", after.jump_covariance[noise, :3, :3])
    told = np.maximum(np.sum(1 - spread / sd**2, axis=0), 1e-9)
    walk = belief.walk * np.sqrt(np.sum(u**2 / sd**2, axis=0) / told)
    camera, gyro = misfits(fit)
    share = 1 - (freedom(fit, after) + fit.problem.layout.size) / (3 * (len(camera) + len(gyro)))
    factors = [
        float(np.sqrt(np.mean(e) / 3 / max(share, 0.1))) if len(e) else 1.0 for e in (camera, gyro)
    ]
    return refitted(replace(belief, walk=walk, testbed=noisier(belief, *factors)))


def weighed(belief: Believed) -> Believed:
    """Return the belief with the likeliest noise and process noise, or without the latter.

    The search begins at less process noise than the calibration left: of two that explain the
    record, the one that leaves more to the sensors is as a rule the likelier.
    """
    if not belief.wanders:
        return belief
    trial = refitted(replace(belief, walk=0.3 * belief.walk))
    for _ in range(STEPS):
        trial = likelier(trial)
    bare = refitted(replace(trial, walk=np.zeros(3)))
    for _ in range(3):
        fit, after = smoothed(bare)
        bare = refitted(replace(bare, testbed=noisier(bare, *noise_factors(bare, fit, after))))
    worth = [evidence(*smoothed(model)) for model in (belief, trial, bare)]
    worth[2] -= PRICE
    return (belief, trial, bare)[int(np.argmin(worth))]


def extended(belief: Believed, group: tuple[str, ...], refused: Refused) -> Believed:
    """Return the belief with a group of terms, if that predicts better; refuse it otherwise."""
    richer = refitted(with_group(belief, group))
    if predicts_better(belief, richer):
        return richer
    refused.add(group)
    return belief


def searched(belief: Believed) -> Believed:
    """Return the belief with all terms that the record supports and all events that surprise.

    What promises most beyond its own threshold goes first.
    """
    refused: Refused = set()
    while len(belief.events) < MOST_EVENTS:
        belief, surprise, fit = calibrated(belief)
        group, gained = best_group(belief, refused)
        event, surprising = most_surprising(belief, surprise, fit)
        if max(gained, surprising) <= 0:
            break
        if gained > surprising:
            belief = extended(belief, group, refused)
        else:
            belief = replace(belief, events=(*belief.events, event))
    return belief


def merged(belief: Believed) -> Believed:
    """Return the belief with neighbouring events as one, where one explains as much as two.

    A touch between two cuts first shows as an event at either.
    """
    k = 0
    belief = replace(belief, events=tuple(sorted(belief.events, key=lambda event: event.t)))
    while k + 1 < len(belief.events):
        one, two = belief.events[k], belief.events[k + 1]
        near = one.kind == two.kind and two.t - one.t < NEAR * belief.spacing
        if near:
            middle = replace(one, t=0.5 * (one.t + two.t))
            events = (*belief.events[:k], middle, *belief.events[k + 2 :])
            trial = refitted(replace(belief, events=events))
            if 2 * (trial.fitted.at.cost - belief.fitted.at.cost) < threshold(belief.spacing):
                belief = trial
                continue
        k += 1
    return belief


def settled(belief: Believed) -> Believed:
    """Return the belief with its events in their place and none that is not needed."""
    return pruned(timed(merged(belief))) if belief.events else belief


def survey(recording: Recording, testbed: Testbed, params: Params, fitted: Fitted) -> Believed:
    """Return the model that the record supports, and the fit in it."""
    cuts = cut_times(recording)
    if len(cuts) < FEWEST or not np.isfinite(fitted.at.cost):
        cuts = np.zeros(0)
    belief = Believed(recording, testbed, params, cuts, np.zeros(3), (), fitted, testbed)
    for _ in range(ROUNDS if len(cuts) else 0):
        before = len(belief.events)
        belief = weighed(settled(searched(belief)))
        if not belief.wanders or len(belief.events) == before:
            break
    return belief
