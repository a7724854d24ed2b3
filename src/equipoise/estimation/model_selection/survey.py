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

Cannot see events below the threshold, nor two within one stretch. An impulse is separable from a
step of the centre of mass only when the rows behind it swing.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from equipoise.estimation.events.event_search import doubted
from equipoise.estimation.events.noise_identification import calibrated
from equipoise.estimation.events.process_noise_spectrum import coloured
from equipoise.estimation.events.record_model import (
    EACH,
    RecordModel,
    active,
    fitted_in,
    improbability,
)
from equipoise.estimation.model_selection.hanging_choice import with_hanging_mass
from equipoise.estimation.model_selection.initial_model import is_close, is_near
from equipoise.estimation.model_selection.model_choice import levelled
from equipoise.estimation.model_selection.model_comparison import MANY, calm, compared
from equipoise.estimation.model_selection.model_search import (
    FEW_EVENTS,
    driven,
    is_drowned,
    repeated,
    wandering,
)
from equipoise.estimation.modes.modal_search import with_modes
from equipoise.estimation.output_error.solution import Fitted, at_once, smooth_at
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.search_budget import UNLIMITED, Stage
from equipoise.model.arrays import Series1
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

FINEST, MOST_CUTS = 0.1, 2000  # s, -; chosen: shorter than a touch, and what memory holds
ROWS, EDGE = 2, 2  # camera rows between cuts, and cuts' spacings left alone at either end
FEWEST = 8  # cuts, chosen: below this a median says nothing
LEAD = 50.0  # -2 ln probability, chosen: more than seeking all once more has gained
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


def levelled_with_modes(model: RecordModel) -> RecordModel:
    """Return the model with which a search begins: its vertical, its lamp, and its modes.

    A mass that hangs and a mode come first: process noise and events would stand for them. A
    motion that was not found shows none.
    """
    found = levelled(model)
    return with_modes(with_hanging_mass(found)) if is_near(found.fitted) else found


def survey(
    recording: Recording,
    testbed: Testbed,
    params: Params,
    fitted: Fitted,
    first: Callable[[RecordModel], RecordModel] = levelled_with_modes,
) -> RecordModel:
    """Return the model that the record supports, and the fit in it; unsettled if it went astray."""
    cuts = cut_times(recording)
    model = RecordModel(recording, testbed, params, cuts, np.zeros(3), (), fitted, testbed)
    if len(cuts) < FEWEST:
        return ended(replace(model, cuts=np.zeros(0)))
    try:
        found = ended(examined(first(model)))
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
