"""Records as text and back, to the last bit: what results are kept as.

JSON, in which a list stands for itself, and an object with one key for whatever else JSON lacks:

    {"tuple": [...]}, {"dict": [[key, value], ...]}, {"array": [dtype, shape, [...]]},
    {"number": [dtype, value]}, {"enum": [class, name]}, {"record": [class, {field: value}]},
    {"named": "module:name"}, {"partial": [function, [arguments], {keywords}]}

Floats are written with as many digits as they need. A class is one of this program: nothing else is
ever made from a text, and nothing is run. Functions and partial ones are written, not read back:
they are part of a question, and of no result.
"""

import json
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import partial, singledispatch
from importlib import import_module
from types import FunctionType
from typing import Any, TypeAlias, cast

import numpy as np

PROGRAM = "equipoise"
Plain: TypeAlias = "bool | int | float | str | list[Plain] | dict[str, Plain] | None"
ITSELF = (bool, int, float, str, type(None))  # as JSON has it


def text_of(value: object) -> str:
    """Return a value as text; TypeError for one that is no record, number, text or list of such."""
    return json.dumps(plain(value), separators=(",", ":"))


def value_of(text: str) -> Any:
    """Return the value of a text; ValueError for a text that is none."""
    return _made(json.loads(text))


def plain(value: Any) -> Plain:
    """Return a value as JSON has it."""
    if type(value) in ITSELF:
        return value
    if type(value) is list:
        return _plain_list(cast("list[Any]", value))
    kind, content = _described(value)
    return {kind: content}


def _plain_list(values: Any) -> list[Plain]:
    return [plain(each) for each in values]


@singledispatch
def _described(value: Any) -> tuple[str, Plain]:
    """Return kind and content of what JSON lacks."""
    if not is_dataclass(value):
        raise TypeError(f"{type(value).__name__} cannot be kept as text")
    content = {each.name: plain(getattr(value, each.name)) for each in fields(value)}
    return "record", [_name(type(value)), content]


@_described.register
def _(value: Enum) -> tuple[str, Plain]:
    return "enum", [_name(type(value)), value.name]


@_described.register(np.ndarray)
def _(value: Any) -> tuple[str, Plain]:
    return "array", [value.dtype.str, list(value.shape), value.ravel().tolist()]


@_described.register
def _(value: np.generic) -> tuple[str, Plain]:
    return "number", [value.dtype.str, value.item()]


@_described.register(tuple)
def _(value: Any) -> tuple[str, Plain]:
    if not hasattr(value, "_fields"):
        return "tuple", _plain_list(value)
    names: tuple[str, ...] = value._fields
    return "record", [_name(type(value)), dict(zip(names, _plain_list(value), strict=True))]


@_described.register(Mapping)
def _(value: Any) -> tuple[str, Plain]:
    return "dict", [_plain_list(pair) for pair in value.items()]


@_described.register
def _(value: partial) -> tuple[str, Plain]:  # type: ignore[type-arg]
    return "partial", [plain(value.func), _plain_list(value.args), plain(value.keywords)]


@_described.register(type)
@_described.register(FunctionType)
def _(value: Any) -> tuple[str, Plain]:
    return "named", _name(value)


def _name(thing: Any) -> str:
    return f"{thing.__module__}:{thing.__qualname__}"


def _made(content: Any) -> Any:
    """Return the value that JSON stands for."""
    if isinstance(content, list):
        return _made_list(content)
    if not isinstance(content, dict):
        return content
    ((kind, inner),) = cast("dict[str, Any]", content).items()
    if kind not in MAKERS:
        raise ValueError(f"a '{kind}' in a kept result")
    return MAKERS[kind](inner)


def _made_list(content: Any) -> list[Any]:
    return [_made(each) for each in content]


def _array(content: Any) -> Any:
    kind, shape, values = content
    return np.array(values, dtype=np.dtype(kind)).reshape(shape)


def _number(content: Any) -> Any:
    kind, value = content
    return np.dtype(kind).type(value)


def _enum(content: Any) -> Any:
    kind, name = content
    found = _class(kind)
    if not issubclass(found, Enum):
        raise ValueError(f"{kind} is no enumeration")
    return found[name]


def _record(content: Any) -> Any:
    """Return a record with exactly the fields that were written; none of its functions is run."""
    kind, written = content
    found: Any = _class(kind)
    values = {name: _made(each) for name, each in written.items()}
    if hasattr(found, "_fields"):
        return found(*values.values())
    if not is_dataclass(found) or {each.name for each in fields(found)} != set(values):
        raise ValueError(f"{kind} is no record, or another one")
    record: Any = object.__new__(cast("type[object]", found))
    for name, each in values.items():
        object.__setattr__(record, name, each)
    return record


def _class(name: str) -> type:
    """Return a class of this program."""
    module, _, path = name.partition(":")
    if module.partition(".")[0] != PROGRAM:
        raise ValueError(f"{name} is not of this program")
    found: Any = import_module(module)
    for part in path.split("."):
        found = getattr(found, part)
    if not isinstance(found, type):
        raise ValueError(f"{name} is no class")
    return found


def _pairs(content: Any) -> dict[Any, Any]:
    return {_made(key): _made(each) for key, each in content}


MAKERS: dict[str, Callable[[Any], Any]] = {
    "tuple": lambda content: tuple(_made_list(content)),
    "dict": _pairs,
    "array": _array,
    "number": _number,
    "enum": _enum,
    "record": _record,
}
KINDS = {*MAKERS, "named", "partial"}
