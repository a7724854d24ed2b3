"""Testbed files: TOML to a Testbed and back, and a file's text with other drives of its masses."""

from pathlib import Path
from typing import Any, cast

import numpy as np
import tomlkit

from equipoise.io.files.atomic_file import write_whole
from equipoise.io.testbed.platform import SlidingMass
from equipoise.io.testbed.testbed import TestbedFile
from equipoise.io.toml.read_toml import parse_toml, read_toml
from equipoise.io.toml.table_records import keys_written
from equipoise.io.toml.write_toml import set_key, toml_text
from equipoise.maths.linalg import element_sizes
from equipoise.model import testbed as model
from equipoise.model.arrays import Matrix3
from equipoise.model.estimate import COM, INERTIA, Estimate
from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import Testbed
from equipoise.model.units import PERCENT, UM

WANTED = "a testbed file (TOML); `equipoise new` writes one to start from"
CALIBRATED = ("gain", "axis", "backlash_mm")
REMARK = "equipoise inertia"
CAD_SD = {"mass_sd_percent": 2.0, "inertia_sd_percent": 10.0, "com_sd_um": [500.0, 500.0, 500.0]}
LEAST_SHARE = 1e-4  # chosen: of the inertia, and an sd that is nought is none
LEAST_COM = 1e-8  # m, chosen likewise


def read_testbed(path: str | Path) -> Testbed:
    """Return the testbed a file describes; InputError names file, key, found and wanted."""
    return read_toml(path, TestbedFile, WANTED).record(str(path))


def parse_testbed(text: str, source: str) -> Testbed:
    """Return the testbed a text describes; ``source`` names it in errors."""
    return parse_toml(text, source, TestbedFile).record(source)


def text_of_testbed(testbed: Testbed) -> str:
    """Return TOML that reads back as the same testbed (to the 15th digit)."""
    return toml_text(keys_written(testbed, TestbedFile))


def write_testbed(testbed: Testbed | str, path: str | Path) -> None:
    """Write a testbed, or a text with its comments after seeing that it can be read."""
    text = testbed if isinstance(testbed, str) else text_of_testbed(testbed)
    parse_testbed(text, str(path))
    write_whole(path, text)


def with_drives(text: str, testbed: Testbed, remarks: dict[str, str], source: str) -> str:
    """Return the text with gain, axis and backlash of a testbed's masses, each with its remark.

    Comments and all else stay as they are. ``remarks`` are by key and mass: 'gain x1'.
    """
    stated, document = parse_testbed(text, source), tomlkit.parse(text)
    tables = cast("list[Any]", document.get("sliding_mass", []))
    for table, before, after in zip(tables, stated.masses, testbed.masses, strict=True):
        for key, value in changes(before, after).items():
            set_key(table, key, value, remarks.get(f"{key} {after.name}", ""))
    return tomlkit.dumps(document)


def changes(before: model.SlidingMass, after: model.SlidingMass) -> dict[str, Any]:
    """Return the keys of a mass that a calibration changed, as they are written."""
    old, new = keys_written(before, SlidingMass), keys_written(after, SlidingMass)
    return {key: new[key] for key in CALIBRATED if new[key] != old[key]}


def with_body(text: str, found: Estimate, inertia_C: Matrix3, source: str) -> str:
    """Return the text with the platform's mass, centre of mass and inertia of an estimate.

    Comments and all else stay as they are. A testbed file has one relative sd for all of the
    inertia: the greatest of the six. InputError where the masses then weigh more than the platform.
    """
    document = tomlkit.parse(text)
    for key, value in body_keys(found, inertia_C).items():
        set_key(document["platform"], key, value, REMARK)
    made = tomlkit.dumps(document)
    parse_testbed(made, source)
    return made


def with_stated_body(text: str, body: MassProperties, origin: str, source: str) -> str:
    """Return the text with a platform's mass, centre of mass and inertia of another tool.

    Such a file has no uncertainty: the usual one of CAD is stated, to be replaced by what was
    measured. Comments and all else stay as they are.
    """
    document = tomlkit.parse(text)
    for key, value in stated_keys(body).items():
        set_key(document["platform"], key, value, f"from {origin}")
    for key, value in CAD_SD.items():
        set_key(document["platform"], key, value, "assumed: usual for CAD without cabling")
    made = tomlkit.dumps(document)
    parse_testbed(made, source)
    return made


def stated_keys(body: MassProperties) -> dict[str, Any]:
    """Return the keys of a body that is stated without uncertainty."""
    return {
        "mass_kg": body.mass,
        "inertia_kg_m2": [[written(x) for x in row] for row in body.inertia_C],
        "about": "C",
        "com_um": [written(x / UM) for x in body.com],
    }


def written(value: float) -> float:
    """Return a number without the last digits, which rounding to SI and back has made."""
    return float(f"{value:.12g}")


def body_keys(found: Estimate, inertia_C: Matrix3) -> dict[str, Any]:
    """Return the keys of an estimated body, as they are written."""
    mass, com_sd, six_sd = (
        found.parameters[found.index("mass")],
        np.sqrt(np.diag(found.covariance_of(COM))),
        np.sqrt(np.diag(found.covariance_of(INERTIA))),
    )
    share = float(np.max(six_sd / element_sizes(found.inertia_P)))
    return {
        "mass_kg": rounded(mass.value),
        "mass_sd_percent": rounded(mass.sd / mass.value / PERCENT),
        "inertia_kg_m2": [[rounded(x) for x in row] for row in inertia_C],
        "inertia_sd_percent": rounded(max(share, LEAST_SHARE) / PERCENT),
        "about": "C",
        "com_um": [rounded(x / UM) for x in found.com],
        "com_sd_um": [rounded(max(x, LEAST_COM) / UM) for x in com_sd],
    }


def rounded(value: float) -> float:
    """Return a number with the digits that a person wants to see."""
    return float(f"{value:.6g}")


def json_schema() -> dict[str, Any]:
    """Return the JSON Schema of a testbed file, for editors that complete and check keys."""
    schema = TestbedFile.model_json_schema()
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}
