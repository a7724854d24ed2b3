"""Cross-checks: what simple metrics say of the centre of mass that a fit found, and what follows.

    torque, energy      off = max_i |r_i - r_fit,i| / sqrt(C_ii + C_fit,ii)
    period of a swing   off = |h - n . r_fit| / sqrt(sd^2 + n^T C_fit n)

n is gravity's mean direction in body axes. Metrics and fit have the same inertia, so C_fit is the
fit's covariance with the inertia known, and an error of the inertia shows in none of them. They
share rows, too: what both have of the same noise only makes the difference smaller.

A check counts where it knows all that the fit says acts on the platform: gravity, and damping.
Sag, drift and other torques it leaves out, and it goes across events. One that counts and is off by
more than ``MOST_OFF`` sd means that one of the two is wrong: the estimate is not trustworthy.

Cannot see an error that metrics and fit share: of the inertia, of mass and gravity, of the clock.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from equipoise.assessment.metrics.period import Swing
from equipoise.assessment.metrics.swing_height import Hanging
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.estimate import COM, Estimate
from equipoise.model.hanging_mass import NAMES as HANGING
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.cross_check_reasons import CrossCheckReason as Why
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.reasons.reason import Coded, Reason, one_reason
from equipoise.model.torque_terms import GROUPS, among
from equipoise.procedure.identification.swing_metrics import SWINGS, SwingMetrics

MOST_OFF = 5.0  # sd, chosen: chance does it once in 1.7 million
KNOWN = GROUPS["viscous"]  # torques that metrics know, beside gravity's


class Metric(StrEnum):
    """What a cross-check goes by."""

    TORQUE = "torque"
    ENERGY = "energy"
    SLOW = "slow swing"
    QUICK = "quick swing"
    BOTH = "both swings, as one"
    SWINGS = SWINGS


MODES = {0: Metric.SLOW, 1: Metric.QUICK, None: Metric.BOTH}


@dataclass(frozen=True, slots=True, eq=False)
class CheckedFit:
    """What is checked: an estimate's centre of mass as the masses stand, the inertia known."""

    estimate: Estimate
    com: Vector3  # m
    covariance: Matrix3  # m^2
    weight: float  # m g, N


@dataclass(frozen=True, slots=True, eq=False)
class Measured:
    """What a metric found, and how much the fit is off from it."""

    distance: float  # m, from P; of a swing the height below P
    sd: float  # m
    off: float  # sd of the difference
    com: Vector3 | None = None  # m; None: a swing shows the height alone
    covariance: Matrix3 | None = None  # m^2
    swing: Swing | None = None


@dataclass(frozen=True, slots=True, eq=False)
class CrossCheck(Coded):
    """One metric beside the fit: what it found, whether it counts, and why not."""

    metric: Metric
    reasons: tuple[Reason, ...]
    found: Measured | None  # None: it shows nothing

    @property
    def counts(self) -> bool:
        """Whether the estimate's trust hangs on it."""
        return self.code in (Why.AGREES, Why.DISAGREES)

    @property
    def disagrees(self) -> bool:
        """Whether it counts against the estimate."""
        return self.code is Why.DISAGREES


def cross_checks(metrics: SwingMetrics, fit: CheckedFit) -> tuple[CrossCheck, ...]:
    """Return what each metric says of a fit that can be used."""
    return (
        *by_balance(Metric.TORQUE, metrics.torque_fit, fit),
        *by_balance(Metric.ENERGY, metrics.energy_fit, fit),
        *by_swings(metrics, fit),
    )


def by_balance(metric: Metric, balance: Estimate | None, fit: CheckedFit) -> Iterator[CrossCheck]:
    """Yield the check by a balance of torque or energy; nothing of a record without one."""
    if balance is None:
        return
    if not balance.outcome.usable:
        why = (*one_reason(Why.NO_ESTIMATE, metric.value), *balance.outcome.reasons)
        yield CrossCheck(metric, why, None)
        return
    com, covariance = balance.com, balance.covariance_of(COM)
    off = np.abs(com - fit.com) / np.sqrt(np.diag(covariance + fit.covariance))
    size, sd = distance(com, covariance)
    yield judged(metric, Measured(size, sd, float(off.max()), com, covariance), fit)


def by_swings(metrics: SwingMetrics, fit: CheckedFit) -> Iterator[CrossCheck]:
    """Yield the check by each swing, or why there is none."""
    if metrics.without_period:
        yield CrossCheck(Metric.SWINGS, metrics.without_period, None)
    for each in metrics.hanging:
        yield judged(MODES[each.mode], height_of(each, fit), fit)


def height_of(hanging: Hanging, fit: CheckedFit) -> Measured:
    """Return the height below P by a swing, and how much the fit's is off from it."""
    height, sd, down = hanging.moment / fit.weight, hanging.sd / fit.weight, hanging.down
    spread = np.sqrt(sd**2 + down @ fit.covariance @ down)
    return Measured(height, sd, float(abs(height - down @ fit.com) / spread), swing=hanging.swing)


def judged(metric: Metric, found: Measured, fit: CheckedFit) -> CrossCheck:
    """Return a check with what it comes to."""
    code, left_out = code_for(found, fit)
    numbers = {"distance": found.distance, "sd": found.sd, "off": found.off, "limit": MOST_OFF}
    return CrossCheck(metric, one_reason(code, metric.value, *left_out, **numbers), found)


def code_for(found: Measured, fit: CheckedFit) -> tuple[Why, tuple[str, ...]]:
    """Return what a check comes to, and what of the fit's torques it leaves out."""
    names = {p.name for p in fit.estimate.parameters}
    left_out = (*among(names - set(KNOWN)), *(name for name in HANGING if name in names))
    if left_out:
        return Why.LEAVES_OUT, left_out
    if fit.estimate.events:
        return Why.ACROSS_EVENTS, ()
    return (Why.DISAGREES if found.off > MOST_OFF else Why.AGREES), ()


def checked(estimate: Estimate, checks: tuple[CrossCheck, ...]) -> Estimate:
    """Return an estimate whose outcome counts the cross-checks that disagree with it."""
    against = [check for check in checks if check.disagrees]
    if not against:
        return estimate
    off = max(check.found.off for check in against if check.found is not None)
    names = (check.metric.value for check in against)
    why = one_reason(EstimateReason.CROSS_CHECKS_DISAGREE, *names, off=off)
    return replace(estimate, outcome=Outcome((*estimate.outcome.reasons, *why)))


def distance(com: Vector3, covariance: Matrix3) -> tuple[float, float]:
    """Return the distance from P (m) and its sd."""
    size = float(np.linalg.norm(com))
    way: Vector3 = com / max(size, 1e-12)
    return size, float(np.sqrt(way @ covariance @ way))
