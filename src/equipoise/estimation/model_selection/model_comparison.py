"""Which of the models that were found is the likeliest: with terms, events or process noise."""

from dataclasses import replace

from equipoise.estimation.events.event_search import colour_of, pruned
from equipoise.estimation.events.noise_identification import calibrated, weighed
from equipoise.estimation.events.record_model import RecordModel, improbability, refitted
from equipoise.estimation.model_selection.model_choice import (
    bared,
    candidates,
    likeliest,
    with_group,
)
from equipoise.estimation.model_selection.model_search import driven, is_calm, repeated, wandering
from equipoise.estimation.model_selection.rival_models import chosen
from equipoise.estimation.search_budget import Stage

MANY = 4  # events, chosen: so many may be a push that comes and goes


def lawfully(model: RecordModel, greedy: RecordModel) -> RecordModel:
    """Return ``greedy``, or what is found from a term beside the plain model that is likelier."""
    if not (greedy.events and model.may(Stage.TERMS)):
        return greedy
    termed = [refitted(with_group(model, group)) for group in candidates(model)]
    best = likeliest([greedy, *termed])
    return greedy if best is greedy else likeliest([greedy, repeated(best)])


def calm(model: RecordModel, greedy: RecordModel) -> RecordModel:
    """Return the model without process noise, from all that was found at first: ``greedy``.

    An unknown event may resemble a term, and a term events. So where both are
    found, or neither is enough, all is sought once more, events first; the likelier is taken. A
    term may promise little while the fit without it is far off: each is tried against events.
    """
    greedy = lawfully(model, greedy)
    if not model.may(Stage.TERMS):
        return greedy
    sought = (greedy.params.terms, greedy.params.sensor)
    plain = sought == (model.params.terms, model.params.sensor)
    if not (plain or (not greedy.events and is_calm(greedy))):
        events_first = repeated(repeated(model, terms=False))
        return chosen([bared(one, model.params) for one in (greedy, events_first)])
    return bared(greedy, model.params)


def is_rather_driven(
    model: RecordModel, touched_model: RecordModel, wild: RecordModel | None
) -> bool:
    """Say whether process noise alone, beside the plain model, is likelier than some events.

    ``wild``: the plain model with process noise, calibrated, where that is at hand.
    """
    if not (touched_model.events and model.may(Stage.MODELS)):
        return False
    wild = wild or calibrated(wandering(model))[0]
    return improbability(weighed(wild)) < improbability(touched_model)


def compared(
    model: RecordModel,
    greedy: RecordModel,
    pushed: RecordModel | None = None,
    wild: RecordModel | None = None,
) -> RecordModel:
    """Return the likeliest of a model without process noise, ``greedy``, and those with it.

    One that explains all needs no rival, unless with ``MANY`` events, which explain anything, such
    as a motor's push, or where process noise without an event is likelier than a few. How much
    process noise there is depends on which events the model has: it is sought from none
    (``pushed``, where that is at hand) and from all.
    """
    simple = pruned(greedy, colour_of(greedy))
    explained = is_calm(simple)
    if explained and len(simple.events) < MANY and not is_rather_driven(model, simple, wild):
        return simple
    if not model.may(Stage.MODELS):
        return simple
    models = [simple, pushed or driven(model)]
    if greedy.events and not explained:
        models.append(replace(driven(greedy), rivals=()))
    return chosen(models)
