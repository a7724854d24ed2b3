"""``held.json``: where a hold stands, so that it goes on after an interruption.

Numbers in SI. The covariance is that of com, J (xx yy zz xy xz yz), the drift of com and what a
kelvin moves it by; that of a sag, where it is estimated, is with all of these and with itself.
Attitude and rate are not kept: the platform moves on meanwhile.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from pydantic import ConfigDict, Field, TypeAdapter, with_config

from equipoise.io.documents.json_document import read_document
from equipoise.io.files.atomic_file import write_whole

FILE, PARAMETERS, TERMS, SAG = "held.json", 15, 19, 5
Finite = Annotated[float, Field(allow_inf_nan=False)]
Triple = Annotated[list[Finite], Field(min_length=3, max_length=3)]
Row = Annotated[list[Finite], Field(min_length=PARAMETERS, max_length=PARAMETERS)]
SagRow = Annotated[list[Finite], Field(min_length=PARAMETERS + SAG, max_length=PARAMETERS + SAG)]


@with_config(ConfigDict(extra="forbid"))
@dataclass(frozen=True, slots=True)
class HeldSag:
    """Elastic sag: coefficients xx yy xy xz yz, their covariance with all else and themselves."""

    coefficients_m: Annotated[list[Finite], Field(min_length=SAG, max_length=SAG)]
    covariance: Annotated[list[SagRow], Field(min_length=SAG, max_length=SAG)]


@with_config(ConfigDict(extra="forbid"))
@dataclass(frozen=True, slots=True)
class HeldFile:
    """What is needed to go on."""

    testbed: str  # its name
    utc_s: Finite  # when it was written, s since 1970
    left_s: Annotated[Finite, Field(ge=0)]  # of the time that was wanted
    target_m: Triple
    tolerance_m: Triple
    com_m: Triple
    inertia_P_kg_m2: Annotated[list[Finite], Field(min_length=6, max_length=6)]
    drift_m_s: Triple
    thermal_m_K: Triple
    covariance: Annotated[list[Row], Field(min_length=PARAMETERS, max_length=PARAMETERS)]
    torque: Annotated[list[Finite], Field(min_length=TERMS, max_length=TERMS)]
    displacement_m: dict[str, Finite]
    sag: HeldSag | None = None
    schema: Literal["equipoise/held/1"] = "equipoise/held/1"


_DOCUMENT = TypeAdapter(HeldFile)


def write_held(held: HeldFile, folder: Path) -> None:
    """Write the file into a folder, whole or not at all."""
    write_whole(folder / FILE, _DOCUMENT.dump_json(held, indent=1).decode())


def read_held(folder: Path) -> HeldFile:
    """Return what a folder's file states; InputError if it is not there or is another document."""
    wanted = f"the folder of a keep, with {FILE}"
    return read_document(_DOCUMENT.validate_json, folder / FILE, wanted, "equipoise/held/1")
