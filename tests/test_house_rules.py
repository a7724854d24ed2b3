"""What CONTRIBUTING.md asks for and no linter checks."""

import ast
import io
import re
import tokenize
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "src" / "equipoise"
MODULES = sorted(PACKAGE.rglob("*.py"))

MODULE_LINES = 300  # of code: no blanks, comments or docstrings
FUNCTION_LINES = 50  # likewise
VAGUE = {"utils", "util", "helpers", "helper", "common", "manager", "misc", "tools"}
NOT_CODE = {
    tokenize.COMMENT,
    tokenize.NL,
    tokenize.NEWLINE,
    tokenize.INDENT,
    tokenize.DEDENT,
    tokenize.ENDMARKER,
}
WITH_DOCSTRING = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)

every_module = pytest.mark.parametrize(
    "path", MODULES, ids=lambda path: path.relative_to(PACKAGE).as_posix()
)


def lines_of(node: ast.AST) -> set[int]:
    return set(range(node.lineno, node.end_lineno + 1))


def docstring_lines(tree: ast.AST) -> set[int]:
    found: set[int] = set()
    for node in ast.walk(tree):
        if isinstance(node, WITH_DOCSTRING) and ast.get_docstring(node, clean=False) is not None:
            found |= lines_of(node.body[0])
    return found


def code_lines(source: str) -> set[int]:
    """Return the numbers of the lines that hold code."""
    found: set[int] = set()
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type not in NOT_CODE:
            found.update(range(token.start[0], token.end[0] + 1))
    return found - docstring_lines(ast.parse(source))


def long_functions(source: str, most: int) -> list[str]:
    code = code_lines(source)
    sizes = {
        f"{node.name}, line {node.lineno}": len(lines_of(node) & code)
        for node in ast.walk(ast.parse(source))
        if isinstance(node, FUNCTIONS)
    }
    return [f"{where}: {size} lines" for where, size in sizes.items() if size > most]


def test_lines_are_counted_as_a_reader_would():
    source = (
        '"""Doc."""\n\n# note\ndef f(\n    x,\n):\n    """Doc\n    string."""\n\n    return x\n'
    )
    assert code_lines(source) == {4, 5, 6, 10}
    assert long_functions(source, 4) == []
    assert long_functions(source, 3) == ["f, line 4: 4 lines"]


@every_module
def test_module_is_short(path):
    assert len(code_lines(path.read_text(encoding="utf-8"))) <= MODULE_LINES, "split it by idea"


@every_module
def test_functions_are_short(path):
    assert long_functions(path.read_text(encoding="utf-8"), FUNCTION_LINES) == []


@every_module
def test_module_says_what_it_is(path):
    assert ast.get_docstring(ast.parse(path.read_text(encoding="utf-8")))


@every_module
def test_name_means_something(path):
    words = {word for part in path.relative_to(PACKAGE).parts for word in re.split(r"[_.]", part)}
    assert not words & VAGUE


@every_module
def test_only_the_app_prints(path):
    calls = [
        node.lineno
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and node.func.id == "print"
    ]
    assert not calls or path.is_relative_to(PACKAGE / "app")


# --- Pins ------------------------------------------------------------------------------------

PIN = re.compile(r"[a-z0-9][a-z0-9.-]*==[0-9][0-9a-z.]*( ; [^\\]+)?( --hash=sha256:[0-9a-f]{64})+")


def pins(text: str) -> list[str]:
    """Return one line per pin: continuation lines are joined, comments go."""
    joined = re.sub(r"\s*\\\n\s*", " ", text)
    return [line for line in joined.splitlines() if line and not line.startswith("#")]


def names(requirements: list[str]) -> set[str]:
    return {re.split(r"[\[<>=~! ;]", line)[0].lower() for line in requirements}


def constraints() -> str:
    return (ROOT / "constraints.txt").read_text(encoding="utf-8")


def test_pins_hold_names_versions_and_hashes_only():
    odd = [line[:60] for line in pins(constraints()) if not PIN.fullmatch(line)]
    assert odd == []


def test_pins_name_no_address():
    assert not re.search(r"://|index-url|find-links|trusted-host|file:| @ ", constraints())


def test_pins_cover_the_project_requirements():
    """Running needs the first part of the file alone; testing needs the whole."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    groups = project["dependency-groups"]
    to_run, to_test = constraints().split("# To test\n")
    pinned_to_run = names(pins(to_run))
    assert names(project["project"]["dependencies"] + groups["build"]) <= pinned_to_run
    extras = dict(project["project"]["optional-dependencies"])
    del extras["peers"]  # too large to pin, see docs/decisions/0004
    assert names(groups["dev"] + [line for lines in extras.values() for line in lines]) <= names(
        pins(to_test)
    )


def test_pins_name_nothing_twice_for_the_same_python():
    heads = [line.split(" --hash")[0] for line in pins(constraints())]
    plain = [head.split("==")[0] for head in heads if " ; " not in head]
    assert len(plain) == len(set(plain))
    assert len(heads) == len(set(heads))
