"""Events in their place: moved to the moment that explains most, merged, taken back at need."""

from dataclasses import replace

import numpy as np
from scipy.stats import chi2

from equipoise.estimation.believed_model import (
    Believed,
    Happening,
    active,
    fitted_in,
    refitted,
    smoothed,
)
from equipoise.estimation.survey_noise import KINDS

FALSE_ALARM = 600.0  # s between false alarms, at most
NEAR = 1.6  # spacings, chosen: events nearer than this may be one
NEARBY = (1.0, 0.5, 0.25)  # spacings
WIDE_AND_NEARBY = (8.0, 4.0, 2.0, *NEARBY)
BOTH_KINDS = 4.0  # spacings; a move so far may also be to the other kind
FEW = 4  # evaluations to compare neighbouring models by


def threshold(spacing: float) -> float:
    """Return the surprise beyond which a cut is an event."""
    return float(chi2.isf(spacing / FALSE_ALARM / len(KINDS), 3))


def moved(belief: Believed, k: int, kind: str, shift: float) -> Believed:
    """Return the belief with one event of that kind, moved by a share of the spacing."""
    event = Happening(belief.events[k].t + shift * belief.spacing, kind)
    trial = replace(belief, events=(*belief.events[:k], event, *belief.events[k + 1 :]))
    return replace(trial, fitted=fitted_in(trial, active(trial), FEW))


def placed(belief: Believed, k: int, kinds: tuple[str, ...], reach: float) -> Believed:
    """Return the belief with one event where it explains most, of all a reach away."""
    start, end = belief.recording.span
    t, far = belief.events[k].t, reach * belief.spacing
    shifts = [s for s in (-reach, 0.0, reach) if start < t + s / reach * far < end]
    trials = [moved(belief, k, kind, shift) for kind in kinds for shift in shifts]
    return min([belief, *trials], key=lambda trial: trial.fitted.at.cost)


def timed(belief: Believed) -> Believed:
    """Return the belief with each event at the moment that explains most, to a quarter spacing.

    Without process noise the whole record bears on an event, and a wrong first guess of the others
    may have put it far off, or taken one kind for the other.
    """
    reaches = NEARBY if belief.wanders else WIDE_AND_NEARBY
    for k in range(len(belief.events)):
        for reach in reaches:
            kinds = (belief.events[k].kind,) if reach < BOTH_KINDS else tuple(KINDS)
            belief = placed(belief, k, kinds, reach)
    return refitted(belief)


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


def settled(belief: Believed) -> Believed:
    """Return the belief with its events in their place and none that is not needed."""
    return pruned(timed(merged(belief))) if belief.events else belief
