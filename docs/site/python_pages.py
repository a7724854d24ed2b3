"""A page for each public name of `equipoise`, from its docstring."""

import inspect
from collections.abc import Iterator

import equipoise

PLACE = "reference/python"
HEAD = """# Python API

Every public name of `import equipoise as eq`, from its docstring. [Python](../../python.md)
introduces them with examples. Numbers are in SI units.

| name | purpose |
|---|---|
"""
CLASS = """:members:
:inherited-members:
:undoc-members:
"""


def python_pages() -> Iterator[tuple[str, str]]:
    """Yield each name's page and the list of them, by their paths in the site."""
    names = [name for name in equipoise.__all__ if not name.startswith("_")]
    for name in names:
        yield f"{PLACE}/{name}.md", _page(name)
    rows = "".join(f"| [`eq.{name}`]({name}.md) | {_purpose(name)} |\n" for name in names)
    tree = "\n".join(["```{toctree}", ":hidden:", "", *names, "```", ""])
    yield f"{PLACE}/index.md", f"{HEAD}{rows}\n{tree}"


def _page(name: str) -> str:
    is_class = inspect.isclass(getattr(equipoise, name))
    kind, options = ("autoclass", CLASS) if is_class else ("autofunction", "")
    directive = f".. {kind}:: equipoise.{name}\n"
    directive += "".join(f"   {line}\n" for line in options.splitlines())
    return f"# eq.{name}\n\n```{{eval-rst}}\n{directive}```\n"


def _purpose(name: str) -> str:
    """Return the first sentence of a docstring."""
    paragraph = (inspect.getdoc(getattr(equipoise, name)) or "").split("\n\n")[0]
    return " ".join(paragraph.split())
