"""The estimate that a run found, as a record again.

All that another record is explained by: values, covariance, noise, events and provenance. The rows
of residuals and the courses along the record are not in a document.
"""

import math
from pathlib import Path

import numpy as np

from equipoise.io.exchange.estimate_document import (
    FoundEvent,
    FoundOutcome,
    FoundParameter,
    FoundResidual,
    covariance_of,
    document_of,
    usable_in,
)
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate, Parameter, Residual
from equipoise.model.event import Event
from equipoise.model.outcome import CODES, Outcome
from equipoise.model.reasons.reason import Reason


def read_estimate(path: str | Path) -> Estimate:
    """Return the estimate in the folder of a run, or in its JSON document.

    InputError where its outcome is not usable, or where a program of another version wrote it.
    """
    file = document_of(Path(path))
    found = usable_in(file)
    names = tuple(each.name for each in found.parameters)
    return Estimate(
        found.method, _outcome(found.outcome, str(file)), tuple(map(_parameter, found.parameters)),
        covariance_of(found, names), None if found.residual is None else _residual(found.residual),
        provenance=found.provenance, events=tuple(map(_event, found.events)),
    )  # fmt: skip


def _outcome(found: FoundOutcome, where: str) -> Outcome:
    unknown = next((each.code for each in found.reasons if each.code not in CODES), None)
    if unknown is not None:
        raise InputError(where, f"outcome '{unknown}'", "an estimate of this version")
    return Outcome(tuple(
        Reason(CODES[r.code], tuple(r.parameters), {k: _number(x) for k, x in r.numbers.items()})
        for r in found.reasons
    ))  # fmt: skip


def _parameter(found: FoundParameter) -> Parameter:
    sd = math.inf if found.sd is None else found.sd
    return Parameter(found.name, found.unit, _number(found.value), sd, found.observable)


def _residual(found: FoundResidual) -> Residual:
    peak = 1.0 if found.spectral_peak is None else found.spectral_peak
    return Residual(
        found.attitude_rms_rad, found.rate_rms_rad_s, _number(found.chi_square),
        found.degrees_of_freedom, _number(found.lag_one), spectral_peak=peak,
    )  # fmt: skip


def _event(found: FoundEvent) -> Event:
    covariance = [[_number(x) for x in row] for row in found.covariance]
    return Event(
        found.kind, found.time_s, _number(found.time_sd_s), np.array(found.size),
        np.array(covariance), found.chi_square, found.kind_unclear,
    )  # fmt: skip


def _number(found: float | None) -> float:
    return math.nan if found is None else found
