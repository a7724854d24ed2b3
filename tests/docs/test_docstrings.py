"""Examples in docstrings are run, in the modules that have one; the others are not imported."""

import doctest
import importlib
import importlib.util
from pathlib import Path
from types import ModuleType

PACKAGE = Path(__file__).parents[2] / "src" / "equipoise"


def with_examples(folder: Path) -> list[Path]:
    return [path for path in sorted(folder.rglob("*.py")) if b">>> " in path.read_bytes()]


def failures(module: ModuleType) -> int:
    return doctest.testmod(module, verbose=False).failed


def test_examples_print_what_they_say():
    names = [
        ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts)
        for path in with_examples(PACKAGE)
    ]
    assert [name for name in names if failures(importlib.import_module(name))] == []


def test_an_example_that_lies_is_found(tmp_path, capsys):
    path = tmp_path / "module.py"
    path.write_text('"""Doc.\n\n>>> 1 + 1\n3\n"""\n')
    (tmp_path / "plain.py").write_text('"""Doc."""\n')
    assert with_examples(tmp_path) == [path]
    spec = importlib.util.spec_from_file_location("module", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert failures(module) == 1
    assert "Expected:\n    3" in capsys.readouterr().out
