"""Which module of the package imports which, read from the source, and the circles among them."""

import ast
from collections import defaultdict
from collections.abc import Iterator, Mapping
from pathlib import Path

Graph = Mapping[str, frozenset[str]]


def modules(source: Path) -> dict[str, Path]:
    """Return the file of each module and package below a source folder, by its dotted name."""
    named = {path.relative_to(source).with_suffix(""): path for path in source.rglob("*.py")}
    return {
        ".".join(name.parent.parts if name.name == "__init__" else name.parts): path
        for name, path in sorted(named.items())
    }


def import_graph(source: Path) -> Graph:
    """Return what each module imports, inside functions too; what only types need is left out."""
    files = modules(source)
    return {
        name: frozenset(imported(ast.parse(path.read_text("utf-8")), files)) - {name}
        for name, path in files.items()
    }


def imported(tree: ast.AST, known: Mapping[str, Path]) -> Iterator[str]:
    """Yield the known modules that a module imports."""
    for node in run_nodes(tree):
        names = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module is not None:
            whole = [f"{node.module}.{alias.name}" for alias in node.names]
            names = [name if name in known else node.module for name in whole]
        yield from (name for name in names if name in known)


def run_nodes(tree: ast.AST) -> Iterator[ast.AST]:
    """Yield all nodes of a tree but those that run under a type checker alone."""
    for child in ast.iter_child_nodes(tree):
        if isinstance(child, ast.If) and "TYPE_CHECKING" in ast.unparse(child.test):
            continue
        yield child
        yield from run_nodes(child)


def inside(graph: Graph, room: str) -> Graph:
    """Return the graph of a room's own modules and sub-rooms, each sub-room as one."""

    def part(module: str) -> str | None:
        name = module.removeprefix(f"{room}.")
        return None if name == module else name.partition(".")[0]

    among = defaultdict[str, set[str]](set)
    for module, targets in graph.items():
        here = part(module)
        if here is not None:
            among[here] |= {there for t in targets if (there := part(t)) not in (None, here)}
    return {name: frozenset(targets) for name, targets in among.items()}


def circles(graph: Graph) -> list[list[str]]:
    """Return the members of each circle: all that reach each other, by name."""
    reach = {name: reached(graph, name) for name in graph}
    found = {
        tuple(sorted(other for other in reach[name] if name in reach.get(other, ())))
        for name in graph
        if name in reach[name]
    }
    return [list(members) for members in sorted(found)]


def reached(graph: Graph, start: str) -> set[str]:
    """Return all that is reached from a name in one step or more."""
    found, ahead = set[str](), [start]
    while ahead:
        fresh = graph.get(ahead.pop(), frozenset()) - found
        found |= fresh
        ahead += fresh
    return found
