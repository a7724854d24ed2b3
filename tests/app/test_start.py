"""Commands load what they use: libraries that take long to import come when they are needed."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

SOURCES = sorted(Path(__file__).parents[2].joinpath("src").rglob("*.py"))
SLOW = ("scipy", "numba", "matplotlib", "pyarrow", "pandas")
COMPILING = {
    "compiler", "linked", "returned_in_c", "kernel_cache", "kept_kernels", "ready_kernels",
}  # fmt: skip
LOADED = """
import sys
from equipoise.app.cli import run
code = run(sys.argv[1:])
print(code, *sorted(sys.modules), sep="\\n")
"""


def loaded(*words):
    """Return the exit code of a command, and the modules that it has loaded."""
    program = [sys.executable, "-c", LOADED, *map(str, words)]
    ended = subprocess.run(program, capture_output=True, encoding="utf-8", check=True)
    after = ended.stdout.rpartition("\n0\n")
    return after[1].strip(), set(after[2].split())


def heads(source):
    """Yield what a module imports when it is imported itself."""
    for node in ast.parse(source.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.module


def test_no_module_loads_a_slow_library_at_its_head():
    """SciPy alone loads none of its packages before one is used."""
    found = {
        source.stem: names
        for source in SOURCES
        if (names := [n for n in heads(source) if n != "scipy" and n.partition(".")[0] in SLOW])
    }
    assert found.keys() - {"notebook_figure"} <= COMPILING  # loaded with the first figure


@pytest.mark.parametrize("command", ["identify", "inspect", "assess"])
def test_a_command_that_draws_nothing_loads_neither_figures_nor_statistics(
    command, record_file, monkeypatch
):
    monkeypatch.setenv("EQUIPOISE_RUNS", "")
    code, modules = loaded(command, record_file, "--testbed", "sputnix")
    assert code == "0"
    assert "numpy" in modules
    assert not modules & {"matplotlib", "scipy.signal", "scipy.stats"}


def test_a_fit_loads_little_of_scipy_and_nothing_for_compiling(record_file, monkeypatch):
    """Of kernels that are kept, which the first of both runs sees to."""
    monkeypatch.setenv("EQUIPOISE_RUNS", "")
    words = ("observe", record_file, "--testbed", "sputnix")
    loaded(*words)
    code, modules = loaded(*words)
    assert code == "0"
    assert "numba" in modules
    packages = {"fft", "integrate", "optimize", "signal", "sparse", "stats"}
    assert not modules & {f"scipy.{name}" for name in packages}
    assert not modules & {"numba.np.linalg", "cffi"}
