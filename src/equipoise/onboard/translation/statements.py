"""Statements of Python as statements of C, and functions made of them.

A variable that is set once is a constant of C, or no variable at all where its value is known. One
that is set again is declared at the top. Both sides of ``a, b = b, a`` are read before either is
written. A branch that is excluded by what is known is not written.
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

from equipoise.onboard.translation.expressions import Expressions, as_text
from equipoise.onboard.translation.unit import (
    NOTHING,
    Instance,
    NotTranslatable,
    Unit,
    c_name,
    leaves_of,
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


class Statements(Expressions):
    """Writes the statements of one function."""

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

    # --- Lines -------------------------------------------------------------------------------

    def put(self, text: str, declares: str | None = None) -> None:
        """Write a line."""
        self.lines.append(Line(text, declares, self.depth))

    def spare(self) -> str:
        """Return a name for a value between two statements."""
        self.count += 1
        return f"at_{self.count}"

    def body(self, nodes: list[ast.stmt]) -> bool:
        """Write statements; say whether none after them is reached."""
        for node in nodes:
            handler = getattr(self, f"write_{type(node).__name__.lower()}", None)
            if handler is None:
                raise NotTranslatable(node, ast.unparse(node))
            if handler(node):
                return True
        return False

    def write_pass(self, node: ast.Pass) -> None:
        """Write nothing."""

    def write_assert(self, node: ast.Assert) -> None:
        """Write nothing: Python has checked it."""

    def write_expr(self, node: ast.Expr) -> None:
        """Write a call; a docstring is not one."""
        if isinstance(node.value, ast.Call):
            value = self.value(node.value)
            assert isinstance(value, Code)
            self.put(f"{value.text};" if value.type == NOTHING else f"(void){value.text};")

    def write_return(self, node: ast.Return) -> bool:
        """Write the end."""
        if node.value is None:
            self.put("return;")
            return True
        value = self.value(node.value)
        kind = type_of(value)
        kind = kind if isinstance(kind, RecordType) else widened(kind)
        self.returns = self.returns or kind
        self.put(f"return {self.as_type(value, self.returns)};")
        return True

    def write_if(self, node: ast.If) -> bool:
        """Write a branch, or the one branch that is reached."""
        truth = self.truth(self.value(node.test))
        if isinstance(truth, bool):
            return self.body(node.body if truth else node.orelse)
        self.put(f"if ({truth.removeprefix('(').removesuffix(')') if plain(truth) else truth}) {{")
        ended = self.block(node.body)
        if node.orelse:
            self.put("} else {")
            ended = self.block(node.orelse) and ended
        self.put("}")
        return bool(node.orelse) and ended

    def block(self, nodes: list[ast.stmt]) -> bool:
        """Write statements one level deeper."""
        self.depth += 1
        ended = self.body(nodes)
        self.depth -= 1
        return ended

    def write_for(self, node: ast.For) -> None:
        """Write a loop over a range."""
        if not (isinstance(node.iter, ast.Call) and isinstance(node.target, ast.Name)):
            raise NotTranslatable(node, ast.unparse(node.iter))
        bounds = [self.value(each) for each in node.iter.args]
        first, last = (Known(0), bounds[0]) if len(bounds) == 1 else (bounds[0], bounds[1])
        name = c_name(node.target.id)
        a, b = self.integer(first), self.integer(last)
        self.put(f"for (int {name} = {a}; {name} < {b}; {name}++) {{")
        self.names[node.target.id] = Code(Scalar.INT, name)
        self.block(node.body)
        self.put("}")

    def write_while(self, node: ast.While) -> None:
        """Write a loop."""
        truth = self.truth(self.value(node.test))
        self.put(f"while ({as_text(truth)}) {{")
        self.block(node.body)
        self.put("}")

    def write_augassign(self, node: ast.AugAssign) -> None:
        """Write a change of a variable or of an element."""
        self.store(node.target, self.combined(node.op, self.value(as_read(node.target)),
                                              self.value(node.value)))  # fmt: skip

    def write_annassign(self, node: ast.AnnAssign) -> None:
        """Write an assignment with a type that the reader needs."""
        assert node.value is not None
        self.store(node.target, self.value(node.value))

    def write_assign(self, node: ast.Assign) -> None:
        """Write an assignment to one target or several."""
        value = self.value(node.value)
        if len(node.targets) > 1 and isinstance(value, Code):
            value = self.kept(value)
        for target in node.targets:
            self.store(target, value)

    # --- Storing -----------------------------------------------------------------------------

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


def without_unused(lines: list[Line]) -> list[Line]:
    """Return lines without variables that nothing reads."""
    while True:
        used = Counter(name for line in lines for name in set(NAME.findall(line.text)))
        kept = [line for line in lines if line.declares is None or used[line.declares] > 1]
        if len(kept) == len(lines):
            return kept
        lines = kept


def written_function(unit: Unit, function: Callable[..., Any], kinds: dict[str, Type]) -> Instance:
    """Write a function for these types of arguments into the unit."""
    scope = Statements(unit, function, kinds)
    scope.body(scope.tree.body)
    lines = without_unused([*scope.top, *scope.lines])
    used = {name for line in lines for name in NAME.findall(line.text)}
    leaves = tuple(
        leaf for n, kind in kinds.items() for leaf in leaves_of(kind, (n,)) if leaf.name in used
    )
    written = scope.all_written()
    returns = scope.returns or NOTHING
    name = unit.unique(f"eq_{function.__name__.lstrip('_')}")
    texts = [parameter(unit, leaf.name, leaf.kind, leaf.name in written) for leaf in leaves]
    head = f"static {unit.name_of(returns)} {name}({', '.join(texts) or 'void'})"
    summary = (inspect.getdoc(function) or "").split("\n")[0].replace("*/", "* /")
    body = "\n".join("    " * line.depth + constness(line.text, written) for line in lines)
    unit.names.append(name)
    unit.functions.append(f"/* {summary} */\n{head}\n{{\n{body}\n}}")
    return Instance(name, leaves, returns, frozenset(written & {leaf.name for leaf in leaves}))


def parameter(unit: Unit, name: str, kind: Type, is_written: bool) -> str:
    """Return the declaration of a parameter."""
    if isinstance(kind, ArrayType):
        return f"{'' if is_written else 'const '}{kind.element.value} *{name}"
    return f"{unit.name_of(kind)} {name}"


def constness(text: str, written: set[str]) -> str:
    """Return a line with a pointer to memory that is only read as such."""
    found = re.match(r"@(\w+)@", text)
    if found is None:
        return text
    return ("" if found[1] in written else "const ") + text[found.end() :]
