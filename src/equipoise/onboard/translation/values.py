"""What the translator knows of a Python value: its type in C, or the value itself.

    Known    a number, None or a tuple of numbers that does not change: written as a literal
    Code     a C expression with its type
    Record   a NamedTuple, field by field
    Group    a tuple that is not stored yet
    Host     a function, class or module of Python

A Python float is a ``real_t``, an array a flat block of memory whose shape is part of its type. A
NamedTuple without arrays is a C struct; one with arrays is passed field by field, so that a
function takes no more of it than it uses.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, cast

import numpy as np

from equipoise.maths.kernels.compiled import Kernel

RecordClass = Callable[..., Any]


class Scalar(Enum):
    """A number in C."""

    REAL = "real_t"
    INT = "int"
    BOOL = "bool"


@dataclass(frozen=True, slots=True)
class ArrayType:
    """A block of numbers, the last index first in memory."""

    element: Scalar
    shape: tuple[int, ...]

    @property
    def size(self) -> int:
        """The number of elements."""
        return int(np.prod(self.shape))


@dataclass(frozen=True, slots=True)
class TupleType:
    """A tuple: a C struct."""

    items: tuple["Type", ...]

    @property
    def is_even(self) -> bool:
        """Whether all items have one type, so that an index may be a variable."""
        return len(set(self.items)) == 1


@dataclass(frozen=True, slots=True)
class KnownType:
    """A value that is part of the type; ``text`` distinguishes 1, 1.0 and True."""

    text: str
    value: Any = field(compare=False)


@dataclass(frozen=True, slots=True)
class RecordType:
    """A NamedTuple."""

    cls: RecordClass
    fields: tuple[tuple[str, "Type"], ...]

    @property
    def stored(self) -> tuple[tuple[str, "Type"], ...]:
        """The fields that a C struct has: those that are not known."""
        return tuple((name, each) for name, each in self.fields if not is_known(each))


Type = Scalar | ArrayType | TupleType | KnownType | RecordType


@dataclass(frozen=True, slots=True)
class Known:
    """A value that does not change."""

    value: Any


@dataclass(frozen=True, slots=True)
class Code:
    """A C expression; ``root`` names the parameter or variable whose memory an array is."""

    type: Type
    text: str
    root: str | None = None


@dataclass(frozen=True, slots=True)
class Record:
    """A NamedTuple, field by field."""

    cls: RecordClass
    fields: dict[str, "Value"]


@dataclass(frozen=True, slots=True)
class Group:
    """A tuple of values."""

    items: tuple["Value", ...]


@dataclass(frozen=True, slots=True)
class Host:
    """Something of Python that has no value in C."""

    thing: Any


Value = Known | Code | Record | Group | Host


def known_type(value: Any) -> KnownType:
    """Return the type of a value that does not change."""
    return KnownType(f"{type(value).__name__} {value!r}", value)


def is_known(each: Type) -> bool:
    """Say whether nothing of a type is left to store."""
    if isinstance(each, RecordType):
        return not each.stored
    return isinstance(each, KnownType)


def has_arrays(each: Type) -> bool:
    """Say whether a type refers to memory that belongs to somebody else."""
    if isinstance(each, RecordType):
        return any(has_arrays(inner) for _, inner in each.fields)
    if isinstance(each, TupleType):
        return any(map(has_arrays, each.items))
    return isinstance(each, ArrayType)


def items_of(thing: Any) -> tuple[Any, ...] | None:
    """Return the items of a plain tuple; None for anything else."""
    is_plain = isinstance(thing, tuple) and not hasattr(cast(Any, thing), "_fields")
    return cast("tuple[Any, ...]", thing) if is_plain else None


def is_number(thing: Any) -> bool:
    """Say whether a thing of Python is a number, None or a tuple of such."""
    items = items_of(thing)
    if items is not None:
        return all(map(is_number, items))
    return thing is None or isinstance(thing, (bool, int, float))


def lifted(thing: Any) -> Value:
    """Return what is known of a thing of Python; arrays are the unit's matter."""
    number: Any = thing.item() if hasattr(thing, "item") else thing
    return Known(number) if is_number(number) else Host(thing)


def source_function(thing: Any) -> Callable[..., Any] | None:
    """Return the Python function behind a kernel or a function; None: it is neither."""
    if isinstance(thing, Kernel):
        return thing.py_func
    return thing if hasattr(thing, "__code__") else None


def widened(each: Type) -> Type:
    """Return the type of a variable that holds such a value."""
    if not isinstance(each, KnownType) or isinstance(each.value, Host):
        return each
    value: Any = each.value
    items = items_of(value)
    if items is not None:
        return TupleType(tuple(widened(known_type(item)) for item in items))
    if isinstance(value, bool):
        return Scalar.BOOL
    return Scalar.INT if isinstance(value, int) else Scalar.REAL


def common_type(a: Type, b: Type) -> Type:
    """Return the type of a variable that holds either."""
    if isinstance(a, RecordType) and isinstance(b, RecordType) and a.cls is b.cls:
        pairs = zip(a.fields, b.fields, strict=True)
        fields = ((n, x if x == y else common_type(x, y)) for (n, x), (_, y) in pairs)
        return RecordType(a.cls, tuple(fields))
    a, b = widened(a), widened(b)
    return a if a == b else Scalar.REAL


def type_of(value: Value) -> Type:
    """Return the type of a value; a function is known by its name."""
    match value:
        case Known(known):
            return known_type(known)
        case Code(kind):
            return kind
        case Record(cls, fields):
            return RecordType(cls, tuple((n, type_of(each)) for n, each in fields.items()))
        case Group(items):
            return TupleType(tuple(widened(type_of(item)) for item in items))
        case Host(thing):
            name = f"{getattr(thing, '__module__', '')}.{getattr(thing, '__qualname__', thing)}"
            return KnownType(name, value)
