"""Records as text and back, to the last bit: what results are kept as.

JSON, in which a list stands for itself, and an object with one key for whatever else JSON lacks:

    {"tuple": [...]}, {"dict": [[key, value], ...]}, {"array": [dtype, shape, [...]]},
    {"number": [dtype, value]}, {"enum": [class, name]}, {"record": [class, {field: value}]},
    {"named": "module:name"}, {"partial": [function, [arguments], {keywords}]}

Floats are written with as many digits as they need. A class is one of this program; nothing else is
ever made from a text, and nothing is run. Functions and partial ones are written, not read back:
they are part of a question, and of no result.
"""

import json
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import partial
from importlib import import_module
from types import FunctionType
from typing import Any, TypeAlias

import numpy as np

PROGRAM = "equipoise"
Plain: TypeAlias = "None | bool | int | float | str | list[Plain] | dict[str, Plain]"


def text_of(value: object) -> str:
    """Return a value as text; TypeError for one that is no record, number, text or list of such."""
    return json.dumps(plain(value), separators=(",", ":"))


def value_of(text: str) -> Any:
    """Return the value of a text; ValueError for a text that is none."""
    return _made(json.loads(text))


def plain(value: Any) -> Plain:
    """Return a value as JSON has it."""
    if value is None or type(value) in (bool, int, float, str):
        return value
    if isinstance(value, list):
        return [plain(each) for each in value]
    kind, content = _described(value)
    return {kind: content}


def _described(value: Any) -> tuple[str, Plain]:
    """Return kind and content of what JSON lacks."""
    if isinstance(value, Enum):
        return "enum", [_name(type(value)), value.name]
    if isinstance(value, np.ndarray):
        return "array", [value.dtype.str, list(value.shape), value.ravel().tolist()]
    if isinstance(value, np.generic):
        return "number", [value.dtype.str, value.item()]
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        return "record", [_name(type(value)), {k: plain(v) for k, v in value._asdict().items()}]
    if isinstance(value, tuple):
        return "tuple", [plain(each) for each in value]
    if isinstance(value, Mapping):
        return "dict", [[plain(key), plain(each)] for key, each in value.items()]
    return _of_program(value)


def _of_program(value: Any) -> tuple[str, Plain]:
    """Return kind and content of a record, or of a function."""
    if is_dataclass(value) and not isinstance(value, type):
        content = {f.name: plain(getattr(value, f.name)) for f in fields(value)}
        return "record", [_name(type(value)), content]
    if isinstance(value, partial):
        return "partial", [plain(value.func), plain(list(value.args)), plain(value.keywords)]
    if isinstance(value, (type, FunctionType)):
        return "named", _name(value)
    raise TypeError(f"{type(value).__name__} cannot be kept as text")


def _name(thing: type | FunctionType) -> str:
    return f"{thing.__module__}:{thing.__qualname__}"


def _made(content: Any) -> Any:
    """Return the value that JSON stands for."""
    if isinstance(content, list):
        return [_made(each) for each in content]
    if not isinstance(content, dict):
        return content
    ((kind, inner),) = content.items()
    if kind not in MAKERS:
        raise ValueError(f"a '{kind}' in a kept result")
    return MAKERS[kind](inner)


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
    """Return a record with exactly the fields that were written; nothing of its class is run."""
    kind, written = content
    found, values = _class(kind), {name: _made(each) for name, each in written.items()}
    if issubclass(found, tuple):
        return found(*values.values())
    if not is_dataclass(found) or {f.name for f in fields(found)} != set(values):
        raise ValueError(f"{kind} is no record, or another one")
    record = object.__new__(found)
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
        raise ValueError(f"{name} is no class")  # noqa: TRY004
    return found


MAKERS: dict[str, Callable[[Any], Any]] = {
    "tuple": lambda content: tuple(_made(each) for each in content),
    "dict": lambda content: {_made(key): _made(each) for key, each in content},
    "array": _array,
    "number": _number,
    "enum": _enum,
    "record": _record,
}
KINDS = {*MAKERS, "named", "partial"}
