"""Assess: what a record proves about a platform as its masses stand, as Steps.

The trajectory fit, in the model that the record supports, estimates the centre of mass and its sd.
The testbed's inertia is a prior, its centre of mass is not, and torques that the testbed considers
have the typical sd of benches where the record does not determine them. From that follow the torque
of gravity over a range of tilts, with sag, and the verdict on a requirement.

Simple metrics stand beside it: torque, energy, periods (``swing_metrics``), each with its own sd,
all at the inertia of the fit. Where they disagree (``cross_checks``), one of them is wrong, and the
estimate is not trustworthy: no requirement is met by it.

An sd of the centre of mass counts that of the inertia, whose prior is the testbed's, as that of
``identify`` with a prior does:

    var r = var(r | J) + K var(J) K^T,      K = cov(r, J) var(J)^-1

Motion shows m g r against J, so along the vertical K var(J) K^T is that of the scale, r^2 times its
relative variance. The part without it, var(r | J), is for comparisons at one and the same J alone:
between records, and against the truth, J errs, by as much as it is said to.

Tilts well outside the recorded range are not assessed. The part of r along gravity that no swing
shows is unobservable; its uncertainty goes into every number.
"""

from collections.abc import Generator
from dataclasses import dataclass, field, replace

import numpy as np

from equipoise.assessment.metrics.torque_range import InRange, Pull, torque_in_range
from equipoise.assessment.plausibility.estimated_body import with_plausibility
from equipoise.dynamics.sag_trim import SAG_TERMS
from equipoise.estimation.model_selection import reference_fit
from equipoise.estimation.output_error.fit_estimate import spread_of
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.search_budget import UNLIMITED, Budget
from equipoise.maths.gaussian_length import Bounded, bounded_length
from equipoise.maths.linalg import given
from equipoise.model.arrays import Matrix3, Square, Vector3
from equipoise.model.estimate import COM, INERTIA, Estimate, Parameter, standing_com
from equipoise.model.reasons.reason import one_reason
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.recording import Recording, arranged
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import TERMS, among, typical_torques
from equipoise.model.verdict import Verdict, VerdictOutcome, outcome_of
from equipoise.procedure.identification.cross_checks import (
    KNOWN,
    CheckedFit,
    CrossCheck,
    checked,
    cross_checks,
)
from equipoise.procedure.identification.requirement import Judged, Requirement, judged
from equipoise.procedure.identification.swing_metrics import SwingMetrics, swing_metrics
from equipoise.procedure.steps.clean_record import sound
from equipoise.procedure.steps.plain_steps import estimate_step, measurement_step

UNKNOWN_COM = 1e-3  # m, chosen: one sd of the prior of a centre of mass that is to be proven
RANGE = np.radians(20.0)
DOUBTFUL = 0.02  # chosen: an inertia of a larger sd widens every bound
Fit = tuple[Estimate, tuple[tuple[Parameter, ...], Square]]  # and the result of ``spread_of``


@dataclass(frozen=True, slots=True, eq=False)
class AssessOptions:
    """The target, the requirements and the model."""

    target: Vector3 = field(default_factory=lambda: np.zeros(3))  # m, where com is wanted
    tilt: float = float(RANGE)  # rad, of the range over which torque counts
    require_torque: float | None = None  # N m, rms over that range
    require_offset: float | None = None  # m, from the target
    terms: tuple[str, ...] = ()  # torques to consider, beside the testbed's own
    hold: tuple[str, ...] = ()  # parameters kept at the testbed's value
    budget: Budget = UNLIMITED  # of the search


@dataclass(frozen=True, slots=True, eq=False)
class Assessment:
    """The assessment of a record."""

    testbed: Testbed
    recording: Recording
    options: AssessOptions
    estimate: Estimate
    pull: Pull  # centre of mass as the masses stand, and sag; priors counted, nothing hidden
    inertia_sd: float  # -, relative, of the largest moment
    offset: Bounded  # m, of com from the target
    torque: InRange
    metrics: SwingMetrics
    checks: tuple[CrossCheck, ...]  # none of an estimate that cannot be used
    judged: tuple[Judged, ...]

    @property
    def com(self) -> Vector3:
        """Return the centre of mass as the masses stand, m."""
        return self.pull.mean[:3]

    @property
    def com_covariance(self) -> Matrix3:
        """Return its covariance, m^2."""
        return self.pull.covariance[:3, :3]

    @property
    def com_unscaled(self) -> Matrix3:
        """Return its covariance with the inertia known, m^2."""
        return self.pull.unscaled[:3, :3]


def assess(
    recording: Recording, testbed: Testbed, options: AssessOptions
) -> Generator[Step, None, Assessment]:
    """Yield Steps; the last has the verdict if there is a requirement. Returns the Assessment."""
    end = recording.span[1]
    yield measurement_step(end, recording, StepReason.RECORDING_READ)
    found = assessment_of(testbed, recording, options, fit_of(recording, testbed, options))
    yield estimate_step(end, found.estimate)
    yield verification(found, end)
    return found


def fit_of(recording: Recording, testbed: Testbed, options: AssessOptions) -> Fit:
    """Return the trajectory fit of a record, with the testbed's inertia as prior."""
    recording, testbed = sound(arranged(recording, testbed.mass_names), testbed)
    params = Params(
        among({*testbed.disturbances, *options.terms}),
        use_prior=True,
        hold=options.hold,
        torque_sds=typical_torques(TERMS),
        budget=options.budget.renewed(),
    )
    unbalanced = replace(testbed, com_sd=np.full(3, UNKNOWN_COM))
    reference_fit.check_sensors(recording, unbalanced)
    model = reference_fit.surveyed(recording, unbalanced, params)
    found = reference_fit.as_estimate(model, recording, params)
    estimate = with_plausibility(found, recording, testbed)
    return estimate, spread_of(model.fitted, model.coloured)


def assessment_of(
    stated: Testbed, recording: Recording, options: AssessOptions, model: Fit
) -> Assessment:
    """Return the assessment of a platform by a fit of its record."""
    estimate, spread = model
    testbed, pull = with_body_of(estimate, stated), pull_of(*spread)
    metrics = swing_metrics(*sound(recording, testbed), damping_of(estimate))
    checks = checks_of(estimate, pull, metrics, testbed.weight)
    estimate = checked(estimate, checks)
    torque, offset = bounds_of(options, pull, testbed)
    return Assessment(
        testbed,
        recording,
        options,
        estimate,
        pull,
        inertia_doubt(*spread),
        offset,
        torque,
        metrics,
        checks,
        () if estimate.outcome.warns else answers_of(options, torque, offset),
    )


def with_body_of(estimate: Estimate, testbed: Testbed) -> Testbed:
    """Return the testbed with the body that was found, where that can be used."""
    if not estimate.outcome.usable:
        return testbed
    return replace(
        testbed, body=replace(testbed.body, com=estimate.com, inertia_P=estimate.inertia_P)
    )


def damping_of(estimate: Estimate) -> tuple[str, ...]:
    """Return the damping that a fit estimated."""
    return tuple(name for name in KNOWN if estimate.has(name))


def checks_of(
    estimate: Estimate, pull: Pull, metrics: SwingMetrics, weight: float
) -> tuple[CrossCheck, ...]:
    """Return what the metrics say of an estimate that can be used; ``weight`` is m g in N."""
    if not estimate.outcome.usable:
        return ()
    return cross_checks(metrics, CheckedFit(estimate, pull.mean[:3], pull.unscaled[:3, :3], weight))


def pull_of(parameters: tuple[Parameter, ...], covariance: Square) -> Pull:
    """Return centre of mass, as the masses stand, and sag; with the inertia unknown and known."""
    at = {parameter.name: k for k, parameter in enumerate(parameters)}
    sag = tuple(name for name in SAG_TERMS if name in at)
    own = [at[name] for name in (*standing_com(at), *sag)]
    known = given(covariance, own, [at[name] for name in INERTIA])
    values = np.array([parameters[k].value for k in own])
    return Pull((*COM, *sag), values, covariance[np.ix_(own, own)], known)


def inertia_doubt(parameters: tuple[Parameter, ...], covariance: Square) -> float:
    """Return the relative sd of the largest moment of inertia."""
    moments = [k for k, parameter in enumerate(parameters) if parameter.name in INERTIA[:3]]
    largest = max(moments, key=lambda k: parameters[k].value)
    return float(np.sqrt(covariance[largest, largest])) / parameters[largest].value


def bounds_of(options: AssessOptions, pull: Pull, testbed: Testbed) -> tuple[InRange, Bounded]:
    """Return gravity's torque over the range of tilts, and how far com is from its target."""
    off = pull.mean[:3] - options.target
    offset = bounded_length(off, pull.covariance[:3, :3], np.eye(3), pull.unscaled[:3, :3])
    return torque_in_range(pull, testbed.weight, testbed.up, options.tilt), offset


def answers_of(options: AssessOptions, torque: InRange, offset: Bounded) -> tuple[Judged, ...]:
    """Return the answers to the requirements."""
    found = list[Judged]()
    if options.require_torque is not None:
        limit = Requirement("torque", options.require_torque, options.tilt)
        found.append(judged(limit, torque.rms))
    if options.require_offset is not None:
        found.append(judged(Requirement("offset", options.require_offset), offset))
    return tuple(found)


def verification(found: Assessment, time: float) -> Step:
    """Return the last step: the verdict on the requirements, or that there are none."""
    sd = np.sqrt(np.diag(found.com_covariance))
    outcome, options = found.estimate.outcome, found.options
    requested = options.require_torque is not None or options.require_offset is not None
    if outcome.warns:
        reasons = (*one_reason(VerdictReason.ESTIMATE_UNUSABLE), *outcome.reasons)
        return Step("verify", time, reasons,
                    verdict=Verdict(reasons, found.com, sd) if requested else None)  # fmt: skip
    if not requested:
        return Step("verify", time, one_reason(StepReason.NOTHING_REQUIRED))
    reasons = tuple(reason for each in found.judged for reason in each.reasons)
    if outcome_of(reasons) is VerdictOutcome.UNDECIDED and found.inertia_sd > DOUBTFUL:
        reasons += one_reason(VerdictReason.INERTIA_UNCERTAIN, sd=found.inertia_sd)
    return Step("verify", time, reasons, verdict=Verdict(reasons, found.com, sd))
