"""The search for what a record asks for: terms and events, until no cut is surprised.

The threshold is that of one false alarm in ``FALSE_ALARM`` seconds if cuts were independent, which
they are not: the rate is lower.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.events.event_search import of_either_kind, settled
from equipoise.estimation.events.jump_test import threshold
from equipoise.estimation.events.noise_identification import (
    calibrated,
    excesses,
    first_walk,
    followed,
    quiet,
    weighed,
)
from equipoise.estimation.events.record_model import Happening, RecordModel, farther, smoothed
from equipoise.estimation.model_selection import survey_reasons
from equipoise.estimation.model_selection.initial_model import is_close
from equipoise.estimation.model_selection.model_choice import (
    Refused,
    best_groups,
    extended,
    is_lawful,
)
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.search_budget import Stage
from equipoise.maths.whiteness import WHITE, portmanteau
from equipoise.model.arrays import Floats

WRONG = 1.8  # chosen: root of the median surprise over its due; by chance it is below 1.6
MOST_EVENTS, FEW_EVENTS = 40, 8  # with and without process noise, chosen
ROUNDS = 3


def touched(model: RecordModel, surprise: dict[str, Floats], fit: Fitted) -> RecordModel | None:
    """Return the model with the event that surprises most, if it is beyond the threshold.

    And if the fit with it is nearer to the record by as much: a test at one cut may promise what
    the event, once all is fitted, does not keep.
    """
    kind, values = max(surprise.items(), key=lambda item: float(np.max(item[1])))
    k = int(np.argmax(values))
    if values[k] < threshold(model.spacing):
        return None
    event = Happening(fit.problem.jumps[k].t, kind)
    found = of_either_kind(replace(model, events=(*model.events, event)), len(model.events))
    return found if farther(model, found) > threshold(model.spacing) else None


def searched(model: RecordModel, most: int, terms: bool = True) -> RecordModel:
    """Return the model with all terms that the record supports and the events that surprise."""
    refused: Refused = set()
    while len(model.events) < most and model.may(Stage.EVENTS):
        model, surprise, fit = calibrated(model)
        if is_drowned(model) or not model.may(Stage.TERMS):
            break
        groups = best_groups(model, refused) if terms else []
        shaken = touched(model, surprise, fit)
        if not groups and shaken is None:
            break
        richer = extended(model, groups, refused) if groups else model
        if shaken is None or (richer is not model and is_lawful(model, richer, shaken)):
            model = richer
        else:
            model = shaken
    return model


def wandering(model: RecordModel) -> RecordModel:
    """Return the model with some process noise to begin with."""
    if is_close(model.fitted) or model.recording.attitude is None:
        return replace(model, walk=np.full(3, first_walk(model)))
    return followed(model)


def is_drowned(model: RecordModel) -> bool:
    """Say whether something drives the platform so that nothing more is identifiable."""
    return model.wanders and survey_reasons.driven(model) > survey_reasons.DRIVEN


def is_calm(model: RecordModel, white: float = WHITE, surprised: float = WRONG) -> bool:
    """Say whether what is left is white noise, and no cut has to be surprised.

    The former by a probability of ``white`` at least, the latter by less than ``surprised`` times
    what is due.
    """
    fit, after = smoothed(model)
    undisturbed = quiet(model, np.array([jump.t for jump in fit.problem.jumps]))
    whiteness = min(portmanteau(left) for left in (fit.at.left_q, fit.at.left_w))
    return whiteness >= white and bool(excesses(after, undisturbed).max() < surprised)


def driven(model: RecordModel, most: int = MOST_EVENTS) -> RecordModel:
    """Return the model of a platform that something unknown drives: with process noise.

    And with at most so many events.
    """
    model = model if model.wanders else wandering(model)
    for turn in range(ROUNDS):
        if not model.may(Stage.EVENTS):
            break
        wider = searched(model, most)
        if turn > 0 and contents(wider) == contents(model):
            break
        model = weighed(settled(wider))
        if not model.wanders or is_drowned(model):
            break
    return model


def repeated(model: RecordModel, terms: bool = True) -> RecordModel:
    """Return the model searched and settled again and again, until nothing new stays."""
    for _ in range(ROUNDS):
        before = contents(model)
        model = searched(model, FEW_EVENTS, terms)
        if contents(model) == before or len(model.events) >= FEW_EVENTS:
            break
        model = settled(model)
        if contents(model) == before:
            break
    return model


def contents(model: RecordModel) -> tuple[object, ...]:
    """Return the contents of a model: terms, and how many events of each kind."""
    kinds = sorted(event.kind for event in model.events)
    return (model.params.terms, model.params.sensor, *kinds)
