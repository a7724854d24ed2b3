"""The modes that a record shows: one after the other, while what is left has a line.

A line beyond chance (``residual_line``) is explained by a mode, fitted with all else. The mode is
kept where twice the log likelihood grows by what the line promised, 2 x*: a line that a mode cannot
make, with all rows of all sensors, is no mode.

Cannot see a mode so weak that its line drowns: 2 x* is some 45, and S (``modal_strength``) about as
much where it does not die down. Of wheels that do, half were found at 50, and all from 70 on.
"""

from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.modes.hanging_fit import settled_hanging
from equipoise.estimation.modes.modal_fit import agreed, fit_modes
from equipoise.estimation.modes.mode_guess import guesses
from equipoise.estimation.modes.residual_line import residual_line
from equipoise.estimation.output_error.solution import cost_of
from equipoise.estimation.search_budget import Stage

NEAR = 0.2  # of a line's frequency, chosen: a mode that ends elsewhere explains something else
BROAD = 0.1  # damping, chosen: what is damped more leaves no line; a late log looks so
MOST = 2  # modes, chosen: a third is noise that has a colour


def another(model: RecordModel) -> RecordModel:
    """Return the model with one mode more; the same where the record shows none."""
    line = residual_line(model.fitted)
    if line is None or not line.is_sure:
        return model
    fits = [fit_modes(model, [*model.modes, guess]) for guess in guesses(model, line)]
    found = min(fits, key=lambda fit: fit.chi_square).model
    gained = 2.0 * (cost_of(model.fitted) - cost_of(found.fitted))
    new = found.modes[-1]
    is_line = abs(new.frequency / line.frequency - 1.0) < NEAR and new.damping < BROAD
    return found if is_line and gained > 2.0 * line.threshold else model


def with_modes(model: RecordModel) -> RecordModel:
    """Return the model with all modes that its record shows beside those that it has.

    A fit that did not converge leaves more than noise and modes: nothing is sought in that, nor
    after a search that was cut short.
    """
    if model.unfinished:
        return model
    while len(model.modes) < MOST and model.fitted.converged and model.may(Stage.TERMS):
        found = another(model)
        if found is model:
            break
        model = found
    return model


def without_mode(model: RecordModel, k: int) -> RecordModel:
    """Return the model fitted without one of its modes, the others as they were."""
    return agreed(model, (*model.modes[:k], *model.modes[k + 1 :]))


def earned(model: RecordModel) -> RecordModel:
    """Return the model without modes that terms and events found since have made needless."""
    line = residual_line(model.fitted)
    for k in reversed(range(len(model.modes))):
        less = without_mode(model, k)
        lost = 2.0 * (cost_of(less.fitted) - cost_of(model.fitted))
        if line is not None and less.fitted.converged and lost < 2.0 * line.threshold:
            model = less
    return model


def settled_modes(model: RecordModel) -> RecordModel:
    """Return the model with its modes at their optimum, all else as it was found since.

    What a search that was cut short has stays as it is.
    """
    if model.unfinished:
        return model
    model = settled_hanging(earned(model))
    return fit_modes(model, model.modes).model if model.modes else model
