"""How slowly a lamp warms the platform, as the record has it.

The time constant tau that the testbed states is a guess, one sd of it a factor of three. The
likeliest is sought along s = ln(tau / stated), all else fitted anew: the least of

    chi^2(s) + (s / ln 3)^2

whose half second derivative is the information on s. By how much an estimate changes with s, an sd
to either side, widens each interval (``event_time_covariance``): the mean of both squares.

Cannot tell a lamp's warmth from a drift where the record ends long before tau, or has no switch.
"""

from dataclasses import replace

import numpy as np
import scipy

from equipoise.dynamics.lamp_warmth import by_lamp
from equipoise.estimation.events.event_time_covariance import widened
from equipoise.estimation.events.record_model import RecordModel, refitted
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.solution import cost_of
from equipoise.estimation.output_error.trajectory import METHOD
from equipoise.estimation.search_budget import Stage
from equipoise.model.estimate import Estimate
from equipoise.model.torque_terms import GROUPS

THERMAL = GROUPS["thermal"]
GUESS = np.log(3.0)  # chosen: one sd of what somebody states of a lamp
FARTHEST = np.log(10.0)  # chosen: within which it is sought
NEAR, MOST = 0.01, 20  # chosen: of s, where the search ends; fits
STEP = 0.05  # of s, chosen: to differentiate by


def follows(model: RecordModel) -> bool:
    """Say whether a switch alone says how warm it was, and that counts."""
    sought = {*THERMAL} <= {*model.params.terms}
    return sought and by_lamp(model.recording, model.testbed)


def with_time_constant(model: RecordModel, shift: float) -> RecordModel:
    """Return the model with a time constant of exp(shift) times that stated, not fitted yet."""
    stated = model.stated.lamp
    assert stated is not None
    lamp = replace(stated, time_constant=stated.time_constant * float(np.exp(shift)))
    return replace(model, testbed=replace(model.testbed, lamp=lamp))


def shift_of(model: RecordModel) -> float:
    """Return s of the time constant that a model has."""
    found, stated = model.testbed.lamp, model.stated.lamp
    assert found is not None
    assert stated is not None
    return float(np.log(found.time_constant / stated.time_constant))


def misfit_at(model: RecordModel, shift: float) -> float:
    """Return the chi-square with a time constant; infinite once the budget is spent."""
    if not model.may(Stage.TERMS):
        return np.inf
    return 2.0 * cost_of(refitted(with_time_constant(model, shift)).fitted) + (shift / GUESS) ** 2


def responding(model: RecordModel) -> RecordModel:
    """Return the model with the likeliest time constant; the same where no lamp counts."""
    if not follows(model):
        return model
    found = scipy.optimize.minimize_scalar(
        lambda shift: misfit_at(model, shift),
        bounds=(-FARTHEST, FARTHEST),
        method="bounded",
        options={"xatol": NEAR, "maxiter": MOST},
    )
    return refitted(with_time_constant(model, float(found.x)))


def sd_of_shift(model: RecordModel) -> float:
    """Return the sd of s, at most that of a guess."""
    here = shift_of(model)
    below, at, above = (misfit_at(model, here + k * STEP) for k in (-1, 0, 1))
    information = 0.5 * (below - 2.0 * at + above) / STEP**2
    return float(max(information, GUESS**-2) ** -0.5) if np.isfinite(information) else GUESS


def with_response(concluded: Estimate, model: RecordModel) -> Estimate:
    """Return an estimate whose intervals count that the time constant is not known."""
    if not follows(model):
        return concluded
    here, sd = shift_of(model), sd_of_shift(model)
    either = [refitted(with_time_constant(model, here + way * sd)) for way in (-1.0, 1.0)]
    shifted = [conclude(one.fitted, METHOD, model.recording) for one in either]
    return widened(concluded, shifted, np.full(2, 2.0))
