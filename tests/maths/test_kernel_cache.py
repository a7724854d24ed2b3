"""Compiled kernels never outlive the sources that they were made from."""

import os

import pytest

from equipoise.maths.kernel_cache import MARK, PACKAGE, drop_stale, fingerprint

IMPORT = "from equipoise.maths.compiled import kernel\n"


@pytest.fixture
def package(tmp_path):
    """A package of two rooms with a compiled kernel in each."""
    for room in ("low", "high"):
        cache = tmp_path / room / "__pycache__"
        cache.mkdir(parents=True)
        (tmp_path / room / "kernel.py").write_text(f"{IMPORT}x = 1\n")
        (tmp_path / room / "plain.py").write_text("y = 1\n")
        (cache / "kernel.nbi").write_text("index")
        (cache / "kernel.1.nbc").write_text("code")
        (cache / "kernel.cpython-311.pyc").write_text("python's own")
    return tmp_path


@pytest.fixture
def stamp(package):
    return package / "low" / "__pycache__" / "kernels.stamp"


def compiled(package):
    return sorted(path.name for path in package.rglob("*.nb?"))


def compile_again(package):
    (package / "high" / "__pycache__" / "kernel.nbi").write_text("index")


def test_unknown_kernels_go_and_python_keeps_its_own(package, stamp):
    """Without a stamp nobody knows what the kernels were made from."""
    assert drop_stale(package, stamp)
    assert compiled(package) == []
    assert len(list(package.rglob("*.pyc"))) == 2


def test_fresh_kernels_stay(package, stamp):
    """With the sources untouched, what was compiled since is kept."""
    drop_stale(package, stamp)
    compile_again(package)
    assert not drop_stale(package, stamp)
    assert compiled(package) == ["kernel.nbi"]


def edit(source):
    source.write_text(f"{IMPORT}x = -1\n")


def touch(source):
    later = source.stat().st_mtime_ns + 1_000_000
    os.utime(source, ns=(later, later))


def rename(source):
    source.rename(source.with_name("other.py"))


def add(source):
    source.with_name("new.py").write_text(IMPORT)


def remove(source):
    source.unlink()


@pytest.mark.parametrize("change", [edit, touch, rename, add, remove])
def test_any_change_below_drops_the_kernels_above(package, stamp, change):
    """A part is merged into callers in other files, so a change anywhere drops them all."""
    drop_stale(package, stamp)
    compile_again(package)
    change(package / "low" / "kernel.py")
    assert drop_stale(package, stamp)
    assert compiled(package) == []


def test_sources_without_kernels_may_change(package, stamp):
    """An edited command or table costs nobody a compilation."""
    drop_stale(package, stamp)
    compile_again(package)
    (package / "low" / "plain.py").write_text("y = 2\n")
    assert not drop_stale(package, stamp)
    assert compiled(package) == ["kernel.nbi"]


def test_every_source_with_a_kernel_is_marked():
    """What is not marked could live on in a kernel after it changed."""
    sources = list(PACKAGE.rglob("*.py"))
    compiling = [
        s for s in sources if b"\n@kernel" in s.read_bytes() or b"\n@part" in s.read_bytes()
    ]
    assert len(compiling) > 10
    assert all(MARK in source.read_bytes() for source in compiling)


def test_fingerprint_does_not_depend_on_where_the_package_lies(package):
    """Moved as a whole, with its times, it is the same package."""
    before = fingerprint(package)
    there = package.with_name("moved")
    package.rename(there)
    assert fingerprint(there) == before


def test_missing_cache_folder_is_made(package, tmp_path):
    """First start after installation: the stamp's folder need not exist yet."""
    stamp = tmp_path / "new" / "kernels.stamp"
    assert drop_stale(package, stamp)
    assert not drop_stale(package, stamp)
