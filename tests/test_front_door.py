"""`import equipoise as eq` is the front door: light, complete, typed and documented."""

import ast
import inspect
import re
import subprocess
import sys
from importlib.resources import files
from pathlib import Path

import pytest

import equipoise as eq
from tests.docs.test_examples import PAGES, blocks

ROOT = Path(__file__).parents[1]
NAMES = [name for name in eq.__all__ if name != "__version__"]
VERBS = [name for name in NAMES if inspect.isfunction(getattr(eq, name))]
CLASSES = [name for name in NAMES if inspect.isclass(getattr(eq, name))]
HEAVY = ("numpy", "scipy", "numba", "matplotlib", "pandas", "xarray", "pydantic", "rich",
         "cyclopts", "jaxtyping")  # fmt: skip
PROGRAM = f"import sys, equipoise; print([m for m in {HEAVY} if m in sys.modules])"
WORD = re.compile(r"^(\w+)$", re.MULTILINE)


def section(docstring: str, title: str) -> str:
    """Return a section of a docstring in numpy's style; empty where there is none."""
    found = re.search(rf"^{title}\n-+\n(.*?)(?=^\w+\n-+\n|\Z)", docstring, re.DOTALL | re.MULTILINE)
    return found[1] if found else ""


def public_methods(kind: type) -> list[str]:
    return [
        name for name in dir(kind) if not name.startswith("_") and callable(getattr(kind, name))
    ]


def test_the_import_loads_no_library():
    run = [sys.executable, "-c", PROGRAM]
    done = subprocess.run(run, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_the_names_are_those_of_the_issue():
    assert set(NAMES) == {
        "read_testbed", "preset", "read_recording", "write_recording", "identify", "assess",
        "observe", "balance", "plan", "design", "calibrate", "compare", "simulate", "inertia",
        "SimulatedBench", "open_bench", "MassProperties", "Recording", "Estimate", "methods",
        "laws", "export", "InputError", "feed_forward", "ledger", "keep",
    }  # fmt: skip
    assert dir(eq) == sorted(eq.__all__)


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no attribute 'identity'"):
        _ = eq.identity


def test_type_checkers_are_reported_the_same_homes():
    """The imports under TYPE_CHECKING and the table of homes are one list."""
    tree = ast.parse(inspect.getsource(eq))
    (guarded,) = [node for node in tree.body if isinstance(node, ast.If)]
    guarded_homes = {
        alias.name: node.module
        for node in guarded.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    assert guarded_homes == eq.HOMES


def test_no_room_has_the_name_of_a_verb():
    """Importing such a room would put the module in the verb's place."""
    rooms = {path.stem for path in (ROOT / "src/equipoise").iterdir()}
    assert not rooms & set(eq.__all__)


def test_types_ship():
    assert (files("equipoise") / "py.typed").is_file()


@pytest.mark.parametrize("name", VERBS)
def test_a_verb_documents_every_option_and_what_it_raises(name):
    verb = getattr(eq, name)
    text = inspect.getdoc(verb) or ""
    options = list(inspect.signature(verb).parameters)
    documented = WORD.findall(section(text, "Parameters"))
    if len(options) > 2:
        assert documented == options
    if options:
        assert section(text, "Raises")


@pytest.mark.parametrize("way", [eq.Recording.from_arrays, eq.Recording.from_pandas])
def test_a_way_to_make_a_recording_documents_every_option_and_what_it_raises(way):
    text = inspect.getdoc(way) or ""
    assert WORD.findall(section(text, "Parameters")) == list(inspect.signature(way).parameters)
    assert section(text, "Raises")


@pytest.mark.parametrize("name", CLASSES)
def test_a_class_documents_itself_and_its_methods(name):
    kind = getattr(eq, name)
    assert inspect.getdoc(kind)
    assert [m for m in public_methods(kind) if not inspect.getdoc(getattr(kind, m))] == []


@pytest.mark.parametrize("name", NAMES)
def test_a_public_name_stands_in_readme_or_docs(name):
    pages = (page.read_text(encoding="utf-8") for page in PAGES)
    assert any(re.search(rf"\beq\.{name}\b", text) for text in pages)


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.relative_to(ROOT).as_posix())
def test_examples_enter_by_the_front_door(page):
    code = [b.text for b in blocks(page.read_text(encoding="utf-8")) if b.kind == "python"]
    assert not re.search(r"(from|import) equipoise\.", "\n".join(code))
