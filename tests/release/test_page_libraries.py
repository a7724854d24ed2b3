"""A wheel holds the scripts of the dashboard's page, or is not built."""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
STATIC = "equipoise/app/dashboard/static"
SOURCE = ("pyproject.toml", "hatch_build.py", "README.md", "LICENSE")


@pytest.fixture
def source(tmp_path):
    """Return a source folder with what a build reads, and a package of one module."""
    folder = tmp_path / "source"
    (folder / "src" / STATIC).mkdir(parents=True)
    (folder / "src/equipoise/__init__.py").write_text('"""Nothing."""\n', encoding="utf-8")
    for name in SOURCE:
        shutil.copy(ROOT / name, folder / name)
    (folder / "web").mkdir()
    for path in (ROOT / "web").glob("*.*"):
        shutil.copy(path, folder / "web" / path.name)
    return folder


def build(source: Path) -> subprocess.CompletedProcess[str]:
    """Build a wheel where npm reaches no registry and has nothing in store."""
    away = {"npm_config_offline": "true", "npm_config_cache": str(source / "cache")}
    words = [sys.executable, "-m", "hatchling", "build", "--target", "wheel"]
    return subprocess.run(
        words, cwd=source, env=os.environ | away, capture_output=True, text=True, check=False
    )


def page_libraries(source: Path) -> tuple[str, ...]:
    code = "import page_libraries; print(*page_libraries.FILES.values())"
    words = [sys.executable, "-c", code]
    done = subprocess.run(words, cwd=source / "web", capture_output=True, text=True, check=True)
    return tuple(done.stdout.split())


def test_a_wheel_without_the_pages_scripts_is_not_built(source):
    done = build(source)
    assert done.returncode != 0
    assert "NoPageLibraries: npm" in done.stderr
    assert not list(source.glob("dist/*.whl"))


def test_a_wheel_holds_the_pages_scripts(source):
    vendor = source / "src" / STATIC / "vendor"
    vendor.mkdir()
    names = page_libraries(source)
    for name in names:
        (vendor / name).write_text(name, encoding="utf-8")
    done = build(source)
    assert done.returncode == 0, done.stderr
    (wheel,) = source.glob("dist/*.whl")
    with zipfile.ZipFile(wheel) as archive:
        assert {f"{STATIC}/vendor/{name}" for name in names} <= set(archive.namelist())


def test_one_script_that_lacks_is_enough_to_fail(source):
    vendor = source / "src" / STATIC / "vendor"
    vendor.mkdir()
    for name in page_libraries(source)[1:]:
        (vendor / name).write_text(name, encoding="utf-8")
    assert build(source).returncode != 0
