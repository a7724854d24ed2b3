"""An estimate with its modes: their numbers, and what not knowing them adds to all others.

With L L^T the covariance of the modes' unknowns theta, L by columns l_k, and x(theta) the estimate,

    covariance += sum_k c_k c_k^T,      c_k = (x(theta + l_k) - x(theta)) / max(1, rise_k)^(1/2)

and c_k l_k^T, summed, is the covariance of x with theta (``modal_fit``). Twice the cost rises by 1
if it is a parabola; an open coupling goes so far that it is none, and rises by more.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.events.event_time_covariance import columns_of, widened
from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.modes.modal_fit import (
    EACH,
    ModalFit,
    Search,
    directions,
    fit_at,
    size_of,
    sizes,
    total,
)
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.trajectory import METHOD
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


def by_unknowns(fit: ModalFit, first: tuple[FreeMode, ...], moment: float) -> Floats:
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


def modal_parameters(fit: ModalFit, covariance: Square) -> tuple[Parameter, ...]:
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
    search = Search(model, model.modes)
    fit = fit_at(model)
    factor = np.linalg.cholesky(fit.covariance)
    models = [search.at(fit.model, fit.theta + column) for column in factor.T]
    shifted = [conclude(one.fitted, METHOD, model.recording) for one in models]
    rise = np.array([
        total(one, fit.theta + column) - fit.chi_square
        for one, column in zip(models, factor.T, strict=True)
    ])  # fmt: skip
    wider = widened(concluded, shifted, rise)
    own = by_unknowns(fit, search.first, search.moment) @ factor
    columns = columns_of(concluded.parameters, [one.parameters for one in shifted], rise)
    covariance = np.block([[wider.covariance, columns @ own.T], [own @ columns.T, own @ own.T]])
    more = modal_parameters(fit, own @ own.T)
    return replace(wider, parameters=(*wider.parameters, *more), covariance=covariance)


def mode_reasons(model: RecordModel) -> list[Reason]:
    """Return which modes the model includes."""
    return [
        Reason(ModeReason.MODE_FOUND, (), {"frequency": m.frequency, "damping": m.damping})
        for m in model.modes
    ]
