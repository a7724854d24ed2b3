"""A unit of C: the functions that one Python function needs, its structs and its tables.

A function is written once for each combination of argument types. What is known of an argument (a
number of masses, a switch of the model) is part of its type: branches that it excludes are not
written, and fields that nobody reads are not passed.
"""

import ast
import inspect
import re
import textwrap
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from equipoise.onboard.translation.literals import real_literal
from equipoise.onboard.translation.values import (
    ArrayType,
    Code,
    Host,
    Known,
    KnownType,
    Record,
    RecordClass,
    RecordType,
    Scalar,
    TupleType,
    Type,
    Value,
    has_arrays,
    is_known,
    known_type,
    lifted,
    type_of,
    widened,
)

PREFIX = "eq_"
NOTHING = known_type(None)


class NotTranslatable(TypeError):
    """A line of Python that has no counterpart in C."""

    def __init__(self, node: ast.AST, found: str) -> None:
        super().__init__(f"line {getattr(node, 'lineno', '?')}: {found}")


@dataclass(frozen=True, slots=True)
class Leaf:
    """What a C function takes: an argument, or a field of one."""

    path: tuple[str, ...]
    kind: Type

    @property
    def name(self) -> str:
        """Its name in C."""
        return c_name("_".join(self.path))


@dataclass(frozen=True, slots=True)
class Instance:
    """A function for one combination of argument types."""

    name: str
    leaves: tuple[Leaf, ...]  # those that it uses
    returns: Type
    written: frozenset[str]  # names of arrays that it changes


class Scope(Protocol):
    """What a unit needs of the function that calls another."""

    shared: list[set[str]]
    calls_writer: bool

    def as_type(self, value: Value, kind: Type) -> str:
        """Return a value as a C expression of a type."""
        ...

    def write(self, array: Code) -> None:
        """Note that an array is changed."""
        ...


@dataclass(slots=True)
class Unit:
    """The text of a unit, as it grows; ``write`` writes one function (``functions``)."""

    write: Callable[["Unit", Callable[..., Any], dict[str, Type]], Instance]
    names: list[str] = field(default_factory=list[str])  # of the functions, in their order
    functions: list[str] = field(default_factory=list[str])
    structs: dict[Type, tuple[str, str]] = field(default_factory=dict[Type, tuple[str, str]])
    tables: dict[bytes, tuple[Code, str]] = field(default_factory=dict[bytes, tuple[Code, str]])
    instances: dict[Any, Instance] = field(default_factory=dict[Any, Instance])
    taken: set[str] = field(default_factory=set[str])

    # --- Values ------------------------------------------------------------------------------

    def lifted(self, thing: Any) -> Value:
        """Return what is known of a thing of Python; an array becomes a table."""
        if isinstance(thing, np.ndarray):
            return self.table(thing)
        if hasattr(thing, "_fields") and not isinstance(thing, type):
            fields = {n: self.lifted(getattr(thing, n)) for n in thing._fields}
            return Record(class_of(thing), fields)
        return lifted(thing)

    def table(self, values: Any) -> Code:
        """Return a constant array."""
        flat = np.ascontiguousarray(values, dtype=np.float64)
        key = flat.tobytes() + repr(flat.shape).encode()
        if key not in self.tables:
            name = f"{PREFIX}table_{len(self.tables)}"
            numbers = ", ".join(real_literal(x) for x in flat.reshape(-1)) or "R(0.0)"
            size = max(flat.size, 1)
            text = f"static const real_t {name}[{size}] = {{{numbers}}};"
            self.tables[key] = (Code(ArrayType(Scalar.REAL, flat.shape), name), text)
        return self.tables[key][0]

    def built(self, kind: Type, text: str, path: str = "") -> Value:
        """Return the value of a type that C has as ``text``; of a record with arrays its fields."""
        if isinstance(kind, KnownType):
            return kind.value if isinstance(kind.value, Host) else Known(kind.value)
        if isinstance(kind, RecordType) and (has_arrays(kind) or is_known(kind)):
            fields = {n: self.built(each, c_name(f"{text}_{n}")) for n, each in kind.fields}
            return Record(kind.cls, fields)
        return Code(kind, text, text if isinstance(kind, ArrayType) else None)

    def place(self, kind: Type, index: int) -> str:
        """Return how C reads an item of a tuple."""
        assert isinstance(kind, TupleType)
        index %= len(kind.items)
        return f".v[{index}]" if kind.is_even else f".f{index}"

    def share(self, scope: "Scope", roots: list[str]) -> None:
        """Note that arrays stand for each other: what writes one may write all."""
        scope.shared.append(set(roots))

    # --- Types -------------------------------------------------------------------------------

    def name_of(self, kind: Type) -> str:
        """Return the name of a type in C; structs are declared when first met."""
        if isinstance(kind, Scalar):
            return kind.value
        if kind == NOTHING:
            return "void"
        if kind not in self.structs:
            text = self.members(kind)
            base = PREFIX + (
                kind.cls.__name__.lower() if isinstance(kind, RecordType) else
                f"real{len(kind.items)}" if isinstance(kind, TupleType)
                and set(kind.items) == {Scalar.REAL} else "pair"
            )  # fmt: skip
            name = self.unique(f"{base}_t")
            self.structs[kind] = (name, f"typedef struct {{ {text} }} {name};")
        return self.structs[kind][0]

    def members(self, kind: Type) -> str:
        """Return the members of a struct."""
        if isinstance(kind, TupleType) and kind.is_even:
            return f"{self.name_of(kind.items[0])} v[{len(kind.items)}];"
        if isinstance(kind, TupleType):
            return " ".join(f"{self.name_of(t)} f{k};" for k, t in enumerate(kind.items))
        assert isinstance(kind, RecordType)
        return " ".join(f"{self.name_of(each)} {name};" for name, each in kind.stored)

    def unique(self, name: str) -> str:
        """Return a name that nothing else bears."""
        base, k = name, 2
        while name in self.taken:
            name, k = f"{base}{k}", k + 1
        self.taken.add(name)
        return name

    # --- Calls -------------------------------------------------------------------------------

    def call(
        self,
        scope: "Scope",
        function: Callable[..., Any],
        arguments: list[Value],
        named: dict[str, Value],
    ) -> Value:
        """Return the call of a function, which is written if it is not there yet."""
        values = self.bound(function, arguments, named)
        kinds = tuple(argument_type(value) for value in values.values())
        instance = self.instance(function, dict(zip(values, kinds, strict=True)))
        texts: list[str] = []
        for leaf in instance.leaves:
            value = followed(values, leaf.path)
            texts.append(scope.as_type(value, leaf.kind))
            if leaf.name in instance.written and isinstance(value, Code):
                scope.write(value)
        text = f"{instance.name}({', '.join(texts)})"
        scope.calls_writer = scope.calls_writer or bool(instance.written)
        return Code(instance.returns, text)

    def bound(
        self, function: Callable[..., Any], arguments: list[Value], named: dict[str, Value]
    ) -> dict[str, Value]:
        """Return arguments by name, with the defaults of those that are not given."""
        parameters = inspect.signature(function).parameters
        values = dict(zip(parameters, arguments, strict=False)) | named
        defaults = {
            name: self.lifted(each.default)
            for name, each in parameters.items()
            if name not in values
        }
        return {name: (values | defaults)[name] for name in parameters}

    def instance(self, function: Callable[..., Any], kinds: dict[str, Type]) -> Instance:
        """Return a function for these types of arguments."""
        key = (function, tuple(kinds.items()))
        if key not in self.instances:
            self.instances[key] = self.write(self, function, kinds)
        return self.instances[key]

    def text_for(self, entry: str, call: str) -> str:
        """Return the text of what a call of a function needs, that function at the end."""
        bodies = {name: text for name, text in zip(self.names, self.functions, strict=True)}
        texts = [bodies[name] for name in self.names if name in reached(entry, bodies)]
        used = words("\n".join([*texts, call]))
        structs = dict(reversed(self.structs.values()))
        kept = list[str]()
        for name, text in structs.items():
            if name in used:
                kept.insert(0, text)
                used |= words(text)
        tables = [text for code, text in self.tables.values() if code.text in used]
        return "\n\n".join(["\n".join(kept), *(["\n".join(tables)] if tables else []), *texts])


def words(text: str) -> set[str]:
    """Return the identifiers of a text."""
    return set(re.findall(r"[A-Za-z_]\w*", text))


def reached(entry: str, bodies: dict[str, str]) -> set[str]:
    """Return the names of functions that one calls, and itself."""
    found, waiting = set[str](), [entry]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += [other for other in words(bodies[name]) if other in bodies]
    return found


def class_of(thing: Any) -> RecordClass:
    """Return the class of a NamedTuple."""
    return thing.__class__


def argument_type(value: Value) -> Type:
    """Return the type of an argument: a switch or a count stays known, a measure does not."""
    kind = type_of(value)
    if isinstance(kind, KnownType) and isinstance(kind.value, (float, tuple)):
        return widened(kind)
    return kind


def followed(values: dict[str, Value], path: tuple[str, ...]) -> Value:
    """Return an argument, or a field of one."""
    value = values[path[0]]
    for name in path[1:]:
        assert isinstance(value, Record)
        value = value.fields[name]
    return value


def leaves_of(kind: Type, path: tuple[str, ...]) -> list[Leaf]:
    """Return what C passes of an argument."""
    if is_known(kind):
        return []
    if isinstance(kind, RecordType) and has_arrays(kind):
        return [leaf for name, each in kind.fields for leaf in leaves_of(each, (*path, name))]
    return [Leaf(path, kind)]


RESERVED = {
    "auto", "break", "case", "char", "const", "default", "do", "double", "else", "enum", "extern",
    "float", "for", "goto", "if", "inline", "int", "long", "register", "restrict", "return",
    "short", "signed", "sizeof", "static", "struct", "switch", "typedef", "union", "unsigned",
    "void", "volatile", "while", "bool", "true", "false", "R",
}  # fmt: skip


def c_name(name: str) -> str:
    """Return a name that C accepts."""
    return f"{name}_" if name in RESERVED else name


def tree_of(function: Callable[..., Any]) -> ast.FunctionDef:
    """Return the source of a function as a tree."""
    (tree,) = ast.parse(textwrap.dedent(inspect.getsource(function))).body
    assert isinstance(tree, ast.FunctionDef)
    return tree
