"""The body, or all parameters, that a run found (``estimate_document``)."""

from pathlib import Path

import numpy as np

from equipoise.io.documents.run_folder import TESTBED
from equipoise.io.exchange.estimate_document import (
    FoundParameter,
    covariance_of,
    document_of,
    found_in,
    usable_in,
)
from equipoise.io.testbed.testbed_file import read_testbed
from equipoise.model.errors import InputError
from equipoise.model.estimate import BODY, standing_com
from equipoise.model.given_numbers import GivenNumbers
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.stated_body import StatedBody, tensor_of
from equipoise.model.testbed import Testbed

MASS = "mass"


def read_body(path: str | Path, testbed: Testbed | None = None) -> tuple[StatedBody, bool]:
    """Return the body that a run found, and whether its outcome calls it usable.

    ``testbed`` has the mass; None: that of the run's folder. InputError where no body was found.
    """
    file = document_of(Path(path))
    found, where = found_in(file), str(file)
    values = {p.name: p for p in found.parameters}
    names = (*BODY[:6], *standing_com(values))
    _check_whole(values, names, where)
    covariance = np.zeros((10, 10))
    covariance[1:, 1:] = covariance_of(found, names)
    mass, covariance[0, 0] = _mass_of(values, testbed, file)
    numbers = np.array([values[name].value for name in names])
    body = MassProperties(mass, numbers[6:], tensor_of(numbers[:6]))
    if not is_possible(body):
        raise InputError(where, "a physically inconsistent inertia", "an estimate that is usable")
    remarks = (f"Source: {file.name}. {found.outcome.sentence}",)
    return StatedBody(file.absolute().parent.name, body, covariance, remarks), found.outcome.usable


def read_given(path: str | Path) -> GivenNumbers:
    """Return all parameters that a run found; InputError where its outcome is not usable."""
    found = usable_in(document_of(Path(path)))
    valued = [each for each in found.parameters if each.value is not None]
    names = tuple(each.name for each in valued)
    values = np.array([each.value for each in valued], dtype=np.float64)
    return GivenNumbers(names, values, covariance_of(found, names))


def _check_whole(values: dict[str, FoundParameter], names: tuple[str, ...], where: str) -> None:
    lacking = [name for name in names if name not in values or values[name].value is None]
    if lacking:
        raise InputError(
            where, f"no value of {', '.join(lacking)}", "all of centre of mass and inertia"
        )


def _mass_of(
    values: dict[str, FoundParameter], testbed: Testbed | None, file: Path
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
