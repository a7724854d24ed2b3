"""An estimate with its modes: their numbers, and what not knowing them adds to all others."""

from functools import partial

import numpy as np

from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.modes.modal_fit import (
    EACH,
    directions,
    fit_at,
    moment_of,
    profile_of,
    size_of,
    sizes,
)
from equipoise.estimation.modes.modal_strength import strengths
from equipoise.estimation.modes.profile_descent import ProfileFit
from equipoise.estimation.modes.profile_estimate import with_unknowns
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.modes import FreeMode
from equipoise.model.reasons.mode_reasons import ModeReason
from equipoise.model.reasons.reason import Reason

NUMBERS = (("frequency", "Hz"), ("damping", "-"), ("coupling_x", "kg^0.5 m"),
           ("coupling_y", "kg^0.5 m"), ("coupling_z", "kg^0.5 m"))  # fmt: skip
REPORTED = len(NUMBERS)  # of the unknowns of a mode; how it began is not
UNKNOWN = 0.5  # sd of ln |d|, chosen: a coupling known no better rests on its prior


def mode_name(k: int, number: str) -> str:
    """Return the name of a number of a mode, counted from 1."""
    return f"mode_{k + 1}_{number}"


def by_unknowns(fit: ProfileFit, first: tuple[FreeMode, ...], moment: float) -> Floats:
    """Return the derivative of the numbers reported by theta."""
    rows = np.zeros((REPORTED * len(first), EACH * len(first)))
    for k, one in enumerate(first):
        mode, at = fit.model.modes[k], EACH * k
        found = rows[REPORTED * k : REPORTED * (k + 1), at : at + REPORTED]
        found[0, 0], found[1, 1] = mode.frequency, sizes(one, moment)[1]
        found[2:, 2:] = size_of(mode) * directions(one).T
    return rows


def values_of(mode: FreeMode) -> tuple[float, ...]:
    """Return the numbers reported of a mode."""
    return (mode.frequency, mode.damping, *(float(x) for x in mode.coupling))


def modal_parameters(fit: ProfileFit, covariance: Square) -> tuple[Parameter, ...]:
    """Return the numbers of all modes; a coupling that the record leaves open is not observable."""
    found = list[Parameter]()
    sd = np.sqrt(np.diag(covariance))
    for k, mode in enumerate(fit.model.modes):
        own = sd[REPORTED * k : REPORTED * (k + 1)]
        is_open = bool(fit.covariance[EACH * k + 2, EACH * k + 2] ** 0.5 > UNKNOWN)
        for j, (number, unit) in enumerate(NUMBERS):
            shown = not (is_open and j > 1)
            one = float(own[j]) if shown else np.inf
            found.append(Parameter(mode_name(k, number), unit, values_of(mode)[j], one, shown))
    return tuple(found)


def with_modal_numbers(concluded: Estimate, model: RecordModel) -> Estimate:
    """Return an estimate with the modes of its model; the same of a model without any."""
    if not model.modes or not concluded.outcome.usable:
        return concluded
    fit = fit_at(model)
    own = by_unknowns(fit, model.modes, moment_of(model))
    profile = profile_of(model, model.modes)
    return with_unknowns(concluded, profile, fit, own, partial(modal_parameters, fit))


def mode_reasons(model: RecordModel) -> list[Reason]:
    """Return which modes the model includes, and how strongly each shows."""
    return [
        Reason(
            ModeReason.MODE_FOUND,
            (),
            {"frequency": mode.frequency, "damping": mode.damping, "strength": strength},
        )
        for mode, strength in zip(model.modes, strengths(model), strict=True)
    ]
