"""Verify that the centre of mass is at its target, on data since the last move."""

from dataclasses import dataclass, field

import numpy as np
from scipy.special import ndtr

from equipoise.control.plant.swing_estimates import drift_of
from equipoise.model.arrays import Vector3
from equipoise.model.estimate import NORMAL_95
from equipoise.model.move import Move
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.reason import Reason, axes_of
from equipoise.model.reasons.verdict_reasons import VerdictReason as Why
from equipoise.model.units import UM
from equipoise.model.verdict import Verdict
from equipoise.procedure.steps.joint_fit import Knowledge

SURE = 0.95  # probability that each axis is within its tolerance
CONTRADICTION = 4.0  # sd between what a move predicted and what was found
FRESH = 8.0  # s, chosen: least record since the last move for a verdict


@dataclass(frozen=True, slots=True, eq=False)
class Aim:
    """Where the centre of mass should go, and how closely."""

    target: Vector3 = field(default_factory=lambda: np.array([0.0, 0.0, -100 * UM]))  # m
    tolerance: Vector3 = field(default_factory=lambda: np.array([2 * UM, 2 * UM, 3 * UM]))  # m


def probability_within(com: Vector3, sd: Vector3, target: Vector3, tolerance: Vector3) -> Vector3:
    """Return for each axis the probability that the truth is within the tolerance of the target."""
    low, high = target - tolerance, target + tolerance
    return np.asarray(ndtr((high - com) / sd) - ndtr((low - com) / sd))


def is_within(
    knowledge: Knowledge, target: Vector3, tolerance: Vector3, sure: float = SURE
) -> bool:
    """Say whether every axis is within its tolerance with a probability of ``sure``."""
    found = probability_within(knowledge.com, knowledge.sd, target, tolerance)
    return bool(np.all(found >= sure))


def fresh_misfit(knowledge: Knowledge, since: float) -> float:
    """Return by how many of its sd the chi-square of the rows after ``since`` (s) is too large."""
    attitude, at = knowledge.recording.attitude, knowledge.fitted.at
    left = at.left_w
    if attitude is not None and len(at.left_q):
        left = at.left_q[attitude.t > since]
    if not left.size:
        return 0.0
    return (float(np.mean(left**2)) - 1.0) / float(np.sqrt(2.0 / left.size))


def drift_since(knowledge: Knowledge, since: float) -> Vector3:
    """Return how far the centre of mass has drifted (m) since a time (s), as far as is known."""
    return (knowledge.recording.span[1] - since) * drift_of(knowledge.estimate)


def verdict(
    knowledge: Knowledge, move: Move | None, since: float, target: Vector3, tolerance: Vector3
) -> Verdict:
    """Return the verdict on the record since the last move (ended at ``since``, s)."""
    com, sd = knowledge.com, knowledge.sd
    if not knowledge.estimate.outcome.usable:
        return unusable(knowledge.estimate.outcome, com, sd)
    if fresh_misfit(knowledge, since) > CONTRADICTION:
        return Verdict((Reason(Why.RECORD_MISFITS),), com, sd)
    if move is not None:
        off = com - move.predicted_com - drift_since(knowledge, since)
        spread = np.sqrt(np.diag(move.predicted_covariance))
        if np.any(np.abs(off) > CONTRADICTION * np.hypot(spread, sd)):
            return Verdict((Reason(Why.MOVE_MISSED, (), at(com, sd)),), com, sd)
    return judged(com, sd, target, tolerance)


def unusable(outcome: Outcome, com: Vector3, sd: Vector3) -> Verdict:
    """Return the verdict on an estimate that cannot be used."""
    return Verdict((Reason(Why.ESTIMATE_UNUSABLE), *outcome.reasons), com, sd)


def at(com: Vector3, sd: Vector3) -> dict[str, float]:
    """Return a centre of mass and its sd (m) as a reason's numbers."""
    return axes_of("com", com) | axes_of("sd", sd)


def judged(com: Vector3, sd: Vector3, target: Vector3, tolerance: Vector3) -> Verdict:
    """Return the verdict on a centre of mass.

    Passed where each axis is within its tolerance for sure, failed where the 95 % interval of one
    lies outside. Between them it is undecided, however large the estimated offset is.
    """
    found = at(com, sd)
    sure = probability_within(com, sd, target, tolerance)
    if np.all(sure >= SURE):
        return Verdict((Reason(Why.WITHIN_TOLERANCE, (), found),), com, sd)
    beyond = np.abs(com - target) - NORMAL_95 * sd > tolerance
    if np.any(beyond):
        axes = tuple("xyz"[k] for k in np.flatnonzero(beyond))
        return Verdict((Reason(Why.OUTSIDE_TOLERANCE, axes, found),), com, sd)
    axes = tuple("xyz"[k] for k in np.flatnonzero(sure < SURE))
    return Verdict((Reason(Why.TOO_UNCERTAIN, axes, found),), com, sd)


def fresh_enough(knowledge: Knowledge, since: float) -> bool:
    """Say whether enough was recorded since the last move to judge by."""
    return knowledge.recording.span[1] - since >= FRESH
