"""Names, numbers, tuples, records and elements of arrays of Python as expressions of C."""

import ast
from collections.abc import Mapping
from typing import Any

import numpy as np

from equipoise.onboard.translation.literals import literal, real_literal
from equipoise.onboard.translation.unit import NotTranslatable, Unit
from equipoise.onboard.translation.values import (
    ArrayType,
    Code,
    Group,
    Host,
    Known,
    Record,
    RecordType,
    Scalar,
    TupleType,
    Type,
    Value,
    has_arrays,
    type_of,
    widened,
)


class Elements:
    """Reads what a function names."""

    def __init__(self, unit: Unit, names: dict[str, Value], hosts: Mapping[str, Any]) -> None:
        self.unit, self.names, self.hosts = unit, names, hosts
        self.written: set[str] = set()  # roots of arrays that are changed
        self.shared: list[set[str]] = []  # roots that may stand for the same memory
        self.calls_writer = False  # since the last variable: it may not go

    def write(self, array: Code) -> None:
        """Note that an array, or an element of one, is changed."""
        if array.root is not None:
            self.written.add(array.root)

    def all_written(self) -> set[str]:
        """Return the roots that are changed, by whatever name."""
        found = set(self.written)
        while True:
            more = {root for group in self.shared if group & found for root in group}
            if more <= found:
                return found
            found |= more

    def value(self, node: ast.expr) -> Value:
        """Return the value of an expression."""
        handler: Any = getattr(self, f"of_{type(node).__name__.lower()}", None)
        if handler is None:
            raise NotTranslatable(node, ast.unparse(node))
        return handler(node)

    def of_constant(self, node: ast.Constant) -> Value:
        """Return a literal."""
        return Known(node.value)

    def of_name(self, node: ast.Name) -> Value:
        """Return a variable, or what Python has by that name."""
        if node.id in self.names:
            return self.names[node.id]
        if node.id not in self.hosts:
            raise NotTranslatable(node, node.id)
        return self.unit.lifted(self.hosts[node.id])

    def of_list(self, node: ast.List) -> Value:
        """Return what an array is made of."""
        return self.of_tuple(node)

    def of_tuple(self, node: ast.Tuple | ast.List) -> Value:
        """Return a tuple."""
        items = tuple(map(self.value, node.elts))
        if all(isinstance(item, Known) for item in items):
            return Known(tuple(item.value for item in items if isinstance(item, Known)))
        return Group(items)

    def of_attribute(self, node: ast.Attribute) -> Value:
        """Return a field, a shape, or something of a module."""
        value = self.value(node.value)
        match value:
            case Record(_, fields) if node.attr in fields:
                return fields[node.attr]
            case Host(thing) if hasattr(thing, node.attr):
                return self.unit.lifted(getattr(thing, node.attr))
            case Code(ArrayType(_, shape), _) if node.attr == "shape":
                return Known(shape)
            case Code(RecordType(_, fields), text):
                kind = dict(fields)[node.attr]
                return self.unit.built(kind, f"{text}.{node.attr}")
            case _:
                raise NotTranslatable(node, ast.unparse(node))

    def of_subscript(self, node: ast.Subscript) -> Value:
        """Return an element, or a part of an array."""
        value = self.value(node.value)
        if isinstance(value, Code) and isinstance(value.type, ArrayType):
            return self.element(value, value.type, node.slice)
        return self.item(value, self.value(node.slice), node)

    def item(self, value: Value, index: Value, node: ast.expr) -> Value:
        """Return an item of a tuple."""
        if isinstance(index, Known):
            k: int = index.value
            match value:
                case Known(known):
                    return self.unit.lifted(known[k])
                case Group(items):
                    return items[k]
                case Code(TupleType(items), text):
                    return Code(items[k], text + self.unit.place(value.type, k))
                case _:
                    raise NotTranslatable(node, ast.unparse(node))
        kind = widened(type_of(value))
        if not (isinstance(kind, TupleType) and kind.is_even):
            raise NotTranslatable(node, ast.unparse(node))
        return Code(kind.items[0], f"{self.as_type(value, kind)}.v[{self.integer(index)}]")

    def element(self, array: Code, kind: ArrayType, index: ast.expr) -> Value:
        """Return an element of an array, or the rest of it from there."""
        indices = index.elts if isinstance(index, ast.Tuple) else [index]
        if isinstance(index, ast.Slice):
            return self.part(array, kind, index)
        terms, constant = list[str](), 0
        for k, each in enumerate(indices):
            stride, place = int(np.prod(kind.shape[k + 1 :])), self.value(each)
            if isinstance(place, Known):
                constant += stride * (place.value % kind.shape[k])
            else:
                text = self.integer(place)
                terms.append(text if stride == 1 else f"{text} * {stride}")
        offset = " + ".join([*terms, str(constant)] if constant or not terms else terms)
        if len(indices) == len(kind.shape):
            return Code(kind.element, f"{array.text}[{offset}]", array.root)
        rest = ArrayType(kind.element, kind.shape[len(indices) :])
        text = array.text if offset == "0" else f"({array.text} + {offset})"
        return Code(rest, text, array.root)

    def part(self, array: Code, kind: ArrayType, index: ast.Slice) -> Value:
        """Return rows of an array between bounds that do not change."""
        first, last = (
            None if bound is None else self.known(self.value(bound), bound)
            for bound in (index.lower, index.upper)
        )
        start, end, _ = slice(first, last).indices(kind.shape[0])
        offset = start * int(np.prod(kind.shape[1:]))
        text = f"({array.text} + {offset})" if offset else array.text
        return Code(ArrayType(kind.element, (end - start, *kind.shape[1:])), text, array.root)

    def known(self, value: Value, node: ast.AST) -> Any:
        """Return a value that does not change; NotTranslatable for any other."""
        if not isinstance(value, Known):
            raise NotTranslatable(node, "a value that changes")
        return value.value

    def real(self, value: Value) -> str:
        """Return a number as ``real_t``."""
        return self.as_type(value, Scalar.REAL)

    def integer(self, value: Value) -> str:
        """Return a number as an index."""
        return self.as_type(value, Scalar.INT)

    def truth(self, value: Value) -> bool | str:
        """Return whether something holds, or the C expression that says so."""
        if isinstance(value, Known):
            return bool(value.value)
        kind = type_of(value)
        text = self.as_type(value, kind)
        return text if kind is Scalar.BOOL else f"({text} != 0)"

    def as_type(self, value: Value, kind: Type) -> str:
        """Return a value as a C expression of a type."""
        if isinstance(value, Code):
            return as_number(value, kind)
        if isinstance(value, Known) and isinstance(kind, Scalar):
            return real_literal(value.value) if kind is Scalar.REAL else literal(value.value)
        return self.assembled(value, kind)

    def assembled(self, value: Value, kind: Type) -> str:
        """Return a tuple or a record as a struct."""
        match value:
            case Known(known) if isinstance(kind, TupleType):
                return self.assembled(Group(tuple(Known(item) for item in known)), kind)
            case Group(items) if isinstance(kind, TupleType):
                parts = [self.as_type(i, k) for i, k in zip(items, kind.items, strict=True)]
                inner = f"{{{', '.join(parts)}}}" if kind.is_even else ", ".join(parts)
            case Record(_, fields) if isinstance(kind, RecordType) and not has_arrays(kind):
                parts = [f".{n} = {self.as_type(fields[n], each)}" for n, each in kind.stored]
                inner = ", ".join(parts)
            case _:
                raise TypeError(f"{value} is no {kind}")
        return f"({self.unit.name_of(kind)}){{{inner}}}"


def as_number(value: Code, kind: Type) -> str:
    """Return a C expression as one of another type of number."""
    if value.type == kind or (value.type, kind) == (Scalar.BOOL, Scalar.INT):
        return value.text
    if kind is Scalar.REAL and isinstance(value.type, Scalar):
        return f"((real_t){value.text})"
    raise TypeError(f"{value} is no {kind}")


def as_text(truth: bool | str) -> str:
    """Return whether something holds as C writes it."""
    return literal(truth) if isinstance(truth, bool) else truth
