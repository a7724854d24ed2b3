"""A table is declared once: reading and writing follow from the declaration."""

from dataclasses import dataclass, fields
from typing import Annotated, Any

import numpy as np
import pytest

from equipoise.io.testbed.testbed import TestbedFile
from equipoise.io.toml.key_types import ITSELF, Direction, Holds, Table, Triple
from equipoise.io.toml.table_records import RecordTable, keys_of, keys_written, record_of
from equipoise.io.toml.units import SPOKEN, TO_SI, key_factor
from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed


@dataclass(frozen=True, slots=True, eq=False)
class Lamp:
    offset: Vector3  # m


@dataclass(frozen=True, slots=True, eq=False)
class Mast:
    height: float  # m
    axis: Vector3
    lamp: Lamp
    marks: tuple[str, ...] = ()


class MastTable(RecordTable):
    height_mm: float
    axis: Direction
    lamp_um: Annotated[Triple, Holds("lamp.offset")]
    marks: list[str]

    def record(self, where: str) -> Mast:
        return record_of(Mast, self, where, lamp=record_of(Lamp, self, where, within="lamp"))


class HillFile(RecordTable):
    mast: list[MastTable]

    def record(self, where: str) -> Any:
        return record_of(Hill, self, where)


@dataclass(frozen=True, slots=True, eq=False)
class Hill:
    mast: tuple[Mast, ...]


KEYS = {"height_mm": 250.0, "axis": [0.0, 0.0, 2.0], "lamp_um": [1.0, 2.0, -3.0], "marks": ["a"]}


def test_units_are_taken_from_the_keys_and_attributes_from_what_is_left_of_them() -> None:
    """250 mm are 0.25 m; (0, 0, 2) has the direction (0, 0, 1)."""
    (mast,) = HillFile.model_validate({"mast": [KEYS]}).record("hill.toml:").mast
    assert mast.height == 0.25
    np.testing.assert_array_equal(mast.axis, [0, 0, 1])
    np.testing.assert_allclose(mast.lamp.offset, [1e-6, 2e-6, -3e-6], rtol=1e-15)
    assert mast.marks == ("a",)


def test_a_record_is_written_as_it_was_read() -> None:
    hill = HillFile.model_validate({"mast": [KEYS, KEYS]}).record("hill.toml:")
    written = {**KEYS, "axis": [0.0, 0.0, 1.0]}
    assert keys_written(hill, HillFile) == {"mast": [written, written]}


def test_a_row_that_makes_no_sense_is_named_with_its_place() -> None:
    table = HillFile.model_validate({"mast": [KEYS, {**KEYS, "axis": [0.0, 0.0, 0.0]}]})
    with pytest.raises(
        InputError, match=r"^hill\.toml: mast\[2\]\.axis: found an axis of length 0"
    ):
        table.record("hill.toml:")


def test_every_unit_of_a_key_has_a_size_in_si() -> None:
    assert set(SPOKEN.values()) <= TO_SI.keys()
    assert key_factor("drift_um_min") == 1e-6 / 60
    assert key_factor("name") == 1.0


def test_every_attribute_of_a_testbed_has_a_key() -> None:
    """But for the file's name, what reading set right, and what a balancing by hand found."""
    keys = {key.attribute for table in (TestbedFile, *parts()) for key in keys_of(table)}
    of_reading = {"source", "mended", "body_covariance"}
    attributes = {field.name for field in fields(Testbed)}
    assert attributes - {k.split(".")[0] for k in keys} == of_reading


def parts() -> list[type[Table]]:
    """Return the tables whose keys give attributes of the testbed itself."""
    inner = [k.table for k in keys_of(TestbedFile) if k.attribute == ITSELF and k.table is not None]
    assert inner
    return inner
