"""Errors say the same in whatever process they are printed."""

import ast
import pickle
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from equipoise.model import errors
from equipoise.model.errors import DriveRefused, InputError, MoveRefused, nearest

SOURCES = sorted(Path(errors.__file__).parents[1].rglob("*.py"))

ERRORS = [
    InputError("here", "this", "that"),
    MoveRefused("x1", 0.0, 0.06, -0.05, 0.05),
    DriveRefused("wheel x", 2.0, 1.0, "N m"),
]


@pytest.mark.parametrize("error", ERRORS, ids=lambda error: type(error).__name__)
def test_an_error_comes_back_whole_from_another_process(error):
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error)
    assert str(again) == str(error)
    assert vars(again) == vars(error)
    assert vars(error)


NAME = st.text("abx1", min_size=1, max_size=4)


@given(name=NAME, known=st.lists(NAME, min_size=1, max_size=5))
def test_a_name_that_was_meant_is_offered_once(name, known):
    """A sentence wants something or asks what was meant, and does neither twice."""
    sentence = str(InputError("here", f"'{name}'", nearest(name, known)))
    ends = [sentence.count("; wanted one of "), sentence.count("; did you mean '")]
    assert sum(ends) == 1
    assert sentence.count("did you mean") == ends[1]
    assert sentence.count("wanted") == ends[0]


def wrapped(tree: ast.AST) -> Iterator[int]:
    """Yield the lines where what ``nearest`` returns becomes part of a longer text."""
    calls = [n for n in ast.walk(tree) if isinstance(n, ast.Call) and is_nearest(n.func)]
    kept = {
        target.id
        for node in ast.walk(tree)
        if isinstance(node, ast.Assign) and any(call in ast.walk(node.value) for call in calls)
        for target in node.targets
        if isinstance(target, ast.Name)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr | ast.BinOp):
            inside = [*ast.walk(node)]
            if any(n in calls or (isinstance(n, ast.Name) and n.id in kept) for n in inside):
                yield node.lineno


def is_nearest(function: ast.expr) -> bool:
    return isinstance(function, ast.Name) and function.id == "nearest"


def functions(path: Path) -> Iterator[ast.AST]:
    """Yield the functions of a module that imports ``nearest`` from the errors."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    imported = any(
        isinstance(n, ast.ImportFrom)
        and n.module == errors.__name__
        and any(alias.name == "nearest" for alias in n.names)
        for n in tree.body
    )
    yield from (n for n in ast.walk(tree) if imported and isinstance(n, ast.FunctionDef))


def test_every_caller_passes_on_whole_what_nearest_returns():
    """Wrapped, it reads "a preset (did you mean 'x'?)", or asks twice."""
    assert sum(1 for path in SOURCES for _ in functions(path)) > 30
    found = {
        f"{path.name}:{line}" for path in SOURCES for each in functions(path)
        for line in wrapped(each)
    }  # fmt: skip
    assert found == set()


@pytest.mark.parametrize(
    "text", ['f"one ({nearest(a, b)})"', 'nearest(a, b) + "of"', "f'one ({w})'"]
)
def test_what_is_wrapped_is_found(text):
    """The last one keeps it under a name first."""
    assert list(wrapped(ast.parse(f"w = nearest(a, b)\n\nresult = {text}"))) == [3]
