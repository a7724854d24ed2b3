"""A testbed file's text with other drives of its masses; comments and all else stay as they are."""

from typing import Any, cast

import tomlkit

from equipoise.io.testbed.platform import SlidingMass
from equipoise.io.testbed.testbed_file import parse_testbed
from equipoise.io.toml.table_records import keys_written
from equipoise.io.toml.write_toml import set_key
from equipoise.model import testbed as model
from equipoise.model.testbed import Testbed

CALIBRATED = ("gain", "axis", "backlash_mm")


def with_drives(text: str, testbed: Testbed, remarks: dict[str, str], source: str) -> str:
    """Return the text with gain, axis and backlash of a testbed's masses, each with its remark.

    ``remarks`` are by key and mass: 'gain x1'.
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
