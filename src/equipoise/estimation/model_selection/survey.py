"""Survey: what happened during a record, and how noisy it is, from the record alone.

A platform that is touched, or whose parts shift, moves on by the same laws from another state. So
the record is cut into short stretches with a little process noise between them, which keeps each
cut's test local and lets a model that is slightly wrong pass; then

1. the process noise (a torque that wanders) is set so that half of all cuts are as surprised as
   they should be, and the sensors' noise so that half of all rows are;
2. the greatest surprise beyond the threshold becomes an event: an unknown impulse, or a step of the
   centre of mass, whichever explains more; go to 1 until no cut is surprised;
3. each event is moved to the moment that explains most; those that do not earn their place when
   all are known are taken back; process noise that explains nothing is left out.

The threshold is that of one false alarm in ``FALSE_ALARM`` seconds if cuts were independent, which
they are not: the rate is lower.

Cannot see events below the threshold, nor two within one stretch. An impulse is separable from a
step of the centre of mass only when the rows behind it swing.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.events.event_search import (
    colour_of,
    doubted,
    of_either_kind,
    pruned,
    settled,
)
from equipoise.estimation.events.jump_test import threshold
from equipoise.estimation.events.noise_identification import (
    calibrated,
    excesses,
    first_walk,
    followed,
    quiet,
    weighed,
)
from equipoise.estimation.events.process_noise_spectrum import coloured
from equipoise.estimation.events.record_model import (
    EACH,
    Happening,
    RecordModel,
    active,
    farther,
    fitted_in,
    improbability,
    refitted,
    smoothed,
)
from equipoise.estimation.model_selection import survey_reasons
from equipoise.estimation.model_selection.initial_model import is_close, is_near
from equipoise.estimation.model_selection.model_choice import (
    Refused,
    bared,
    best_group,
    candidates,
    extended,
    is_lawful,
    levelled,
    likeliest,
    with_group,
)
from equipoise.estimation.output_error.solution import Fitted, at_once, smooth_at
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.search_budget import UNLIMITED, Stage
from equipoise.maths.whiteness import WHITE, portmanteau
from equipoise.model.arrays import Floats, Series1
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

FINEST, MOST_CUTS = 0.1, 2000  # s, -; chosen: shorter than a touch, and what memory holds
ROWS, EDGE = 2, 2  # camera rows between cuts, and cuts' spacings left alone at either end
FEWEST = 8  # cuts, chosen: below this a median says nothing
WRONG = 1.8  # chosen: root of the median surprise over its due; by chance it is below 1.6
MOST_EVENTS, FEW_EVENTS = 40, 8  # with and without process noise, chosen
MANY = 4  # events, chosen: so many may be a push that comes and goes
LEAD = 50.0  # -2 ln probability, chosen: more than seeking all once more has gained
ROUNDS = 3
CLOSING = 5  # times a descent between two checks of the budget, chosen: to close with


def finest_spacing(recording: Recording) -> float:
    """Return the least time between cuts, s, however dense the rows."""
    start, end = recording.span
    return max(FINEST, (end - start) / MOST_CUTS)


def cut_times(recording: Recording) -> Series1:
    """Return where to test for events: evenly, a few rows apart."""
    start, end = recording.span
    rows = recording.attitude or recording.rate
    assert rows is not None
    spacing = max(ROWS * rows.period, finest_spacing(recording))
    return np.arange(start + EDGE * spacing, end - (EDGE - 0.5) * spacing, spacing)


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
        group, promise = best_group(model, refused) if terms else ((), 0.0)
        shaken = touched(model, surprise, fit)
        if promise <= 0 and shaken is None:
            break
        richer = extended(model, group, refused) if promise > 0 else model
        if shaken is None or (richer is not model and is_lawful(richer, shaken, group)):
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
    plain = (greedy.params.terms, greedy.params.sensor) == (
        model.params.terms,
        model.params.sensor,
    )
    if not (plain or (not greedy.events and is_calm(greedy))):
        events_first = repeated(repeated(model, terms=False))
        return likeliest([bared(one, model.params) for one in (greedy, events_first)])
    return bared(greedy, model.params)


def survey(recording: Recording, testbed: Testbed, params: Params, fitted: Fitted) -> RecordModel:
    """Return the model that the record supports, and the fit in it; unsettled if it went astray."""
    cuts = cut_times(recording)
    model = RecordModel(recording, testbed, params, cuts, np.zeros(3), (), fitted, testbed)
    if len(cuts) < FEWEST:
        return ended(replace(model, cuts=np.zeros(0)))
    try:
        found = ended(examined(levelled(model)))
        return found if found.unfinished else coloured(found)
    except np.linalg.LinAlgError:  # so far from the record, its information has no inverse
        return ended(replace(model, cuts=np.zeros(0)))


def ended(model: RecordModel) -> RecordModel:
    """Return the model at its optimum, with what its search left unfinished; that is over now.

    A fit that was cut short goes on for a little. LinAlgError where its stretches say nothing.
    """
    unfinished = model.params.budget.unfinished
    problem = replace(model.fitted.problem, budget=UNLIMITED)
    model = replace(
        model,
        unfinished=unfinished,
        params=replace(model.params, budget=UNLIMITED),
        fitted=replace(model.fitted, problem=problem),
    )
    if unfinished and not model.fitted.converged:
        few = min(EACH, CLOSING * at_once(model.fitted.problem))
        model = replace(model, fitted=fitted_in(model, active(model), few))
    if unfinished and model.fitted.problem.jumps:
        smooth_at(model.fitted)
    return model


def examined(model: RecordModel) -> RecordModel:
    """Return the likeliest model from the plain one.

    First without process noise, which could hide a term that explains all. Where ``MANY`` events
    turn up, a torque that wanders is tried before all is sought once more, which takes long with
    so many, and spares that only with a great ``LEAD``: touches may first be found elsewhere than
    they were. Of a platform that is driven by far more than gravity nothing is sought. Where the
    plain fit is lost, events cannot be found from it: there is process noise from the start.
    """
    wild: RecordModel | None = None
    if not is_close(model.fitted):
        wild, _, _ = calibrated(wandering(model))
        if is_drowned(wild):
            return wild
        if not (is_near(model.fitted) and model.fitted.converged):
            return doubted(driven(wild, FEW_EVENTS))
    greedy = repeated(model)
    if len(greedy.events) < MANY:
        return doubted(compared(model, calm(model, greedy), wild=wild))
    if not model.may(Stage.MODELS):
        return greedy
    pushed = driven(model)
    if len(greedy.events) >= FEW_EVENTS:
        return doubted(pushed)
    if improbability(greedy) - improbability(pushed) < LEAD:
        greedy = calm(model, greedy)
    return doubted(compared(model, greedy, pushed, wild))


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
        models.append(driven(greedy))
    return likeliest(models)
