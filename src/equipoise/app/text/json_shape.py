"""A document by declaration: which keys, what of the record stands there, and of which kind.

One declaration gives the document (``Kind.write``) and its JSON Schema (``Kind.schema``), so that
neither can say what the other does not. A key ends in the SI unit of its number, unless a key
``unit`` stands beside it.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

View = dict[str, Any]
Read = Callable[[Any], Any]


@dataclass(frozen=True, slots=True, eq=False)
class Kind:
    """What may stand behind a key."""

    schema: Mapping[str, Any]
    write: Read


@dataclass(frozen=True, slots=True, eq=False)
class Key:
    """A key of a document."""

    name: str
    kind: Kind
    read: Read
    optional: bool = False  # left out, rather than null, where there is nothing


def _as_it_is(value: Any) -> Any:
    return value


def _listed(values: Any) -> Any:
    """Return an array as lists."""
    return values.tolist() if hasattr(values, "tolist") else list(values)


TEXT = Kind({"type": "string"}, _as_it_is)
FLAG = Kind({"type": "boolean"}, _as_it_is)
COUNT = Kind({"type": "integer"}, _as_it_is)
NUMBER = Kind({"type": ["number", "null"]}, _as_it_is)  # null: not finite, or there is none
VECTOR = Kind({"type": "array", "items": NUMBER.schema}, _listed)
MATRIX = Kind({"type": "array", "items": VECTOR.schema}, _listed)


def maybe(kind: Kind) -> Kind:
    """Return a kind that may be null."""
    schema = {"anyOf": [kind.schema, {"type": "null"}]}
    return Kind(schema, lambda value: None if value is None else kind.write(value))


def many(kind: Kind) -> Kind:
    """Return a list of a kind."""
    schema = {"type": "array", "items": kind.schema}
    return Kind(schema, lambda values: [kind.write(value) for value in values])


def by_name(kind: Kind) -> Kind:
    """Return a kind by names that the data give."""
    schema = {"type": "object", "additionalProperties": kind.schema}
    return Kind(schema, lambda named: {name: kind.write(each) for name, each in named.items()})


def fields(names: str, kind: Kind, at: str = "", optional: bool = False) -> tuple[Key, ...]:
    """Return keys that are called as the fields of the record are, else ``time_s=time``.

    A field may be one of a part of the record, ``limit=requirement.limit``, or stand below ``at``;
    of a part that is None there is None.
    """
    above = at.split(".") if at else []
    named = (each.partition("=")[::2] for each in names.split())
    return tuple(
        Key(name, kind, _field([*above, *(path or name).split(".")]), optional)
        for name, path in named
    )


def _field(path: Sequence[str]) -> Read:
    def read(record: Any) -> Any:
        for name in path:
            if record is None:
                return None
            record = record[name] if hasattr(record, "keys") else getattr(record, name)
        return record

    return read


def shape(*keys: Key) -> Kind:
    """Return the kind of a record: an object with these keys and no other."""
    schema = {
        "type": "object",
        "properties": {each.name: each.kind.schema for each in keys},
        "required": [each.name for each in keys if not each.optional],
        "additionalProperties": False,
    }
    return Kind(schema, lambda record: _object(keys, record))


def _object(keys: tuple[Key, ...], record: Any) -> View:
    found = ((each, each.read(record)) for each in keys)
    return {
        each.name: each.kind.write(value)
        for each, value in found
        if not (each.optional and value is None)
    }


def document(name: str, *keys: Key) -> Kind:
    """Return the kind of a whole document, which says by its key ``schema`` what it is."""
    constant = Kind({"const": name}, _as_it_is)
    return shape(Key("schema", constant, lambda _: name), *keys)


def name_of(kind: Kind) -> str:
    """Return the name of a document, such as equipoise/balance/2."""
    return kind.schema["properties"]["schema"]["const"]
