"""Variables and elements of arrays: where C keeps what Python assigns.

A variable that is set once is a constant of C, or no variable at all where its value is known. One
that is set again is declared at the top. Both sides of ``a, b = b, a`` are read before either is
written.
"""

import ast
import builtins
import inspect
import re
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from equipoise.onboard.translation.expressions import Expressions
from equipoise.onboard.translation.unit import (
    NotTranslatable,
    Unit,
    c_name,
    tree_of,
)
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
    is_known,
    items_of,
    type_of,
    widened,
)

NAME = re.compile(r"(?<![.\w])[A-Za-z_]\w*")  # not a member of a struct


@dataclass(frozen=True, slots=True)
class Line:
    """A line of C; ``declares``: it may go if nothing else names this."""

    text: str
    declares: str | None = None
    depth: int = 1


class Storing(Expressions):
    """Writes the variables of one function."""

    def __init__(self, unit: Unit, function: Callable[..., Any], kinds: dict[str, Type]) -> None:
        tree = tree_of(function)
        closed = inspect.getclosurevars(function)
        hosts = {**vars(builtins), **function.__globals__, **closed.nonlocals}
        names = {n: unit.built(kind, c_name(n)) for n, kind in kinds.items()}
        super().__init__(unit, names, hosts)
        self.tree, self.counts = tree, Counter(stored_names(tree))
        self.top, self.lines, self.depth = list[Line](), list[Line](), 1
        self.variables: dict[str, Type] = {}
        self.returns: Type | None = None
        self.count = 0
        for name in [name for name in kinds if self.counts[name]]:
            self.counts[name] += 1
            self.copied(name)

    def copied(self, name: str) -> None:
        """Make a variable of an argument that is set again."""
        value = self.names[name]
        kind = widened(type_of(value))
        own = f"{name}_now"
        self.top.append(Line(f"{self.unit.name_of(kind)} {own} = {self.as_type(value, kind)};"))
        self.variables[name] = kind
        self.names[name] = Code(kind, own)

    def put(self, text: str, declares: str | None = None) -> None:
        """Write a line."""
        self.lines.append(Line(text, declares, self.depth))

    def spare(self) -> str:
        """Return a name for a value between two statements."""
        self.count += 1
        return f"at_{self.count}"

    def store(self, target: ast.expr, value: Value) -> None:
        """Write a value to a target."""
        match target:
            case ast.Name(name):
                self.set_name(name, value)
            case ast.Tuple(targets):
                parts = self.parts(value, len(targets), target)
                if not all(isinstance(each, ast.Name) and self.counts[each.id] == 1
                           for each in targets):  # fmt: skip
                    parts = [self.kept(p) if isinstance(p, Code) else p for p in parts]
                for each, part in zip(targets, parts, strict=True):
                    self.store(each, part)
            case ast.Subscript():
                self.set_element(target, value)
            case _:
                raise NotTranslatable(target, ast.unparse(target))

    def parts(self, value: Value, count: int, node: ast.AST) -> list[Value]:
        """Return the items of a tuple."""
        match value:
            case Group(items):
                return list(items)
            case Record(_, fields):
                return list(fields.values())
            case Known(known) if items_of(known) is not None:
                return [self.unit.lifted(item) for item in items_of(known) or ()]
            case Code(TupleType(items)):
                whole = self.kept(value)
                return [Code(kind, whole.text + self.unit.place(whole.type, k))
                        for k, kind in enumerate(items)]  # fmt: skip
            case _:
                raise NotTranslatable(node, f"{count} parts")

    def kept(self, value: Code) -> Code:
        """Return a value that stays as it is while others are written."""
        if isinstance(value.type, ArrayType):
            return value
        name = self.spare()
        self.put(f"const {self.unit.name_of(value.type)} {name} = {value.text};", name)
        return Code(value.type, name)

    def set_name(self, name: str, value: Value) -> None:
        """Set a variable."""
        if self.counts[name] == 1:
            self.names[name] = self.constant(name, value)
            return
        kind = self.variables.get(name)
        before = self.names.get(name)
        own = before.text if kind and isinstance(before, Code) else c_name(name)
        if kind is None:
            kind = widened(type_of(value))
            if has_arrays(kind):
                raise NotTranslatable(self.tree, f"{name}, an array that is set again")
            self.variables[name] = kind
            self.top.append(Line(f"{self.unit.name_of(kind)} {own};", own))
            self.names[name] = Code(kind, own)
        self.put(f"{own} = {self.as_type(value, kind)};")

    def constant(self, name: str, value: Value) -> Value:
        """Return a variable that is set once."""
        own = c_name(name)
        kind = type_of(value) if not isinstance(value, Host) else None
        if isinstance(value, (Known, Host)) or kind is None or is_known(kind):
            return value
        if isinstance(value, Code) and isinstance(kind, ArrayType):
            return self.array(own, value, kind)
        if has_arrays(kind):
            return value
        kind = kind if isinstance(kind, RecordType) else widened(kind)
        pure = None if self.calls_writer else own
        self.calls_writer = False
        self.put(f"const {self.unit.name_of(kind)} {own} = {self.as_type(value, kind)};", pure)
        return Code(kind, own)

    def array(self, own: str, value: Code, kind: ArrayType) -> Value:
        """Return an array by its own name: memory of its own, or a pointer to another's."""
        if value.root == NEW:
            self.put(f"{kind.element.value} {own}[{kind.size}] = {value.text};", own)
            return Code(kind, own, own)
        if NAME.fullmatch(value.text):
            return value
        self.put(f"@{own}@{kind.element.value} *const {own} = {value.text};", own)
        if value.root is not None:
            self.shared.append({own, value.root})
        return Code(kind, own, own)

    def set_element(self, target: ast.Subscript, value: Value) -> None:
        """Write an element of an array, or all of a part."""
        found = self.value(as_read(target))
        if not isinstance(found, Code) or isinstance(self.value(target.value), Group):
            raise NotTranslatable(target, ast.unparse(target))
        self.write(found)
        if isinstance(found.type, ArrayType):
            text = self.as_type(value, found.type.element)
            k = self.spare()
            self.put(f"for (int {k} = 0; {k} < {found.type.size}; {k}++) {{")
            self.lines.append(Line(f"{found.text}[{k}] = {text};", None, self.depth + 1))
            self.put("}")
            return
        self.put(f"{found.text} = {self.as_type(value, found.type)};")

    def called(
        self, thing: Any, arguments: list[Value], named: dict[str, Value], node: ast.Call
    ) -> Value:
        """Return what a call gives; new arrays are blocks of the function's own."""
        if thing is np.zeros:
            shape = self.known(arguments[0], node)
            return Code(ArrayType(Scalar.REAL, items_of(shape) or (shape,)), "{0}", NEW)
        if thing is np.array:
            kind = widened(type_of(arguments[0]))
            assert isinstance(kind, TupleType)
            items = self.parts(arguments[0], len(kind.items), node)
            text = ", ".join(map(self.real, items))
            return Code(ArrayType(Scalar.REAL, (len(items),)), f"{{{text}}}", NEW)
        return super().called(thing, arguments, named, node)


NEW = "new"  # the root of an array that is made here


def plain(text: str) -> bool:
    """Say whether the outer parentheses of an expression enclose all of it."""
    depth = 0
    for k, letter in enumerate(text):
        depth += (letter == "(") - (letter == ")")
        if depth == 0 and k < len(text) - 1:
            return False
    return text.startswith("(")


def as_read(target: ast.expr) -> ast.expr:
    """Return a target as the expression that reads it."""
    return ast.parse(ast.unparse(target), mode="eval").body


def stored_names(tree: ast.AST) -> Iterator[str]:
    """Yield every name each time that it is set, but for loops."""
    loops = {id(node.target) for node in ast.walk(tree) if isinstance(node, ast.For)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield from () if id(node) in loops else (node.id,)
        if isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name):
            yield node.target.id
