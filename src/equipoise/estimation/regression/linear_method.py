"""A linear method: a formulation's rows, solved; with intervals that know what noise does to them.

    x = solver( formulation( record ) )

The covariance and the bias that noise in the regressor brings are found by drawing the stated
errors anew (``replicates``). The same draws say what noise leaves of the rows at each frequency.
Where the record leaves more than that, something acts that the model does not know, and no
parameter errs by more than the root of the greatest ratio (Grenander and Szegoe 1958, as in
``maths.whiteness``): by so much all intervals are wider.

What is left is judged without the bias, and without what the formulation is known to leave out.
A bias, what a formulation leaves out of the motion (``Rows.omitted``) and what smoothing a camera's
rows blurs are errors that no repetition shows. They are reported, and added to the sd as if they
were chance.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import scipy

from equipoise.estimation.method_contract import Method, Options, refused
from equipoise.estimation.motion.fused_motion import at_times, led_motion
from equipoise.estimation.regression.formulations.rows import (
    Formulation,
    Posed,
    Rows,
    centred,
    held,
)
from equipoise.estimation.regression.linear_estimate import Answer, Shifts, conclude
from equipoise.estimation.regression.monte_carlo_replicates import PAIRS, Drawn, pairs
from equipoise.estimation.regression.solvers.least_squares import Aid, Solver, least_squares
from equipoise.estimation.regression.solvers.recursion import Plan, passed, recursive
from equipoise.maths.chi_square import chi_square_limit
from equipoise.model import torque_terms
from equipoise.model.arrays import Floats, Series, Square
from equipoise.model.estimate import INERTIA, NORMAL_95, Estimate
from equipoise.model.method_card import Card
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.recording import Recording, Samples, arranged
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import measured_at

FEWEST = 12  # times
FOR_NOISE = 6  # pairs, chosen: the mean of dA^T dA over thousands of rows is known well from few
SPARE = 12  # pairs beyond the number of unknowns
FIRST_BAND, WIDER = 5, 1.6  # bins, and how much wider each band is than the one before, chosen
CHANCE = 3.0  # sd of the mean, within which a bias is none
SURE = 1e-4  # how often noise alone may exceed the test


@dataclass(frozen=True, slots=True)
class Linear:
    """What makes a linear method."""

    formulation: Formulation
    solver: Solver = least_squares
    knows_inertia: bool = False  # takes the testbed's inertia as it is
    needs_noise: bool = False  # the solver uses what noise does to the regressor
    plan: Plan | None = None  # of a recursion, whose course is reported


class Question(NamedTuple):
    """What is asked of a linear method about a record."""

    linear: Linear
    posed: Posed
    rows: Rows
    hold: tuple[str, ...]
    draws: Sequence[tuple[Posed, Posed]]


class Sums(NamedTuple):
    """What the replicates add up to."""

    covariance: Square  # (c, c)
    bias: Floats  # (c,)
    power: Floats  # (bins,) mean power of what noise leaves


def recursion(
    card: Card, formulation: Formulation, plan: Plan, knows_inertia: bool = False
) -> Method:
    """Return a method that goes along the rows."""
    return method(card, Linear(formulation, recursive(plan), knows_inertia, plan=plan))


@dataclass(frozen=True, slots=True)
class LinearRun:
    """The estimator of a linear method, with the parts of which it is made."""

    card: Card
    linear: Linear

    def __call__(self, recording: Recording, testbed: Testbed, options: Options) -> Estimate:
        """Return the estimate of a record."""
        posed = posed_of(recording, testbed, options)
        return estimate(self.card, self.linear, posed, options.hold)


def method(card: Card, linear: Linear) -> Method:
    """Return the method."""
    return Method(card, LinearRun(card, linear))


def linear_of(method: Method) -> Linear | None:
    """Return the parts of a linear method; None for any other."""
    return method.run.linear if isinstance(method.run, LinearRun) else None


def posed_of(recording: Recording, testbed: Testbed, options: Options) -> Posed:
    """Return what formulations are given."""
    recording = arranged(recording, testbed.mass_names)
    terms = torque_terms.among((*testbed.disturbances, *options.terms))
    return Posed(recording, testbed, led_motion(recording, testbed), terms)


def estimate(
    card: Card,
    linear: Linear,
    posed: Posed,
    hold: tuple[str, ...],
    draws: Sequence[tuple[Posed, Posed]] | None = None,
) -> Estimate:
    """Return the estimate; ``draws`` are the record's replicates where they are at hand."""
    n = len(posed.motion.t)
    if n < FEWEST:
        return refused(card, Why.TOO_FEW_ROWS_WITHOUT_GAP, rows=n)
    rows, fixed = posed_rows(linear, posed, hold)
    if rows.b.size <= len(rows.names) or len(rows.t) < FEWEST:
        return refused(card, Why.TOO_FEW_ROWS_WITHOUT_GAP, rows=len(rows.t))
    if draws is None:
        what = Drawn(inertia=linear.knows_inertia)
        draws = tuple(pairs(posed, what, max(PAIRS, len(rows.names) + SPARE)))
    try:
        answer = answered(Question(linear, posed, rows, fixed, draws))
    except np.linalg.LinAlgError:
        return refused(card, Why.HARDLY_MOVED)
    pinned = tuple(name for name in fixed if name not in hold)
    return conclude(card, posed, rows, answer, pinned)


def posed_rows(linear: Linear, posed: Posed, hold: tuple[str, ...]) -> tuple[Rows, tuple[str, ...]]:
    """Return the rows with what is held on the other side; one moment, if the scale is open."""
    free = linear.formulation(posed)
    rows = held(free, posed.testbed, hold)
    if np.any(rows.b) or not set(rows.names) & set(INERTIA):
        return rows, hold
    largest = INERTIA[int(np.argmax(np.diag(posed.testbed.body.inertia_P)))]
    hold = (largest, *hold)
    return held(free, posed.testbed, hold), hold


def answered(requested: Question) -> Answer:
    """Return solution, covariance, bias and how much more than noise is left."""
    linear, rows = requested.linear, requested.rows
    aid = aid_for(requested)
    best = linear.solver(rows, aid)
    again = aid._replace(gram=2 * aid.gram, cross=2 * aid.cross)  # of noise that is in it twice
    sums = summed(requested, again, best)
    whole, omitted = rows, np.zeros(len(best))
    if rows.omitted is not None:
        omitted = least_squares(replace(rows, b=rows.omitted, omitted=None), aid)
        whole = replace(rows, b=rows.b - rows.omitted, omitted=None)
    left = remains(whole, best - sums.bias - omitted)
    blurred = blur(requested, aid, best)
    spread = (scipy.special.stdtrit(len(requested.draws), 0.975) / NORMAL_95) ** 2 * sums.covariance
    course = None if linear.plan is None else passed(linear.plan, requested.posed.testbed, rows)
    shifts = Shifts(sums.bias, omitted, blurred)
    return Answer(best, spread, shifts, left, excess(left, sums.power), course)


def blur(requested: Question, aid: Aid, best: Floats) -> Floats:
    """Return what smoothing a camera's rows does to the solution: what doing so again would do.

    A gyro shows quick motion as it is; a camera alone shows it smoothed over seconds.
    """
    recording, motion = requested.posed.recording, requested.posed.motion
    camera = recording.attitude
    if recording.rate is not None or camera is None:
        return np.zeros(len(best))
    observed = measured_at(camera.t, requested.posed.testbed.attitude)
    smooth = replace(recording, attitude=Samples(camera.t, at_times(motion.t, motion.q, observed)))
    again = led_motion(smooth, requested.posed.testbed)
    posed = Posed(smooth, requested.posed.testbed, again, requested.posed.terms)
    return requested.linear.solver(rows_again(requested, posed), aid) - best


def aid_for(requested: Question) -> Aid:
    """Return what the solver may use: the noise of centred rows, from a few draws.

    Of noise alone: what is off by the same all along is no scatter that could be taken off.
    """
    unknowns = len(requested.rows.names)
    gram, cross = np.zeros((unknowns, unknowns)), np.zeros(unknowns)
    count = FOR_NOISE if requested.linear.needs_noise else 0
    for pair in pairs(requested.posed, Drawn(constant=False), count):
        first, second = (centred(rows_again(requested, each)) for each in pair)
        dA = 0.5 * (first.A - second.A).reshape(-1, unknowns)
        db = 0.5 * (first.b - second.b).reshape(-1)
        gram += dA.T @ dA / FOR_NOISE
        cross += dA.T @ db / FOR_NOISE
    return Aid(requested.posed.testbed, gram, cross)


def rows_again(requested: Question, drawn: Posed) -> Rows:
    """Return the rows of a replicate; what is held stays at the testbed's own value."""
    return held(requested.linear.formulation(drawn), requested.posed.testbed, requested.hold)


def remains(rows: Rows, values: Floats) -> Series:
    """Return what is left of the rows (n, m)."""
    rows = centred(rows)
    return rows.b - rows.A @ values


def summed(requested: Question, aid: Aid, best: Floats) -> Sums:
    """Return what the replicates add up to."""
    c, count = len(best), len(requested.draws)
    covariance, middles, power = np.zeros((c, c)), list[Floats](), np.zeros(1)
    for pair in requested.draws:
        again = [rows_again(requested, each) for each in pair]
        plus, minus = (requested.linear.solver(each, aid) for each in again)
        half = 0.5 * (plus - minus)
        covariance += np.outer(half, half) / count
        middles.append(0.5 * (plus + minus) - best)
        noise = 0.5 * (remains(again[0], plus) - remains(again[1], minus))
        power = power + spectrum(noise) / count
    return Sums(covariance, beyond_chance(np.array(middles)), power)


def beyond_chance(middles: Series) -> Floats:
    """Return the mean of the pairs' middles (n, c), none where chance explains it."""
    mean = middles.mean(axis=0)
    return np.where(np.abs(mean) > CHANCE * middles.std(axis=0) / len(middles) ** 0.5, mean, 0.0)


def spectrum(left: Series) -> Floats:
    """Return the power of rows at each frequency, summed over equations."""
    return np.sum(np.abs(np.fft.rfft(left, axis=0)) ** 2, axis=1)


def bands(bins: int) -> list[slice]:
    """Return the bands over which powers are compared: narrow where motion is slow."""
    found, first, width = list[slice](), 1, float(FIRST_BAND)
    while first < bins:
        found.append(slice(first, min(first + round(width), bins)))
        first, width = found[-1].stop, width * WIDER
    return found


def excess(left: Series, expected: Floats) -> float:
    """Return the greatest ratio of what is left to what noise leaves, 1 if chance explains it."""
    found, equations, power = 1.0, left.shape[1], spectrum(left)
    for band in bands(len(power)):
        freedom = 2 * equations * (band.stop - band.start)
        ratio = float(np.sum(power[band])) / max(float(np.sum(expected[band])), 1e-300)
        if ratio > chi_square_limit(freedom, SURE) / freedom:
            found = max(found, ratio)
    return found
