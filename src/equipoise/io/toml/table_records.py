"""A table of a file to its record in SI, and back: both follow from the declaration of its keys.

The end of a key is its unit, the rest is the attribute that it gives: ``travel_mm`` is ``travel``
in m. ``Holds`` names another attribute. A table says what no single key gives: for the way to the
record in ``record``, for the way back in ``more_keys``. Where keys give all of a record, ``KIND``
names its class.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cache, reduce
from typing import Any, ClassVar, TypeVar, cast, get_args

import numpy as np
from pydantic.fields import FieldInfo

from equipoise.io.toml.key_types import ITSELF, Holds, Table, UnitVector, table_in, unit_vector
from equipoise.io.toml.units import key_factor, split_unit
from equipoise.io.toml.write_toml import Value, as_written
from equipoise.model.errors import InputError

Record = TypeVar("Record")


class RecordTable(Table):
    """A table that stands for a record."""

    KIND: ClassVar[type[Any]]

    def record(self, where: str) -> Any:
        """Return the record in SI; InputError names a key below ``where`` that makes no sense."""
        return record_of(self.KIND, self, where)

    @classmethod
    def more_keys(cls, record: Any) -> Mapping[str, Any]:
        """Return what keys hold that no single attribute gives, in SI; None leaves a key out."""
        return {}


@dataclass(frozen=True, slots=True)
class Key:
    """A key as it is declared."""

    name: str
    attribute: str
    unit: float  # in SI
    is_direction: bool
    table: type[Table] | None  # of the rows or the table that it holds


@cache
def keys_of(schema: type[Table]) -> tuple[Key, ...]:
    """Return the keys of a table in the order of their declaration."""
    return tuple(_key(name, field) for name, field in schema.model_fields.items())


def record_of(
    kind: type[Record], table: Table, where: str, within: str = "", **more: Any
) -> Record:
    """Return a record of a table's keys in SI and of ``more`` attributes, which go first.

    ``within`` is the attribute of the table's own record that is wanted, such as ``gyro``.
    """
    stem = f"{within}." if within else ""
    names = {field.name for field in fields(cast(Any, kind))} - more.keys()
    found = _attributes(table, where, {f"{stem}{name}" for name in names})
    return kind(**{name.removeprefix(stem): value for name, value in found.items()}, **more)


def records_of(tables: Sequence[RecordTable], where: str) -> tuple[Any, ...]:
    """Return the records of rows, which count from 1."""
    return tuple(each.record(f"{where}[{i}]") for i, each in enumerate(tables, 1))


def keys_written(record: Any, schema: type[Table]) -> dict[str, Value]:
    """Return a record as the keys of its table; what is None, or a table of none, is left out."""
    no_more: Mapping[str, Any] = {}
    more = schema.more_keys(record) if issubclass(schema, RecordTable) else no_more
    found: dict[str, Value] = {}
    for key in keys_of(schema):
        value = more[key.name] if key.name in more else _attribute(record, key.attribute)
        written = as_written(value, key.unit) if key.table is None else _tables(value, key.table)
        if written is not None and written != {}:
            found[key.name] = written
    return found


def check_names(rows: Sequence[Any], where: str) -> None:
    """Raise InputError for a row of the same name as one before."""
    names = [row.name for row in rows]
    for i, name in enumerate(names):
        if name in names[:i]:
            raise InputError(f"{where}[{i + 1}].name", f"a second '{name}'", "a new name")


def _key(name: str, field: FieldInfo) -> Key:
    marks = [*field.metadata, *_marks(field.annotation)]
    holds = next((m for m in marks if isinstance(m, Holds)), Holds(split_unit(name)[0]))
    unit = key_factor(name) if holds.unit is None else holds.unit
    is_direction = any(isinstance(m, UnitVector) for m in marks)
    return Key(name, holds.attribute, unit, is_direction, table_in(field.annotation))


def _marks(annotation: Any) -> Iterator[Any]:
    """Yield what is said of the parts of an annotation, such as ``Direction | None``."""
    for part in get_args(annotation):
        yield part
        yield from _marks(part)


def _attributes(table: Table, where: str, wanted: set[str]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key in keys_of(type(table)):
        value = getattr(table, key.name)
        here = f"{where} {key.name}" if where.endswith(":") else f"{where}.{key.name}"
        if key.attribute == ITSELF:
            found |= _attributes(value, here, wanted)
        elif key.attribute in wanted:
            found[key.attribute] = _in_si(value, key, here)
    return found


def _in_si(value: Any, key: Key, where: str) -> Any:
    if isinstance(value, RecordTable):
        return value.record(where)
    if isinstance(value, list):
        return _list_in_si(cast("list[Any]", value), key, where)
    return value * key.unit if isinstance(value, float) else value


def _list_in_si(values: list[Any], key: Key, where: str) -> Any:
    if key.table is not None:
        return records_of(values, where)
    if key.is_direction:
        return unit_vector(values, where)
    if all(isinstance(each, str) for each in values):
        return tuple(values)
    return np.array(values, float) * key.unit


def _attribute(record: Any, path: str) -> Any:
    """Return an attribute of a record, or of a record within it."""
    return record if path == ITSELF else reduce(getattr, path.split("."), record)


def _tables(value: Any, schema: type[Table]) -> Any:
    if value is None:
        return None
    if isinstance(value, tuple):
        return [keys_written(each, schema) for each in cast("tuple[Any, ...]", value)] or None
    return keys_written(value, schema)
