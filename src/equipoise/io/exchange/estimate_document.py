"""The estimate in the JSON document of a run.

``balance.json`` holds an estimate in each step that has one: the last is of the platform as it was
left. The others hold one.
"""

import math
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import BaseModel, Field, TypeAdapter

from equipoise.io.documents.json_document import read_document
from equipoise.model.arrays import Square
from equipoise.model.errors import InputError
from equipoise.model.event import Kind

DOCUMENTS = (
    "estimate.json", "identify_runs.json", "balance.json", "inertia.json", "calibrate.json",
    "assess.json",
)  # fmt: skip
WANTED = "the folder of a run that identified a platform, or its JSON document"


class FoundParameter(BaseModel):
    """One number; what is not finite is null."""

    name: str
    unit: str = ""
    value: float | None
    sd: float | None
    observable: bool = True


class FoundReason(BaseModel):
    """A reason, by its code."""

    code: str
    parameters: list[str] = []
    numbers: dict[str, float | None] = {}


class FoundOutcome(BaseModel):
    """How the estimate ended."""

    usable: bool
    sentence: str
    reasons: list[FoundReason] = []


class FoundResidual(BaseModel):
    """What the model left."""

    attitude_rms_rad: float | None
    rate_rms_rad_s: float | None
    chi_square: float | None
    degrees_of_freedom: int
    lag_one: float | None
    spectral_peak: float | None


class FoundEvent(BaseModel):
    """A jump."""

    kind: Kind
    kind_unclear: bool
    time_s: float
    time_sd_s: float | None
    size: tuple[float, float, float]
    covariance: list[list[float | None]]
    chi_square: float


class FoundEstimate(BaseModel):
    """What a method concluded."""

    schema_: Literal["equipoise/estimate/1"] = Field(alias="schema")
    method: str = ""
    outcome: FoundOutcome
    parameters: list[FoundParameter]
    covariance: list[list[float | None]]
    residual: FoundResidual | None = None
    events: list[FoundEvent] = []
    provenance: dict[str, str] = {}


class _Holding(BaseModel):
    schema_: Literal["equipoise/inertia/1", "equipoise/identify_runs/1", "equipoise/assess/2"] = (
        Field(alias="schema")
    )
    estimate: FoundEstimate


class _Step(BaseModel):
    estimate: FoundEstimate | None = None


class _Balance(BaseModel):
    schema_: Literal["equipoise/balance/2"] = Field(alias="schema")
    steps: list[_Step]


_DOCUMENT: TypeAdapter[FoundEstimate | _Holding | _Balance] = TypeAdapter(
    Annotated[FoundEstimate | _Holding | _Balance, Field(discriminator="schema_")]
)


def found_in(file: Path) -> FoundEstimate:
    """Return the last estimate in a document; InputError if it has none."""
    document = read_document(_DOCUMENT.validate_json, file, WANTED, WANTED)
    return _estimate_in(document, str(file))


def usable_in(file: Path) -> FoundEstimate:
    """Return the same; InputError where its outcome is not usable."""
    found = found_in(file)
    if not found.outcome.usable:
        raise InputError(str(file), found.outcome.sentence, "an estimate that is usable")
    return found


def document_of(path: Path) -> Path:
    """Return the document of a run's folder, or what is a file already."""
    if not path.is_dir():
        return path
    there = [path / name for name in DOCUMENTS if (path / name).exists()]
    if not there:
        raise InputError(str(path), "none of " + ", ".join(DOCUMENTS), WANTED)
    return there[0]


def _estimate_in(document: FoundEstimate | _Holding | _Balance, where: str) -> FoundEstimate:
    if isinstance(document, FoundEstimate):
        return document
    if isinstance(document, _Holding):
        return document.estimate
    found = [step.estimate for step in document.steps if step.estimate is not None]
    if not found:
        raise InputError(where, "no step with an estimate", WANTED)
    return found[-1]


def covariance_of(found: FoundEstimate, names: tuple[str, ...]) -> Square:
    """Return the covariance; a variance that is not finite is that of what no data show."""
    stated = np.array([[math.nan if x is None else x for x in row] for row in found.covariance])
    where = {p.name: k for k, p in enumerate(found.parameters)}
    rows = [where[name] for name in names]
    part = stated[np.ix_(rows, rows)]
    lost = ~np.isfinite(np.diag(part))
    part = np.where(np.isfinite(part), part, 0.0)
    part[lost, lost] = np.inf
    return part
