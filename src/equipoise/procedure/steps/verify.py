"""Verify that the centre of mass is at its target, on data since the last move.

Judged is the share of the tolerances that com - target uses, all axes together with their
covariance (``procedure.steps.gaussian_box``), by the rule of ``model.criterion``.
"""

from dataclasses import dataclass, field

import numpy as np
import scipy

from equipoise.dynamics.rigid_body import KNOWN_WARMTH
from equipoise.estimation.search_budget import UNLIMITED, Budget
from equipoise.maths.gaussian_length import SURE, Bounded
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.criterion import BALANCED
from equipoise.model.estimate import NORMAL_95
from equipoise.model.move import Move
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.reason import Reason, axes_of
from equipoise.model.reasons.verdict_reasons import VerdictReason as Why
from equipoise.model.units import UM
from equipoise.model.verdict import Verdict
from equipoise.procedure.steps.gaussian_box import bounded_use, probability_inside
from equipoise.procedure.steps.joint_fit import DRIFT, THERMAL, Knowledge

CONTRADICTION = 4.0  # sd between what a move predicted and what was found
FRESH = 8.0  # s, chosen: least record since the last move for a verdict


@dataclass(frozen=True, slots=True, eq=False)
class Aim:
    """Where the centre of mass should go, and how closely."""

    target: Vector3 = field(default_factory=lambda: np.array([0.0, 0.0, -100 * UM]))  # m
    tolerance: Vector3 = field(default_factory=lambda: np.array([2 * UM, 2 * UM, 3 * UM]))  # m
    budget: Budget = field(default=UNLIMITED, kw_only=True)  # of each fit


def probability_within(com: Vector3, sd: Vector3, target: Vector3, tolerance: Vector3) -> Vector3:
    """Return for each axis the probability that the truth is within the tolerance of the target."""
    low, high = target - tolerance, target + tolerance
    return np.asarray(scipy.special.ndtr((high - com) / sd) - scipy.special.ndtr((low - com) / sd))


def is_within(knowledge: Knowledge, aim: Aim, sure: float) -> bool:
    """Say whether all axes are within their tolerances with a probability of ``sure``."""
    off = knowledge.com - aim.target
    return probability_inside(off, knowledge.covariance, aim.tolerance) >= sure


def is_known(knowledge: Knowledge, closely: Vector3, sure: float) -> bool:
    """Say whether the errors of all axes are within bounds (m) with a probability of ``sure``."""
    return probability_inside(np.zeros(3), knowledge.covariance, closely) >= sure


def fresh_misfit(knowledge: Knowledge, since: float) -> float:
    """Return by how many of its sd the chi-square of the rows after ``since`` (s) is too large."""
    attitude, at = knowledge.recording.attitude, knowledge.fitted.at
    left = at.left_w
    if attitude is not None and len(at.left_q):
        left = at.left_q[attitude.t > since]
    if not left.size:
        return 0.0
    return (float(np.mean(left**2)) - 1.0) / float(np.sqrt(2.0 / left.size))


def com_then(knowledge: Knowledge, since: float) -> tuple[Vector3, Vector3]:
    """Return com less its drift and warmth since a time (s), as far as is known, and sd (m)."""
    estimate, end = knowledge.estimate, knowledge.recording.span[1]
    line = knowledge.fitted.problem.line
    warm = line.known[:, KNOWN_WARMTH]
    warmer = float(warm[-1] - np.interp(since, line.t, warm))
    ways = [(DRIFT, end - since), (THERMAL, warmer)]
    moving = [(-amount * np.eye(3)[k], name) for names, amount in ways
              for k, name in enumerate(names) if estimate.has(name)]  # fmt: skip
    rows = np.column_stack([np.eye(3), *(way for way, _ in moving)])
    names = (*knowledge.standing, *(name for _, name in moving))
    spread = rows @ estimate.covariance_of(names) @ rows.T
    return rows @ estimate.values(names), np.sqrt(np.diag(spread))


def verdict(knowledge: Knowledge, move: Move | None, since: float, aim: Aim) -> Verdict:
    """Return the verdict on the record since the last move (ended at ``since``, s)."""
    com, sd = knowledge.com, knowledge.sd
    if not knowledge.estimate.outcome.usable:
        return unusable(knowledge.estimate.outcome, com, sd)
    if fresh_misfit(knowledge, since) > CONTRADICTION:
        return Verdict((Reason(Why.RECORD_MISFITS),), com, sd)
    if move is not None:
        then, own = com_then(knowledge, since)
        spread = np.sqrt(np.diag(move.predicted_covariance))
        if np.any(np.abs(then - move.predicted_com) > CONTRADICTION * np.hypot(spread, own)):
            return Verdict((Reason(Why.MOVE_MISSED, (), at(com, sd)),), com, sd)
    return judged(com, knowledge.covariance, aim)


def unusable(outcome: Outcome, com: Vector3, sd: Vector3) -> Verdict:
    """Return the verdict on an estimate that cannot be used."""
    return Verdict((Reason(Why.ESTIMATE_UNUSABLE), *outcome.reasons), com, sd)


def at(com: Vector3, sd: Vector3) -> dict[str, float]:
    """Return a centre of mass and its sd (m) as a reason's numbers."""
    return axes_of("com", com) | axes_of("sd", sd)


def judged(com: Vector3, covariance: Matrix3, aim: Aim) -> Verdict:
    """Return the verdict on a centre of mass (m, m^2), however large its estimated offset is."""
    off, sd = com - aim.target, np.sqrt(np.diag(covariance))
    use = bounded_use(off, covariance, aim.tolerance)
    names = axes_in_doubt(off, sd, aim.tolerance, use)
    return Verdict((BALANCED.answer(use, 1.0, at(com, sd), names),), com, sd)


def axes_in_doubt(off: Vector3, sd: Vector3, tolerance: Vector3, use: Bounded) -> tuple[str, ...]:
    """Return the axes outside their tolerance for sure, else those not inside for sure.

    Where each axis is, but not all of them together, it is the one that is the least likely to be.
    """
    beyond = np.abs(off) - NORMAL_95 * sd > tolerance
    likely = probability_within(off, sd, np.zeros(3), tolerance)
    found = beyond if use.low > 1 else likely <= max(SURE, float(likely.min()))
    return tuple("xyz"[k] for k in np.flatnonzero(found))


def fresh_enough(knowledge: Knowledge, since: float) -> bool:
    """Say whether enough was recorded since the last move to judge by."""
    return knowledge.recording.span[1] - since >= FRESH
