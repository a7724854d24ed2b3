"""What the unknown moments of events add to an estimate's covariance.

With sd_k that of moment k and x(t_k) the estimate with the event at t_k,

    covariance += sum_k c_k c_k^T,      c_k = (x(t_k + sd_k) - x(t_k)) / max(1, rise_k)^(1/2)

(to first order the covariance with all moments free, but for what two moments share). Twice the
cost rises by 1 if it is smooth; a gyro's rows, which an event passes one by one, make it rise more.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.events.event_times import later, moment_errors
from equipoise.estimation.events.record_model import RecordModel, farther
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.trajectory import METHOD
from equipoise.model.arrays import Floats
from equipoise.model.estimate import Estimate, Parameter


def wider(found: tuple[Parameter, ...], columns: Floats) -> tuple[Parameter, ...]:
    """Return parameters with the sd that columns (parameters, k) add."""
    added = np.sum(columns**2, axis=1)
    return tuple(
        replace(p, sd=float(np.hypot(p.sd, more**0.5)))
        for p, more in zip(found, added, strict=True)
    )


def columns_of(
    found: tuple[Parameter, ...], shifted: list[tuple[Parameter, ...]], rise: Floats
) -> Floats:
    """Return c of every event, (parameters, k); 0 for what only one of the two estimates has."""
    tables = [{p.name: p.value for p in one} for one in shifted]
    moved = np.array([[table.get(p.name, p.value) - p.value for table in tables] for p in found])
    return moved.reshape(len(found), len(shifted)) / np.sqrt(np.maximum(rise, 1.0))


def with_moments(concluded: Estimate, record_model: RecordModel) -> Estimate:
    """Return an estimate whose intervals count that the moments of its events are not known."""
    if not record_model.events:
        return concluded
    _, sd = moment_errors(record_model)
    models = [later(record_model, row) for row in np.diag(sd)]
    shifted = [conclude(model.fitted, METHOD, record_model.recording) for model in models]
    rise = np.array([farther(model, record_model) for model in models])
    return widened(concluded, shifted, rise)


def widened(concluded: Estimate, shifted: list[Estimate], rise: Floats) -> Estimate:
    """Return an estimate whose covariance counts what each of those at one sd differs by."""
    columns = columns_of(concluded.parameters, [one.parameters for one in shifted], rise)
    ratios = columns_of(concluded.ratios, [one.ratios for one in shifted], rise)
    return replace(
        concluded,
        parameters=wider(concluded.parameters, columns),
        covariance=concluded.covariance + columns @ columns.T,
        ratios=wider(concluded.ratios, ratios),
    )
