"""A model of a record under survey: its noise, process noise and events, and the fit in it.

Process noise is a torque that wanders, as white noise of density ``walk`` about each body
axis; over a stretch of length dt it jumps the rate by walk_i sqrt(dt) / J_ii.
"""

import itertools
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from equipoise.dynamics.hanging_torque import HangingTorque
from equipoise.estimation.events.jump_test import KINDS, threshold
from equipoise.estimation.motion.observed_vectors import observed
from equipoise.estimation.output_error.fixed_parameters import settle_pinned
from equipoise.estimation.output_error.kernels.interval_smoother import Smoothed
from equipoise.estimation.output_error.problem import Problem, posed
from equipoise.estimation.output_error.segment_jumps import Jump, carried, inside, walk
from equipoise.estimation.output_error.solution import Fitted, cost_of, finite_cost, smooth_at
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.estimation.parameters.fit_parameters import Unknowns, with_errors_of
from equipoise.estimation.search_budget import Stage
from equipoise.maths.linalg import inverse_spd
from equipoise.model.arrays import Bools, Floats, Series1, Square, Vector3
from equipoise.model.estimate import RATE
from equipoise.model.modes import FreeMode
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import TERMS, typical_sizes
from equipoise.sensors.vector_sensors import CHANNELS as VECTORS

EACH = 60  # evaluations, chosen: twice what a fit takes that settles


@dataclass(frozen=True, slots=True)
class Happening:
    """An event of the model."""

    t: float  # s
    kind: str  # of ``KINDS``
    unclear: bool = False  # it may as well be of another kind: both may jump
    aside: float = 0.0  # s, by which the moment of the other kind differs

    @property
    def jump(self) -> Jump:
        """Return what may jump then, that of its own kind first."""
        others = [kind for kind in KINDS if kind != self.kind] if self.unclear else []
        jumping = [KINDS[kind] for kind in (self.kind, *others)]
        pairs = [(name, kind.sd) for kind in jumping for name in kind.names]
        names, sd = zip(*pairs, strict=True)
        return Jump(self.t, names, sd, is_event=True)


@dataclass(frozen=True, slots=True, eq=False)
class RecordModel:
    """A model of a record, and the fit in it."""

    recording: Recording
    testbed: Testbed  # with the noise as estimated
    params: Params  # without jumps
    cuts: Series1  # s, where an event may be found
    walk: Vector3  # N m sqrt(s)
    events: tuple[Happening, ...]
    fitted: Fitted
    stated: Testbed  # with the noise as it was stated
    coloured: float = 1.0  # times an interval is as wide as rows say that err independently
    unfinished: tuple[Stage, ...] = ()  # of the search, when its budget was spent
    rivals: tuple["Rival", ...] = ()  # models that are about as likely
    modes: tuple[FreeMode, ...] = ()  # what is not rigid, as ``params.modal`` has it
    hanging: HangingTorque | None = None  # so is this

    def may(self, stage: Stage) -> bool:
        """Say whether the search of this model may go on."""
        return self.params.budget.allows(stage)

    @property
    def wanders(self) -> bool:
        """Say whether there is process noise."""
        return bool(np.any(self.walk > 0))

    @property
    def spacing(self) -> float:
        """Return the time between cuts, s."""
        return float(self.cuts[1] - self.cuts[0]) if len(self.cuts) > 1 else 1.0


class Rival(NamedTuple):
    """A model that was not taken, and by how much the record is less probable in it."""

    model: RecordModel
    behind: float  # -2 ln of the ratio


def jumps_of(model: RecordModel, cuts: Series1) -> tuple[Jump, ...]:
    """Return the jumps of a model: process noise, events, and cuts where nothing may jump."""
    at_event = np.array([event.t for event in model.events])
    plain = cuts[np.all(np.abs(cuts[:, None] - at_event) > 1e-9, axis=1)]
    if model.wanders:
        moments = np.diag(model.testbed.body.inertia_P)
        sd = model.walk * np.sqrt(model.spacing) / moments
        noise = walk(plain, RATE, sd)
    else:
        noise = tuple(Jump(t, (), ()) for t in plain.tolist())
    return inside((*noise, *(event.jump for event in model.events)), *model.recording.span)


def jumping(
    model: RecordModel,
    recording: Recording,
    jumps: tuple[Jump, ...],
    old: tuple[Jump, ...] | None = None,
) -> tuple[Problem, Floats]:
    """Return the problem of a model on a record with these jumps, and what its fit says of them.

    ``old``: the jumps of the fit, if they are elsewhere now.
    """
    problem = problem_of(recording, model.testbed, replace(model.params, jumps=jumps))
    before = model.fitted
    old = before.problem.jumps if old is None else old
    return problem, carried(old, before.jumps, problem.jumps)


def fitted_in(
    model: RecordModel, cuts: Series1, most: int, moved: tuple[Happening, ...] = ()
) -> Fitted:
    """Return the optimum of a model with these cuts, from where its fit stands.

    ``moved``: where the events were in the fit that the model holds, if elsewhere.
    """
    now = {old.t: event.t for old, event in zip(moved, model.events, strict=bool(moved))}
    old = tuple(jump._replace(t=now.get(jump.t, jump.t)) if moved else jump
                for jump in model.fitted.problem.jumps)  # fmt: skip
    problem, first = jumping(model, model.recording, jumps_of(model, cuts), old)
    return settle_pinned(problem, point_in(problem, model.fitted), first, most)


def point_in(problem: Problem, fitted: Fitted) -> Unknowns:
    """Return the point of a fit with the errors of masses that a problem has; new ones are zero."""
    return with_errors_of(fitted.point, fitted.problem.layout, problem.layout)


def refitted(model: RecordModel, moved: tuple[Happening, ...] = ()) -> RecordModel:
    """Return the model at its optimum, with a cut only where something may jump."""
    return replace(model, fitted=fitted_in(model, active(model), EACH, moved))


def active(model: RecordModel) -> Series1:
    """Return the cuts at which something may jump."""
    return model.cuts if model.wanders else np.zeros(0)


def smoothed(model: RecordModel) -> tuple[Fitted, Smoothed]:
    """Return the fit with every cut in it, and what is known of every stretch."""
    fit = model.fitted
    here = fit.problem.recording is model.recording and fit.problem.testbed is model.testbed
    if not (here and model.wanders and jumps_of(model, model.cuts) == fit.problem.jumps):
        fit = fitted_in(model, model.cuts, 1)
    return fit, smooth_at(fit)


def nearest(models: Iterable[RecordModel]) -> RecordModel:
    """Return the model that explains the record best, whatever it took; finite if any is."""
    return min(models, key=lambda model: cost_of(model.fitted))


def farther(model: RecordModel, other: RecordModel) -> float:
    """Return the chi-square by which a model is farther from the record than another."""
    return 2.0 * (model.fitted.at.cost - other.fitted.at.cost)


def slowest(model: RecordModel) -> float:
    """Return the time (s) within which gravity must act: that of the swing, over 2 pi."""
    body = model.fitted.point.body(model.testbed.body.mass)
    start, end = model.recording.span
    return float(np.clip(body.swing_time(model.testbed.gravity), model.spacing, end - start))


def process_noise(fit: Fitted) -> tuple[Bools, Floats]:
    """Return which jumps of a fit are process noise, and the sd (rad/s) of these, an axis each."""
    jumps = fit.problem.jumps
    noise = np.array([jump.is_noise for jump in jumps], dtype=bool)
    return noise, np.array([jump.sd[:3] for jump in jumps if jump.is_noise])


def misfits(fit: Fitted) -> tuple[Floats, ...]:
    """Return squared residual vectors in sd: of camera, of gyro, and of each of ``VECTORS``."""
    left, vectors = fit.at.left_v, fit.problem.observed.vectors
    present = [each.channel for each, _ in observed(fit.problem.recording, fit.problem.testbed)]
    of = np.array([VECTORS.index(channel) for channel in present], dtype=np.int64)[vectors.sensor]
    every = (fit.at.left_q, fit.at.left_w, *(left[of == k] for k in range(len(VECTORS))))
    return tuple(np.sum(rows**2, axis=1) for rows in every)


def evidence(fit: Fitted, after: Smoothed, price: float) -> float:
    """Return -2 ln of how probable the record is in a model, but for a constant.

    All unknowns are integrated out about the optimum (Laplace's approximation):
    2 cost + sum ln sd^2 over rows, jumps and priors + ln det of the information on all unknowns.
    An event has no prior to speak of: all else is as informed as if it were known, and it costs
    ``price``, the surprise that it must exceed. A torque's coefficient is as large as on benches.
    """
    measured, prior = fit.problem.observed, fit.problem.prior
    loose = (prior.weight > 0) & ~prior.held
    d, more = typical_torques(fit)
    total = 2.0 * fit.at.cost + shrunk(d, fit.at.normal, more)
    total += log_det(fit.at.normal + np.diag(more))
    total -= float(np.sum(np.log((prior.weight + more)[loose])))
    for rows, sd in ((measured.attitude, measured.attitude_sd), (measured.rate, measured.rate_sd)):
        total += 6.0 * len(rows) * float(np.log(sd))
    total += 6.0 * float(np.sum(np.log(measured.vectors.sd[measured.vectors.sensor])))
    cuts = posed(fit.problem).cuts
    counts = np.count_nonzero(cuts.free >= 0, axis=1)
    events = np.array([jump.is_event for jump in fit.problem.jumps], dtype=bool)
    several = sorted(set(counts[counts > 0].tolist()))
    for a, is_event in itertools.product(several, (False, True)):
        alike = (counts == a) & (events == is_event)
        total -= log_det(after.firm[alike, :a, :a])
        if is_event:
            total += np.count_nonzero(alike) * price * a / 3
            total += log_det(after.jump_covariance[alike, :a, :a])
        else:
            total -= float(np.sum(np.log(cuts.weight[alike, :a])))
    return total


def typical_torques(fit: Fitted) -> tuple[Floats, Floats]:
    """Return the coefficients of torques in a fit, and what their usual size informs of them.

    Beyond the fit's own prior; both are zero for all other unknowns.
    """
    layout, prior = fit.problem.layout, fit.problem.prior
    own = np.where(prior.held[layout.torques], np.inf, prior.weight[layout.torques])
    found, more = np.zeros((2, layout.size))
    found[layout.torques] = fit.point.torque[np.isin(TERMS, layout.terms)]
    more[layout.torques] = np.maximum(typical_sizes(layout.terms) ** -2.0 - own, 0.0)
    return found, more


def shrunk(d: Floats, information: Square, more: Floats) -> float:
    """Return by how much twice a cost with its optimum at d grows, drawn towards zero by W more.

    min_x (x - d)^T N (x - d) + x^T W x = d^T (W - W (N + W)^-1 W) d
    """
    if not more.any():
        return 0.0
    pull = more * d
    return float(pull @ d - pull @ inverse_spd(information + np.diag(more)) @ pull)


def improbability(model: RecordModel) -> float:
    """Return -2 ln of how probable the record is in a model, its events at the usual price.

    Infinite where that is no number, or information has no inverse: such a model never wins.
    """
    try:
        found = evidence(*smoothed(model), threshold(model.spacing))
    except np.linalg.LinAlgError:
        return np.inf
    return finite_cost(found)


def log_det(matrices: Floats) -> float:
    """Return ln det of positive definite matrices (..., n, n) in any units, summed.

    LinAlgError if one is not positive definite.
    """
    diagonal = np.diagonal(matrices, axis1=-2, axis2=-1)
    if not np.all(diagonal > 0):
        raise np.linalg.LinAlgError("the matrix is not positive definite")
    unit = 1 / np.sqrt(diagonal)
    scaled = matrices * unit[..., :, None] * unit[..., None, :]
    return float(np.sum(np.linalg.slogdet(scaled)[1]) - 2 * np.sum(np.log(unit)))
