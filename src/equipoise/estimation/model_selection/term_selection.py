"""Which terms a survey takes beside its events, when either may stand for the other.

An unknown event may resemble a term, and a term events. So a term that promises
as much as an event is taken before it (``is_lawful``), and every term is put to the test again when
all else is known (``bared``).
"""

from collections.abc import Sequence

from equipoise.estimation.events.detection_threshold import threshold
from equipoise.estimation.events.event_search import CLEAR
from equipoise.estimation.events.record_model import RecordModel, farther, improbability, refitted
from equipoise.estimation.model_selection.cross_validation import predicts_better
from equipoise.estimation.model_selection.model_choice import (
    added_groups,
    with_group,
    without_group,
)
from equipoise.estimation.output_error.trajectory import Params

Refused = set[tuple[str, ...]]


def likeliest(models: Sequence[RecordModel]) -> RecordModel:
    """Return the model in which the record is most probable."""
    return min(models, key=improbability)


def extended(model: RecordModel, group: tuple[str, ...], refused: Refused) -> RecordModel:
    """Return the model with a group of terms, if that predicts better; refuse it otherwise."""
    richer = refitted(with_group(model, group))
    if richer.fitted.converged and predicts_better(model, richer):
        return richer
    refused.add(group)
    return model


def is_lawful(richer: RecordModel, shaken: RecordModel, group: tuple[str, ...]) -> bool:
    """Say whether a term explains about as much as an event that promises, too.

    Each unknown counting as much as one of an event, or by how likely the record is with either:
    coefficients far smaller than their plausible size do badly by the latter, many by the former.
    Where both do, the term is taken: it leaves open more than an event, which has come and gone.
    """
    counted = threshold(richer.spacing) * (len(group) / 3 - 1)
    if farther(richer, shaken) + counted < CLEAR:
        return True
    return improbability(richer) - improbability(shaken) < CLEAR


def bared(model: RecordModel, requested: Params) -> RecordModel:
    """Return the model without the terms that later finds have made needless."""
    for group in added_groups(model, requested):
        model = likeliest([refitted(without_group(model, group)), model])
    return model
