"""Which terms a survey takes beside its events, when either may stand for the other.

An event that is not known yet may look like a term, and a term like events: a camera whose vertical
leans bends every swing, as three parts that shift would. What was taken first is therefore put to
the test again when all else is known: a term is taken in place of the events that it makes
needless (``exchanged``), and left out where what came later has made it needless (``bared``).
"""

from collections.abc import Sequence

from equipoise.estimation.believed_model import Believed, evidence, farther, refitted, smoothed
from equipoise.estimation.event_price import threshold
from equipoise.estimation.held_out_rows import predicts_better
from equipoise.estimation.model_choice import (
    added_groups,
    candidates,
    with_group,
    without_group,
)
from equipoise.estimation.survey_events import CLEAR, pruned, settled
from equipoise.estimation.trajectory import Params

Refused = set[tuple[str, ...]]


def likeliest(models: Sequence[Believed]) -> Believed:
    """Return the model in which the record is most probable."""
    return min(models, key=lambda model: evidence(*smoothed(model), threshold(model.spacing)))


def extended(belief: Believed, group: tuple[str, ...], refused: Refused) -> Believed:
    """Return the belief with a group of terms, if that predicts better; refuse it otherwise."""
    richer = refitted(with_group(belief, group))
    if richer.fitted.converged and predicts_better(belief, richer):
        return richer
    refused.add(group)
    return belief


def is_lawful(richer: Believed, shaken: Believed, group: tuple[str, ...]) -> bool:
    """Say whether a term explains about as much as an event that promises, too.

    Each unknown counts as much as one of an event. Where both do, the term is taken: it leaves
    open more than an event, which has come and gone.
    """
    price = threshold(richer.spacing)
    ahead = farther(richer, shaken)
    return ahead + price * (len(group) / 3 - 1) < CLEAR


def bared(belief: Believed, asked: Params) -> Believed:
    """Return the belief without the terms that what was found after them has made needless."""
    for group in added_groups(belief, asked):
        belief = likeliest([refitted(without_group(belief, group)), belief])
    return belief


def instead(belief: Believed, group: tuple[str, ...], asked: Params) -> Believed:
    """Return the belief with a group of terms instead of the events that it makes needless.

    The same belief where it makes none needless, or does not predict what it has not seen.
    """
    richer = pruned(refitted(with_group(belief, group)))
    if len(richer.events) >= len(belief.events):
        return belief
    richer = bared(settled(richer), asked)
    poorer = refitted(without_group(richer, group))
    return richer if richer.fitted.converged and predicts_better(poorer, richer) else belief


def exchanged(belief: Believed, asked: Params) -> Believed:
    """Return the likeliest of the belief and all with one group of terms instead of events."""
    if not belief.events:
        return belief
    return likeliest([belief, *(instead(belief, g, asked) for g in candidates(belief))])
