"""Models in which a record is about as probable as in the likeliest: intervals count them all.

An event may resemble a term, and a term process noise. With -2 ln p_k of the record in model k, all
unknowns integrated out, and x_k its estimate, the covariance about that of the likeliest, x_0, is

    C + sum_k w_k (x_k - x_0)(x_k - x_0)^T,     w_k = p_k / sum_j p_j

(Bayesian model averaging, Hoeting et al. 1999, about the likeliest model instead of the mean, each
covariance taken to be that of x_0). What is behind by ``CLEAR`` or more does not count.

Cannot see a model that the search did not come by.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from equipoise.estimation.events.event_search import CLEAR
from equipoise.estimation.events.event_time_covariance import widened
from equipoise.estimation.events.record_model import RecordModel, Rival, improbability
from equipoise.estimation.model_selection.model_search import contents
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.trajectory import METHOD
from equipoise.model.arrays import Floats
from equipoise.model.estimate import COM, INERTIA, Estimate
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason

MUCH = 1.3  # chosen: times as wide as without rivals, from which they are named


def chosen(models: Sequence[RecordModel]) -> RecordModel:
    """Return the model in which the record is most probable, with those about as likely."""
    costs = [improbability(model) for model in models]
    least = min(costs)
    best = models[costs.index(least)]
    found: dict[object, Rival] = {}
    for model, cost in zip(models, costs, strict=True):
        own = Rival(replace(model, rivals=()), 0.0)
        for rival in (own, *model.rivals):
            all_behind = Rival(rival.model, rival.behind + cost - least)
            kind = (contents(rival.model), rival.model.wanders)
            if all_behind.behind < found.get(kind, Rival(best, CLEAR)).behind:
                found[kind] = all_behind
    found.pop((contents(best), best.wanders), None)
    return replace(best, rivals=tuple(found.values()))


def weights(rivals: Sequence[Rival]) -> Floats:
    """Return how probable each rival is, the likeliest model being one of them all."""
    relative = np.exp(-0.5 * np.array([rival.behind for rival in rivals]))
    return relative / (1.0 + relative.sum())


def with_rivals(concluded: Estimate, model: RecordModel) -> Estimate:
    """Return an estimate whose intervals count the models that are about as likely."""
    rivals = [rival for rival in model.rivals if rival.model.fitted.converged]
    if not rivals:
        return concluded
    others = [conclude(rival.model.fitted, METHOD, model.recording) for rival in rivals]
    found = widened(concluded, others, 1.0 / weights(rivals))
    pairs = zip(concluded.parameters, found.parameters, strict=True)
    if not any(b.sd > MUCH * a.sd for a, b in pairs if a.name in (*COM, *INERTIA)):
        return found
    reasons = (*found.outcome.reasons, Reason(Why.RIVAL_MODELS))
    return replace(found, outcome=Outcome(reasons))
