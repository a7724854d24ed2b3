"""Functions of Python as functions of C, without what they do not use."""

import inspect
import re
from collections import Counter
from collections.abc import Callable
from typing import Any

from equipoise.onboard.translation.statements import Statements
from equipoise.onboard.translation.storing import NAME, Line
from equipoise.onboard.translation.unit import (
    NOTHING,
    Instance,
    Unit,
    leaves_of,
)
from equipoise.onboard.translation.values import (
    ArrayType,
    Type,
)


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


def new_unit() -> Unit:
    """Return an empty unit."""
    return Unit(written_function)
