"""The body that a run found, out of the JSON document of its folder.

``balance.json`` holds an estimate in each step that has one: the last is of the platform as it was
left. The others hold one.
"""

import math
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import BaseModel, Field, TypeAdapter

from equipoise.io.documents.json_document import read_document
from equipoise.io.documents.run_folder import TESTBED
from equipoise.io.testbed.testbed_file import read_testbed
from equipoise.model.arrays import Square
from equipoise.model.errors import InputError
from equipoise.model.estimate import BODY, standing_com
from equipoise.model.given_numbers import GivenNumbers
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.stated_body import StatedBody, tensor_of
from equipoise.model.testbed import Testbed

DOCUMENTS = (
    "estimate.json", "identify_runs.json", "balance.json", "inertia.json", "calibrate.json",
    "assess.json",
)  # fmt: skip
WANTED = "the folder of a run that identified a platform, or its JSON document"
MASS = "mass"


class _Parameter(BaseModel):
    name: str
    value: float | None
    sd: float | None


class _Outcome(BaseModel):
    usable: bool
    sentence: str


class _Found(BaseModel):
    schema_: Literal["equipoise/estimate/1"] = Field(alias="schema")
    outcome: _Outcome
    parameters: list[_Parameter]
    covariance: list[list[float | None]]


class _Holding(BaseModel):
    schema_: Literal["equipoise/inertia/1", "equipoise/identify_runs/1", "equipoise/assess/2"] = (
        Field(alias="schema")
    )
    estimate: _Found


class _Step(BaseModel):
    estimate: _Found | None = None


class _Balance(BaseModel):
    schema_: Literal["equipoise/balance/2"] = Field(alias="schema")
    steps: list[_Step]


_DOCUMENT: TypeAdapter[_Found | _Holding | _Balance] = TypeAdapter(
    Annotated[_Found | _Holding | _Balance, Field(discriminator="schema_")]
)


def read_body(path: str | Path, testbed: Testbed | None = None) -> tuple[StatedBody, bool]:
    """Return the body that a run found, and whether its outcome calls it usable.

    ``testbed`` has the mass; None: that of the run's folder. InputError where no body was found.
    """
    file = _document_of(Path(path))
    document, where = read_document(_DOCUMENT.validate_json, file, WANTED, WANTED), str(file)
    found = _estimate_in(document, where)
    values = {p.name: p for p in found.parameters}
    names = (*BODY[:6], *standing_com(values))
    _check_whole(values, names, where)
    covariance = np.zeros((10, 10))
    covariance[1:, 1:] = _covariance(found, names)
    mass, covariance[0, 0] = _mass_of(values, testbed, file)
    numbers = np.array([values[name].value for name in names])
    body = MassProperties(mass, numbers[6:], tensor_of(numbers[:6]))
    if not is_possible(body):
        raise InputError(where, "a physically inconsistent inertia", "an estimate that is usable")
    remarks = (f"Source: {file.name}. {found.outcome.sentence}",)
    return StatedBody(file.absolute().parent.name, body, covariance, remarks), found.outcome.usable


def read_given(path: str | Path) -> GivenNumbers:
    """Return all parameters that a run found; InputError where its outcome is not usable."""
    file = _document_of(Path(path))
    document, where = read_document(_DOCUMENT.validate_json, file, WANTED, WANTED), str(file)
    found = _estimate_in(document, where)
    if not found.outcome.usable:
        raise InputError(where, found.outcome.sentence, "an estimate that is usable")
    valued = [each for each in found.parameters if each.value is not None]
    names = tuple(each.name for each in valued)
    values = np.array([each.value for each in valued], dtype=np.float64)
    return GivenNumbers(names, values, _covariance(found, names))


def _document_of(path: Path) -> Path:
    if not path.is_dir():
        return path
    there = [path / name for name in DOCUMENTS if (path / name).exists()]
    if not there:
        raise InputError(str(path), "none of " + ", ".join(DOCUMENTS), WANTED)
    return there[0]


def _estimate_in(document: _Found | _Holding | _Balance, where: str) -> _Found:
    if isinstance(document, _Found):
        return document
    if isinstance(document, _Holding):
        return document.estimate
    found = [step.estimate for step in document.steps if step.estimate is not None]
    if not found:
        raise InputError(where, "no step with an estimate", WANTED)
    return found[-1]


def _check_whole(values: dict[str, _Parameter], names: tuple[str, ...], where: str) -> None:
    lacking = [name for name in names if name not in values or values[name].value is None]
    if lacking:
        raise InputError(
            where, f"no value of {', '.join(lacking)}", "all of centre of mass and inertia"
        )


def _covariance(found: _Found, names: tuple[str, ...]) -> Square:
    """Return the covariance; a variance that is not finite is that of what no data show."""
    stated = np.array([[math.nan if x is None else x for x in row] for row in found.covariance])
    where = {p.name: k for k, p in enumerate(found.parameters)}
    rows = [where[name] for name in names]
    part = stated[np.ix_(rows, rows)]
    lost = ~np.isfinite(np.diag(part))
    part = np.where(np.isfinite(part), part, 0.0)
    part[lost, lost] = np.inf
    return part


def _mass_of(
    values: dict[str, _Parameter], testbed: Testbed | None, file: Path
) -> tuple[float, float]:
    """Return the mass and its variance: found with the rest, or stated by the testbed."""
    if MASS in values and values[MASS].value is not None:
        return values[MASS].value or 0.0, (values[MASS].sd or 0.0) ** 2
    if testbed is None:
        beside = file.parent / TESTBED
        if not beside.exists():
            wanted = f"{TESTBED} beside it, or --testbed: an estimate has no mass"
            raise InputError(str(file), f"no {TESTBED}", wanted)
        testbed = read_testbed(beside)
    return testbed.body.mass, (testbed.mass_sd * testbed.body.mass) ** 2
