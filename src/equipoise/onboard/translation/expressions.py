"""Expressions of Python as expressions of C, in the same order of operations.

Every operation stands in its own parentheses, so that C adds and multiplies in the order in which
Python does; an operation between two numbers that do not change is carried out here, in double
precision. What has no counterpart raises NotTranslatable with the line.
"""

import ast
import math
from collections.abc import Callable, Mapping
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
    common_type,
    has_arrays,
    source_function,
    type_of,
    widened,
)

ARITHMETIC: dict[type[ast.operator], tuple[str, Callable[[Any, Any], Any]]] = {
    ast.Add: ("+", lambda a, b: a + b),
    ast.Sub: ("-", lambda a, b: a - b),
    ast.Mult: ("*", lambda a, b: a * b),
    ast.Div: ("/", lambda a, b: a / b),
    ast.FloorDiv: ("//", lambda a, b: a // b),
    ast.Mod: ("%", lambda a, b: a % b),
    ast.Pow: ("**", lambda a, b: a**b),
}
COMPARISONS: dict[type[ast.cmpop], tuple[str, Callable[[Any, Any], bool]]] = {
    ast.Lt: ("<", lambda a, b: a < b),
    ast.LtE: ("<=", lambda a, b: a <= b),
    ast.Gt: (">", lambda a, b: a > b),
    ast.GtE: (">=", lambda a, b: a >= b),
    ast.Eq: ("==", lambda a, b: a == b),
    ast.NotEq: ("!=", lambda a, b: a != b),
}
WHOLE = {math.ceil, math.floor}  # give an int in Python
FUNCTIONS: Mapping[Any, str] = {
    math.sin: "eq_sin", math.cos: "eq_cos", math.atan2: "eq_atan2", math.sqrt: "eq_sqrt",
    math.exp: "eq_exp", math.ceil: "eq_ceil", math.floor: "eq_floor",
}  # fmt: skip


class Expressions:
    """Writes the expressions of one function."""

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

    # --- Values ------------------------------------------------------------------------------

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

    # --- Operations --------------------------------------------------------------------------

    def of_binop(self, node: ast.BinOp) -> Value:
        """Return the result of an operation."""
        return self.combined(node.op, self.value(node.left), self.value(node.right))

    def combined(self, operator: ast.operator, left: Value, right: Value) -> Value:
        """Return the result of an operation on two numbers."""
        sign, function = ARITHMETIC[type(operator)]
        if isinstance(left, Known) and isinstance(right, Known):
            return Known(function(left.value, right.value))
        whole = all(widened(type_of(each)) is Scalar.INT for each in (left, right))
        if sign == "**":
            return Code(Scalar.REAL, f"eq_pow({self.real(left)}, {self.real(right)})")
        if whole and sign != "/":
            name = {"//": "/"}.get(sign, sign)  # of numbers that are not negative
            return Code(Scalar.INT, f"({self.integer(left)} {name} {self.integer(right)})")
        return Code(Scalar.REAL, f"({self.real(left)} {sign} {self.real(right)})")

    def of_unaryop(self, node: ast.UnaryOp) -> Value:
        """Return the negative or the opposite."""
        value = self.value(node.operand)
        if isinstance(node.op, ast.Not):
            found = self.truth(value)
            return Known(not found) if isinstance(found, bool) else Code(Scalar.BOOL, f"(!{found})")
        if isinstance(value, Known):
            return Known(-value.value)
        kind = type_of(value)
        text = self.integer(value) if kind is Scalar.INT else self.real(value)
        return Code(kind, f"(-{text})")

    def of_compare(self, node: ast.Compare) -> Value:
        """Return the result of a comparison; chains are taken pair by pair."""
        values, found = [self.value(each) for each in (node.left, *node.comparators)], list[Value]()
        for operator, left, right in zip(node.ops, values, values[1:], strict=False):
            found.append(self.compared(operator, left, right, node))
        return found[0] if len(found) == 1 else self.joined("&&", found)

    def compared(self, operator: ast.cmpop, left: Value, right: Value, node: ast.expr) -> Value:
        """Return the result of one comparison."""
        if isinstance(operator, (ast.Is, ast.IsNot)):
            same = self.known(left, node) is self.known(right, node)
            return Known(same == isinstance(operator, ast.Is))
        if isinstance(operator, (ast.In, ast.NotIn)):
            choices = self.known(right, node)
            equal = [self.compared(ast.Eq(), left, Known(each), node) for each in choices]
            inside = self.joined("||", equal)
            return inside if isinstance(operator, ast.In) else self.opposite(inside)
        sign, function = COMPARISONS[type(operator)]
        if isinstance(left, Known) and isinstance(right, Known):
            return Known(function(left.value, right.value))
        whole = all(widened(type_of(each)) is not Scalar.REAL for each in (left, right))
        a, b = map(self.integer if whole else self.real, (left, right))
        return Code(Scalar.BOOL, f"({a} {sign} {b})")

    def opposite(self, value: Value) -> Value:
        """Return the opposite of a truth value."""
        found = self.truth(value)
        return Known(not found) if isinstance(found, bool) else Code(Scalar.BOOL, f"(!{found})")

    def of_boolop(self, node: ast.BoolOp) -> Value:
        """Return whether all, or any, of some hold; what is decided by a known one ends there."""
        sign, found, ends = "&&", list[Value](), False
        if isinstance(node.op, ast.Or):
            sign, ends = "||", True
        for each in node.values:
            value = self.value(each)
            truth = self.truth(value)
            if truth is ends:
                return Known(ends) if not found else self.joined(sign, [*found, value])
            if not isinstance(truth, bool):
                found.append(value)
        return self.joined(sign, found) if found else Known(not ends)

    def joined(self, sign: str, values: list[Value]) -> Value:
        """Return several truth values joined by && or ||."""
        if all(isinstance(each, Known) for each in values):
            reduce = all if sign == "&&" else any
            return Known(reduce(each.value for each in values if isinstance(each, Known)))
        texts = [as_text(self.truth(each)) for each in values]
        return Code(Scalar.BOOL, f"({f' {sign} '.join(texts)})")

    def of_ifexp(self, node: ast.IfExp) -> Value:
        """Return one of two values."""
        truth = self.truth(self.value(node.test))
        if isinstance(truth, bool):
            return self.value(node.body if truth else node.orelse)
        first, other = self.value(node.body), self.value(node.orelse)
        kind = common_type(type_of(first), type_of(other))
        text = f"({truth} ? {self.as_type(first, kind)} : {self.as_type(other, kind)})"
        if isinstance(kind, ArrayType):
            return self.chosen(kind, text, first, other)
        return Code(kind, text)

    def chosen(self, kind: ArrayType, text: str, *either: Value) -> Code:
        """Return one of two arrays: who writes it may write both."""
        roots = [each.root for each in either if isinstance(each, Code) and each.root]
        self.unit.share(self, roots)
        return Code(kind, text, roots[0] if roots else None)

    # --- Calls -------------------------------------------------------------------------------

    def of_call(self, node: ast.Call) -> Value:
        """Return what a call gives."""
        target = self.value(node.func)
        if not isinstance(target, Host):
            raise NotTranslatable(node, ast.unparse(node))
        arguments = [self.value(each) for each in node.args]
        named = {str(each.arg): self.value(each.value) for each in node.keywords}
        return self.called(target.thing, arguments, named, node)

    def called(
        self, thing: Any, arguments: list[Value], named: dict[str, Value], node: ast.Call
    ) -> Value:
        """Return what a call of a thing of Python gives."""
        if hasattr(thing, "_fields"):
            fields = dict(zip(thing._fields, arguments, strict=False)) | named
            return Record(thing, fields)
        if thing in (min, max):
            return self.extreme("<" if thing is min else ">", arguments)
        if thing is abs:
            return Code(Scalar.REAL, f"eq_fabs({self.real(arguments[0])})")
        if thing in (int, float, bool):
            return self.converted(thing, arguments[0])
        if thing in FUNCTIONS:
            text = f"{FUNCTIONS[thing]}({', '.join(map(self.real, arguments))})"
            return Code(Scalar.INT, f"((int){text})") if thing in WHOLE else Code(Scalar.REAL, text)
        function = source_function(thing)
        if function is None:
            raise NotTranslatable(node, ast.unparse(node))
        return self.unit.call(self, function, arguments, named)

    def converted(self, thing: type, value: Value) -> Value:
        """Return a number of another kind."""
        if isinstance(value, Known):
            return Known(thing(value.value))
        kind = {int: Scalar.INT, float: Scalar.REAL, bool: Scalar.BOOL}[thing]
        if kind is Scalar.REAL:
            return Code(kind, self.real(value))
        return Code(kind, f"(({kind.value}){self.as_type(value, type_of(value))})")

    def extreme(self, sign: str, values: list[Value]) -> Value:
        """Return the least or the greatest, the first of equals, as Python has it."""
        best = values[0]
        for each in values[1:]:
            if isinstance(best, Known) and isinstance(each, Known):
                best = Known((min if sign == "<" else max)(best.value, each.value))
                continue
            whole = all(widened(type_of(v)) is Scalar.INT for v in (best, each))
            kind = Scalar.INT if whole else Scalar.REAL
            a, b = self.as_type(best, kind), self.as_type(each, kind)
            best = Code(kind, f"({b} {sign} {a} ? {b} : {a})")
        return best

    # --- As C --------------------------------------------------------------------------------

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
