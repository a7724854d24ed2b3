"""Kernels outlive copies and checkouts, and never the sources that they were made from."""

import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from equipoise.maths.kernels import kernel_cache
from equipoise.maths.kernels.kernel_cache import PACKAGE, folder_of, imported, stamp

CALLER = """\
'''A kernel that calls a part of another module.'''
from equipoise.low.part import twice
from equipoise.maths.kernels.compiled import kernel

@kernel
def above(x: float) -> float:
    return 1.0 + twice(x)
"""
PART = """\
'''A part.'''
from equipoise.low.factor import FACTOR
from equipoise.maths.kernels.compiled import part

@part
def twice(x: float) -> float:
    return FACTOR * x
"""
RUN = """\
import sys
from equipoise.high.caller import above
from numba.core import event
from equipoise.maths.kernels import kernel_cache
compiled = []
class Listener(event.Listener):
    def on_start(self, event): compiled.append(event)
    def on_end(self, event): pass
with event.install_listener("numba:compile", Listener()):
    print(above(3.0), len(compiled) > 0)
"""


@pytest.fixture
def package(tmp_path):
    """A package of two rooms beside our own compiler's door, in a checkout of its own."""
    package = tmp_path / "one" / "equipoise"
    for room in ("low", "high", "maths"):
        (package / room).mkdir(parents=True)
        (package / room / "__init__.py").write_text("")
    (package / "__init__.py").write_text("")
    shutil.copytree(
        PACKAGE / "maths" / "kernels",
        package / "maths" / "kernels",
        ignore=shutil.ignore_patterns("__pycache__"),
    )
    (package / "low" / "factor.py").write_text("FACTOR = 2.0\n")
    (package / "low" / "part.py").write_text(PART)
    (package / "low" / "plain.py").write_text("x = 1\n")
    (package / "high" / "caller.py").write_text(CALLER)
    return package


@pytest.fixture
def called(tmp_path):
    """Return a function that calls the kernel in a process of its own: its value, and whether it
    was compiled."""

    def call(package: Path) -> tuple[float, bool]:
        own = {
            "PYTHONPATH": str(package.parent),
            "NUMBA_CACHE_DIR": str(tmp_path / "kept"),
            "PYTHONDONTWRITEBYTECODE": "1",  # two edits of one size within a second pass for one
        }
        words = [sys.executable, "-P", "-c", RUN]
        run = subprocess.run(words, capture_output=True, text=True, env=os.environ | own)
        assert run.returncode == 0, run.stderr
        value, compiled = run.stdout.split()
        return float(value), compiled == "True"

    return call


def copied(package: Path) -> Path:
    """Return a copy in another place, every file of which was changed at another time."""
    there = package.parents[1] / "two" / "equipoise"
    shutil.copytree(package, there, ignore=shutil.ignore_patterns("__pycache__"))
    for path in there.rglob("*.py"):
        os.utime(path, (1e9, 1e9))
    return there


def test_a_copy_with_other_times_compiles_nothing(package, called):
    assert called(package) == (7.0, True)
    assert called(copied(package)) == (7.0, False)


def test_an_edited_sign_or_constant_below_is_compiled_above(package, called):
    """And what was compiled before the edit is there when it is taken back."""
    part, factor = package / "low" / "part.py", package / "low" / "factor.py"
    assert called(package) == (7.0, True)
    part.write_text(PART.replace("FACTOR * x", "-FACTOR * x"))
    assert called(package) == (-5.0, True)
    factor.write_text("FACTOR = 3.0\n")
    assert called(package) == (-8.0, True)
    part.write_text(PART)
    factor.write_text("FACTOR = 2.0\n")
    assert called(package) == (7.0, False)


@pytest.fixture
def fresh():
    """Sources are read once a process: here they change in between."""

    def forget():
        for function in (kernel_cache.content, kernel_cache.imported, kernel_cache.stamp):
            function.cache_clear()

    forget()
    yield forget
    forget()


def test_a_stamp_depends_on_what_is_imported_and_on_nothing_else(package, fresh):
    caller = package / "high" / "caller.py"
    before = stamp(caller, package)
    (package / "low" / "plain.py").write_text("x = 2\n")
    fresh()
    assert stamp(caller, package) == before
    (package / "low" / "factor.py").write_text("FACTOR = 2.5\n")
    fresh()
    assert stamp(caller, package) != before


@pytest.mark.parametrize(
    "line",
    [
        "from equipoise.low.part import twice",
        "from equipoise.low import part",
        "from equipoise.low import (\n    factor,\n    part as p,\n)",
        "import equipoise.low.part",
        "import equipoise.low.part as p",
        "def f():\n    from equipoise.low.part import twice",
    ],
)
def test_every_way_to_import_is_followed(package, line, fresh):
    source = package / "high" / "other.py"
    source.write_text(f"{line}\n")
    assert package / "low" / "part.py" in imported(source, package)


def test_no_module_imports_by_a_relative_name():
    """Those would not be followed."""
    relative = [path for path in PACKAGE.rglob("*.py") if b"\nfrom ." in path.read_bytes()]
    assert relative == []


def test_kernels_that_nobody_used_for_a_month_are_forgotten(tmp_path, monkeypatch):
    monkeypatch.setattr(kernel_cache.config, "CACHE_DIR", str(tmp_path))
    source = PACKAGE / "maths" / "turns.py"
    place = folder_of(source).parent
    for name, days in (("old", 31), ("recent", 29)):
        (place / name).mkdir()
        for file in ("kernel.nbc", "used"):
            (place / name / file).touch()
        last = (folder_of(source) / "used").stat().st_mtime - 86400 * days
        os.utime(place / name / "used", (last, last))
    shutil.rmtree(folder_of(source))
    folder_of(source)
    assert {path.name for path in place.iterdir()} == {"recent", folder_of(source).name}


def test_a_place_that_cannot_be_written_is_passed_over(tmp_path, monkeypatch):
    """A file stands where the folder would be: refused to everyone, root too."""
    (tmp_path / "file").touch()
    monkeypatch.setattr(kernel_cache.config, "CACHE_DIR", str(tmp_path / "file"))
    found = folder_of(PACKAGE / "maths" / "turns.py")
    assert found.is_relative_to(PACKAGE)
    shutil.rmtree(found)


def test_another_package_keeps_its_kernels_where_it_likes(tmp_path):
    assert folder_of(tmp_path / "theirs.py") is None


OF_A_FAMILY = pytest.mark.skipif(
    platform.machine() != "x86_64", reason="the only family with ready kernels"
)


@pytest.fixture
def brought(package, called, tmp_path, monkeypatch):
    """Return a function that compiles for a processor and has a wheel bring that along."""

    def bring(processor: str) -> None:
        monkeypatch.setenv("NUMBA_CPU_NAME", processor)
        monkeypatch.setenv("NUMBA_CPU_FEATURES", "")
        assert called(package) == (7.0, True)
        for name in ("NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES"):
            monkeypatch.delenv(name)
        ready = package / "maths" / "kernels" / "ready"
        (tmp_path / "kept" / "equipoise-kernels").rename(ready)

    return bring


@OF_A_FAMILY
def test_kernels_of_the_processors_family_are_taken_over(package, called, brought):
    brought("x86-64-v3")
    assert called(package) == (7.0, False)
    assert called(copied(package)) == (7.0, False)


@OF_A_FAMILY
def test_kernels_of_an_unknown_family_are_not(package, called, brought):
    brought("x86-64-v4")  # which the machine may well be; nobody has said what it has to have
    assert called(package) == (7.0, True)


@OF_A_FAMILY
def test_ready_kernels_of_other_sources_are_left_alone(package, called, brought):
    brought("x86-64-v3")
    (package / "low" / "factor.py").write_text("FACTOR = 3.0\n")
    assert called(package) == (10.0, True)
