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


def spans_over(most: int, tree: ast.Module) -> bool:
    """Say whether a function has more lines than so many, blank ones and docstring included."""
    return any(len(lines_of(node)) > most for node in ast.walk(tree) if isinstance(node, FUNCTIONS))


def long_functions(tree: ast.Module, code: set[int], most: int) -> list[str]:
    sizes = {
        f"{node.name}, line {node.lineno}": len(lines_of(node) & code)
        for node in ast.walk(tree)
        if isinstance(node, FUNCTIONS)
    }
    return [f"{where}: {size} lines" for where, size in sizes.items() if size > most]


def test_lines_are_counted_as_a_reader_would():
    source = (
        '"""Doc."""\n\n# note\ndef f(\n    x,\n):\n    """Doc\n    string."""\n\n    return x\n'
    )
    tree, code = ast.parse(source), code_lines(source)
    assert code == {4, 5, 6, 10}
    assert long_functions(tree, code, 4) == []
    assert long_functions(tree, code, 3) == ["f, line 4: 4 lines"]


@pytest.fixture(scope="module")
def sources() -> dict[str, str]:
    """Return the text of every module of the package by its path in it."""
    return {
        path.relative_to(PACKAGE).as_posix(): path.read_text(encoding="utf-8") for path in MODULES
    }


@pytest.fixture(scope="module")
def trees(sources) -> dict[str, ast.Module]:
    return {path: ast.parse(source) for path, source in sources.items()}


@pytest.fixture(scope="module")
def code(sources, trees) -> dict[str, set[int]]:
    """Return the lines of code of modules that may be too long, or hold what may be."""
    return {
        path: code_lines(source)
        for path, source in sources.items()
        if source.count("\n") > MODULE_LINES or spans_over(FUNCTION_LINES, trees[path])
    }


def test_every_module_is_measured_at(sources):
    assert len(sources) > 500


def test_modules_are_short(code):
    """A module that is longer is split by idea."""
    long = {path: len(lines) for path, lines in code.items() if len(lines) > MODULE_LINES}
    assert long == {}


def test_functions_are_short(trees, code):
    long = [
        f"{path}: {found}"
        for path in code
        for found in long_functions(trees[path], code[path], FUNCTION_LINES)
    ]
    assert long == []


def test_modules_say_what_they_are(trees):
    assert [path for path, tree in trees.items() if not ast.get_docstring(tree)] == []


def test_names_of_files_and_folders_mean_something(sources):
    assert [path for path in sources if VAGUE & set(re.split(r"[_./]", path))] == []


def test_only_the_app_prints(trees):
    printing = [
        f"{path}, line {node.lineno}"
        for path, tree in trees.items()
        if not path.startswith("app/")
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and node.func.id == "print"
    ]
    assert printing == []


# --- Time ------------------------------------------------------------------------------------

CLOCKS = {"perf_counter", "monotonic", "process_time", "thread_time"}
CLOCKS |= {f"{clock}_ns" for clock in CLOCKS}
TESTS = sorted((ROOT / "tests").rglob("*.py"))


def reads_clock(node: ast.AST, held: set[str]) -> bool:
    """Say whether an expression calls a clock, or takes a name that holds what one said."""
    for part in ast.walk(node):
        if isinstance(part, ast.Call):
            called = part.func
            name = called.attr if isinstance(called, ast.Attribute) else getattr(called, "id", "")
            if name in CLOCKS:
                return True
        if isinstance(part, ast.Name) and part.id in held:
            return True
    return False


def timed_assertions(tree: ast.Module) -> list[int]:
    """Return the lines of assertions on what a clock said."""
    found: list[int] = []
    for function in ast.walk(tree):
        if not isinstance(function, FUNCTIONS):
            continue
        held: set[str] = set()
        for node in ast.walk(function):
            if isinstance(node, ast.Assign) and reads_clock(node.value, held):
                held |= {part.id for each in node.targets for part in ast.walk(each)
                         if isinstance(part, ast.Name)}  # fmt: skip
        found += [node.lineno for node in ast.walk(function)
                  if isinstance(node, ast.Assert) and reads_clock(node.test, held)]  # fmt: skip
    return sorted(set(found))


def test_no_test_asserts_how_long_something_takes():
    """A busy computer is slow: time is for `benchmarks/`, work can be counted."""
    timed = {
        path.relative_to(ROOT).as_posix(): lines
        for path in TESTS
        if (source := path.read_text(encoding="utf-8"))
        and any(clock in source for clock in CLOCKS)
        and (lines := timed_assertions(ast.parse(source)))
    }
    assert timed == {}


def test_an_assertion_on_time_is_found():
    source = (
        "def test():\n    start = time.perf_counter()\n    work()\n"
        "    taken = time.perf_counter() - start\n    assert taken < 1.0\n    assert work() == 2\n"
    )
    assert timed_assertions(ast.parse(source)) == [5]
    assert timed_assertions(ast.parse("def f():\n    assert process_time() < 1")) == [2]


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
    """Running needs the first part of the file alone, the demo two; testing needs the whole."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    groups = project["dependency-groups"]
    to_run, to_show, to_test = re.split("# To (?:show|test)\n", constraints())
    pinned_to_run = names(pins(to_run))
    assert names(project["project"]["dependencies"] + groups["build"]) <= pinned_to_run
    extras = dict(project["project"]["optional-dependencies"])
    del extras["peers"]  # too large to pin, see docs/decisions/0004
    shown = extras.pop("report") + extras.pop("dashboard")
    assert names(shown) <= names(pins(to_show))
    rest = groups["dev"] + groups["docs"] + [line for lines in extras.values() for line in lines]
    ours = {"equipoise"}  # extras that are made of others
    assert names(rest) - ours <= names(pins(to_show + to_test))


def test_pins_name_nothing_twice_for_the_same_python():
    heads = [line.split(" --hash")[0] for line in pins(constraints())]
    plain = [head.split("==")[0] for head in heads if " ; " not in head]
    assert len(plain) == len(set(plain))
    assert len(heads) == len(set(heads))
