"""Smoother: the trajectory fit of a platform whose centre of mass drifts, at every time.

The whole record is fitted as in ``trajectory``; com walks meanwhile,

    r(t_(k+1)) = r(t_k) + u_k,   u_k ~ N(0, w^2 dt)         t_0, t_1, ...: nodes, evenly, dt apart

r changes half way between nodes, so that the r of a stretch is that of the node in its middle; the
first and the last stretch are half as long, their nodes the ends of the record. What is most
probable given all rows (maximum a posteriori) is, all being normal, the fixed-interval smoother
(Rauch, Tung and Striebel 1965), here about the whole non-linear motion and solved as ``segments``
says; at the last node it equals a filter that has had all rows.

w is one number an axis, from the record (``drift_intensity``), and more where com went one way for
long, which a walk of that size would not (``process_noise_spectrum``); the jumps are not taken as
information on the scale of J and com (``drift_scale``). Between nodes r is off by another
w sqrt(dt/12) rms about its stretch's, which no sd counts.

``com`` is that of the first moment, ``com_end`` that of the last with the masses as they stand; the
course has r with the masses at home, drift terms included.

Cannot see what ``trajectory`` cannot see; a drift along gravity without tilt; a drift from other
slow torques. A drift at a constant rate is not a walk: where the record shows it badly, beside a
camera that leans, com may be off by two stated sd; ask for the terms ``drift`` then.
"""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from equipoise.dynamics.regressor import DRIFT
from equipoise.estimation.events.process_noise_spectrum import densest
from equipoise.estimation.model_selection.initial_model import anchored
from equipoise.estimation.output_error.drift_intensity import gain, likely_steps, linear_at
from equipoise.estimation.output_error.drift_scale import disbelieved, untied
from equipoise.estimation.output_error.fit_estimate import UNSETTLED, conclude, widening
from equipoise.estimation.output_error.fixed_parameters import settle_pinned
from equipoise.estimation.output_error.free_vertical import with_free_vertical
from equipoise.estimation.output_error.kernels.interval_smoother import Smoothed
from equipoise.estimation.output_error.problem import Prior
from equipoise.estimation.output_error.segment_jumps import Jump, walk
from equipoise.estimation.output_error.solution import Fitted, smooth_at
from equipoise.estimation.output_error.toward_stated import tried
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.estimation.parameters.fit_parameters import R, unknowns_of
from equipoise.estimation.search_budget import Stage, cut_short
from equipoise.estimation.tracker import tracker
from equipoise.model.arrays import Floats, Series, Series1, Vector3
from equipoise.model.estimate import COM, Course, Estimate
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason, axes_of
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import Testbed

METHOD = "smoother"
COM_WALK = tracker.Params().com_walk  # m/sqrt(s), expected
FINEST, MOST_CUTS = 0.5, 300  # s, -; chosen: a good gyro sees 0.05 um/sqrt(s) within a second
ROUNDS, COLOUR_ROUNDS = 2, 2  # chosen: the motion is all but linear in where com drifts
OBSERVED = 9.0  # chosen: -2 ln probability that chance gains once in 700 records


@dataclass(frozen=True, slots=True, eq=False)
class Drifting:
    """A fit in which the centre of mass walks."""

    fitted: Fitted
    nodes: Series1  # s
    names: tuple[str, ...]  # of the axes that walk
    sd: Floats  # m, of their steps
    prior: Prior  # of the problem as posed
    gained: float  # -2 ln probability, over no walk


def node_times(recording: Recording) -> Series1:
    """Return the nodes (s): evenly from the first row to the last."""
    first, last = recording.span
    count = int(np.clip(np.ceil((last - first) / FINEST), 1, MOST_CUTS))
    return np.linspace(first, last, count + 1)


def walking(nodes: Series1, names: tuple[str, ...], sd: Floats) -> tuple[Jump, ...]:
    """Return a walk with steps of these sd (m) half way between nodes."""
    return walk((nodes[1:] + nodes[:-1]) / 2, names, sd)


def begun(recording: Recording, testbed: Testbed, params: Params) -> Drifting:
    """Return the optimum with the walk that is expected."""
    nodes = node_times(recording)
    names = tuple(name for name in COM if name not in params.hold)
    sd = np.full(len(names), COM_WALK * float(np.sqrt(nodes[1] - nodes[0])))
    params = replace(
        with_free_vertical(recording, testbed, params), jumps=walking(nodes, names, sd)
    )
    _, fitted = anchored(recording, testbed, params, fit(recording, testbed, params))
    return Drifting(fitted, nodes, names, sd, fitted.problem.prior, 0.0)


def refitted(found: Drifting, sd: Floats, up: Vector3) -> Drifting:
    """Return the fit with steps of these sd (m)."""
    fitted = found.fitted
    problem = replace(fitted.problem, jumps=walking(found.nodes, found.names, sd))
    problem = untied(problem, found.prior, fitted, up)
    return replace(found, fitted=settle_pinned(problem, fitted.point, fitted.jumps), sd=sd)


def calibrated(found: Drifting, expected: float, up: Vector3) -> Drifting:
    """Return the fit with the walk that the record supports; ``expected`` is the sd of a step."""
    problem, at = linear_at(found.fitted)
    sd = likely_steps(problem, at, expected)
    return replace(refitted(found, sd, up), gained=gain(problem, at, sd, expected))


def coloured(found: Drifting, up: Vector3) -> Drifting:
    """Return the fit with a walk as dense as where it is densest (``process_noise_spectrum``)."""
    steps = found.fitted.jumps[:, : len(found.sd)] / found.sd
    return refitted(found, found.sd * np.sqrt(densest(steps, 1)), up)


def drifting(recording: Recording, testbed: Testbed, params: Params) -> Drifting:
    """Return the optimum with a walk of com as the record shows it."""
    found, up = begun(recording, testbed, params), testbed.up
    if not found.names or not np.isfinite(found.fitted.at.cost):
        return found
    expected = float(found.sd[0])
    rounds = [partial(calibrated, expected=expected)] * ROUNDS + [coloured] * COLOUR_ROUNDS
    for improved in rounds:
        if not params.budget.allows(Stage.DRIFT):
            break
        found = improved(found, up=up)
    return replace(found, fitted=disbelieved(found.fitted, up))


def com_rows(found: Drifting) -> Floats:
    """Return the derivative of r at every node by the unknowns of its stretch, (K, 3, n)."""
    layout, nodes = found.fitted.problem.layout, found.nodes
    rows = np.zeros((len(nodes), 3, layout.size))
    rows[:, :, R] = np.eye(3)
    for j, axis in enumerate("xyz"):
        if f"drift_{axis}" in layout.terms:
            rows[:, j, layout.names.index(f"drift_{axis}")] = nodes - nodes[0]
    return rows


def com_values(found: Drifting, after: Smoothed) -> Series:
    """Return r (m) at every node, masses at home."""
    rate = found.fitted.point.torque[DRIFT : DRIFT + 3]
    home = np.array([unknowns_of(point).com for point in after.points])
    return home + np.outer(found.nodes - found.nodes[0], rate)


def course_of(found: Drifting, after: Smoothed, concluded: Estimate) -> Course:
    """Return r along the record; its intervals are those of the estimate where that begins."""
    rows, factor = com_rows(found), widening_of(concluded)
    spread = factor**2 * np.einsum("kij,kjl,kil->ki", rows, after.covariance, rows, optimize=True)
    beside = np.diag(concluded.covariance_of(COM)) - spread[0]  # of what no fit seeks
    sd = np.sqrt(np.maximum(spread + beside, 0.0))
    observed = [concluded.sees((name,)) for name in COM]
    return Course(COM, found.nodes, com_values(found, after), np.where(observed, sd, np.inf))


def widening_of(concluded: Estimate) -> float:
    """Return by how much the estimate's intervals are wider than rows say that err as stated."""
    assert concluded.residual is not None
    return widening(concluded.residual)


def moved(found: Drifting, after: Smoothed) -> tuple[Vector3, Vector3]:
    """Return how far r went from the first moment to the last, and its sd (m)."""
    values, rows = com_values(found, after), com_rows(found)
    first, last = rows[0], rows[-1]
    across = last @ after.onward @ after.covariance[0] @ first.T
    spread = first @ after.covariance[0] @ first.T + last @ after.covariance[-1] @ last.T
    return values[-1] - values[0], np.sqrt(np.diag(spread - across - across.T))


def drift_reason(found: Drifting, after: Smoothed, concluded: Estimate) -> Reason:
    """Return how much the centre of mass drifts."""
    if not concluded.sees(COM):
        return Reason(Why.DRIFT_UNOBSERVABLE)
    way, sd = moved(found, after)
    numbers = axes_of("way", way) | axes_of("sd", widening_of(concluded) * sd)
    return Reason(Why.NO_DRIFT if found.gained < OBSERVED else Why.DRIFTS, (), numbers)


def estimate(recording: Recording, testbed: Testbed, params: Params) -> Estimate:
    """Return the estimate of a record, with the course of com."""
    recording = arranged(recording, testbed.mass_names)
    found = drifting(recording, testbed, params)
    try:
        plain = conclude(found.fitted, METHOD, recording)
        concluded = tried(plain, found.fitted, testbed, params.budget)
        concluded = cut_short(concluded, params.budget.unfinished)
        if not found.fitted.converged:
            return concluded
        after = smooth_at(found.fitted)
        return with_course(found, after, concluded)
    except np.linalg.LinAlgError:  # so far from the record, its information has no inverse
        return Estimate(METHOD, UNSETTLED, (), np.zeros((0, 0)))


def with_course(found: Drifting, after: Smoothed, concluded: Estimate) -> Estimate:
    """Return the estimate with the course of com, and with what is to be said of it."""
    outcome = concluded.outcome
    if outcome.usable:
        outcome = Outcome((*outcome.reasons, drift_reason(found, after, concluded)))
    return replace(concluded, outcome=outcome, course=course_of(found, after, concluded))
