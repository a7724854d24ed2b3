"""An estimate with its modes: their numbers, and what not knowing them adds to all others.

With L L^T the covariance of the modes' unknowns theta, L by columns l_k, and x(theta) the estimate,

    covariance += sum_k c_k c_k^T,      c_k = x(theta + l_k) - x(theta)

and c_k l_k^T, summed, is the covariance of x with theta (``modal_fit``).
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.events.event_time_covariance import columns_of, widened
from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.modes.modal_fit import EACH, ModalFit, Search, fit_modes, sizes
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.trajectory import METHOD
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.modes import FreeMode
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason

NUMBERS = (("frequency", "Hz"), ("damping", "-"), ("coupling_x", "kg^0.5 m"),
           ("coupling_y", "kg^0.5 m"), ("coupling_z", "kg^0.5 m"))  # fmt: skip
REPORTED = len(NUMBERS)  # of the unknowns of a mode; how it began is not
UNKNOWN = 0.5  # chosen: a coupling that is known by an sd of half its size rests on its prior


def mode_name(k: int, number: str) -> str:
    """Return the name of a number of a mode, counted from 1."""
    return f"mode_{k + 1}_{number}"


def by_unknowns(fit: ModalFit, first: tuple[FreeMode, ...], moment: float) -> Floats:
    """Return the derivative of the numbers reported by theta."""
    rows = np.zeros((REPORTED * len(first), EACH * len(first)))
    for k, mode in enumerate(first):
        scale = sizes(mode, moment)
        scale[0] = fit.model.modes[k].frequency
        for j in range(REPORTED):
            rows[REPORTED * k + j, EACH * k + j] = scale[j]
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
        is_open = bool(np.linalg.norm(own[2:]) > UNKNOWN * np.linalg.norm(mode.coupling))
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
    fit = fit_modes(model, model.modes)
    factor = np.linalg.cholesky(fit.covariance)
    shifted = [
        conclude(search.at(fit.model, fit.theta + column).fitted, METHOD, model.recording)
        for column in factor.T
    ]
    wider = widened(concluded, shifted, np.ones(len(shifted)))
    own = by_unknowns(fit, search.first, search.moment) @ factor
    names = [one.parameters for one in shifted]
    columns = columns_of(concluded.parameters, names, np.ones(len(shifted)))
    covariance = np.block([[wider.covariance, columns @ own.T], [own @ columns.T, own @ own.T]])
    more = modal_parameters(fit, own @ own.T)
    return replace(wider, parameters=(*wider.parameters, *more), covariance=covariance)


def mode_reasons(model: RecordModel) -> list[Reason]:
    """Return which modes the model includes."""
    return [
        Reason(Why.MODE_FOUND, (), {"frequency": m.frequency, "damping": m.damping})
        for m in model.modes
    ]
