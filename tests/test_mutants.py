"""The list of what `make mutants` breaks is true of the code as it stands."""

import ast
from pathlib import Path

from verification.mutants.catalogue import MUTANTS

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "src" / "equipoise"
FEWEST = 60


def test_each_stands_once_in_its_file_and_is_still_code_when_broken():
    lost = []
    for mutant in MUTANTS:
        text = (PACKAGE / mutant.path).read_text(encoding="utf-8")
        if text.count(mutant.old) != 1:
            lost.append(f"{mutant.path}: {mutant.old!r} {text.count(mutant.old)} times")
        elif mutant.path.endswith(".py"):
            ast.parse(text.replace(mutant.old, mutant.new))
    assert lost == []


def test_every_room_has_some():
    rooms = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    assert {mutant.room for mutant in MUTANTS} == rooms
    assert len(set(MUTANTS)) == len(MUTANTS) >= FEWEST


def stands(test: str) -> bool:
    path, _, name = test.partition("::")
    file = ROOT / "tests" / path
    return file.exists() and (not name or f"def {name}(" in file.read_text(encoding="utf-8"))


def test_the_tests_that_have_to_fail_are_there():
    wanted = {each for mutant in MUTANTS for each in mutant.tests.split()}
    assert [each for each in sorted(wanted) if not stands(each)] == []
