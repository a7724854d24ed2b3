"""Each library of each extra, missing: whatever needs it names the line to type."""

import os
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

import pytest
from packaging.requirements import Requirement

from equipoise.model.errors import InputError
from equipoise.model.optional_libraries import extra_library
from tests.support import thorough
from tests.support.files_of_extras import write_files

PATIENCE = 120.0  # s, chosen: for a command that goes on for ever instead
ROOT = Path(__file__).parents[3]
# Python runs a module of this name first, in the processes that a command starts too.
MISSING = """
import importlib.metadata as metadata
import os, sys
library, package = os.environ["MISSING_LIBRARY"], os.environ["MISSING_PACKAGE"]
sys.modules[library] = None  # as if it were not installed
stated = metadata.version
def version(name):
    if name == package:
        raise metadata.PackageNotFoundError(name)
    return stated(name)
metadata.version = version
"""
WITH_NICEGUI = ("uvicorn", "starlette", "fastapi", "jinja2")
# Modules that differ in name from what is installed.
MODULES = {
    "foxglove-sdk": "foxglove",
    "opencv-python-headless": "cv2",
    "ruamel-yaml": "ruamel",
}
# Their libraries serve scripts and notebooks (tests/app/api), benchmarks, or are other extras.
NO_COMMAND = {"analysis", "notebook", "peers", "all"}


@dataclass(frozen=True, slots=True)
class Need:
    """A command that needs a library of an extra; ``library`` as it is imported."""

    extra: str
    library: str
    words: tuple[str, ...]

    def __str__(self) -> str:
        return f"{self.library}: {' '.join(self.words)}"


def needs(extra: str, library: str, *lines: str) -> list[Need]:
    return [Need(extra, library, tuple(line.split())) for line in lines]


EQUIPOISE = (sys.executable, "-m", "equipoise")
ASSESS = ("assess", "swing.csv", "--testbed", "nanosat")
COMPARE = "compare reference-table --laws --only pid --runs 1"
PAGE = "dashboard nanosat --port 0"
TRACK = "track pictures --out track.csv --testbed sputnix"
NEEDS = [
    *needs("dashboard", "nicegui", PAGE, "dashboard swing.csv --testbed nanosat --port 0"),
    *(each for name in WITH_NICEGUI for each in needs("dashboard", name, PAGE)),
    *needs("report", "typst", "report run --png"),
    *needs("parquet", "pyarrow", "inspect swing.parquet", "convert swing.csv again.parquet"),
    *needs("parquet", "pyarrow", "simulate nanosat --duration-s 1 --out again.parquet"),
    *needs("parquet", "pyarrow", f"{COMPARE} --resume kept", "logbook runs --export runs.parquet"),
    *needs("excel", "openpyxl", "inspect swing.xlsx", "import swing.xlsx"),
    *needs("excel", "openpyxl", "convert swing.xlsx again.csv"),
    *needs("matlab", "h5py", "inspect swing.mat"),
    *needs("hardware", "serialx", "devices", "check serial.toml"),
    *needs("hardware", "serialx", "record serial.toml --out run.mcap --duration-s 1"),
    *needs("hardware", "serialx", "balance serial.toml --bench"),
    *needs("hardware", "serialx", "dashboard serial.toml --bench --port 0"),
    *needs("hardware", "websockets", "check socket.toml", "emulate socket.toml --out run.toml"),
    *needs("mavlink", "pymavlink", "inspect flight.tlog", "check vehicle.toml"),
    *needs("mavlink", "pymavlink", "emulate vehicle.toml --out run.toml"),
    *needs("mavlink", "pymavlink", "convert flight.tlog again.csv --as mavlink"),
    *needs("camera", "cv2", TRACK, "print-board --out board.pdf", "check camera.toml"),
    *needs("camera", "cv2", "calibrate-camera pictures --out lens.toml"),
    *needs("camera", "cv2", "emulate camera.toml --out run.toml"),
    *needs("logs", "rosbags", "inspect one.bag", "inspect two"),
    *needs("logs", "ruamel", "inspect two"),
    *needs("logs", "lz4", "inspect one.bag"),
    *needs("logs", "mcap", "inspect swing.mcap", "repair swing.mcap --out again.mcap"),
    *needs("logs", "mcap", "convert swing.csv again.mcap"),
    *needs(
        "logs",
        "foxglove",
        "convert swing.csv again.mcap",
        "record vehicle.toml --out run.mcap --foxglove",
    ),
    *needs("logs", "zstandard", "inspect swing.csv.zst", "inspect swing.mcap"),
    *needs("logs", "zstandard", "convert swing.csv again.mcap"),
    *needs("cluster", "distributed", f"{COMPARE} --on dask-local"),
    *needs("cluster", "distributed", f"{COMPARE} --on dask://127.0.0.1:8786"),
    *needs("cluster", "dask", f"{COMPARE} --on dask-local"),
]


FIRST = {need.library: need for need in reversed(NEEDS)}
CASES = NEEDS if thorough.THOROUGH else list(FIRST.values())


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("files")
    write_files(path)
    (path / "runs").mkdir()
    subprocess.run((*EQUIPOISE, *ASSESS, "--out", "run"), cwd=path, capture_output=True, check=True)
    (path / "sitecustomize.py").write_text(MISSING, encoding="utf-8")
    return path


def command(words: tuple[str, ...], folder: Path, missing: str) -> subprocess.CompletedProcess[str]:
    """Run a command where a library is not installed."""
    package = {module: name for name, module in MODULES.items()}.get(missing, missing)
    blocked = {"MISSING_LIBRARY": missing, "MISSING_PACKAGE": package}
    paths = os.pathsep.join((str(folder), *filter(None, sys.path)))
    return subprocess.run(
        (*EQUIPOISE, *words),
        cwd=folder, env=os.environ | {"PYTHONPATH": paths} | blocked,
        capture_output=True, text=True, check=False, timeout=PATIENCE,
    )  # fmt: skip


@pytest.mark.parametrize("need", CASES, ids=str)
def test_a_command_without_its_library_names_the_line_to_type(folder, need):
    done = command(need.words, folder, need.library)
    assert "Traceback" not in done.stderr
    assert f'pip install "equipoise[{need.extra}]"' in done.stderr
    assert need.library.partition(".")[0] in done.stderr
    assert done.returncode == 2, done.stderr


def test_every_library_of_every_extra_is_tried():
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    extras = tomllib.loads(text)["project"]["optional-dependencies"]
    named = {
        (extra, MODULES.get(Requirement(line).name, Requirement(line).name))
        for extra, lines in extras.items()
        if extra not in NO_COMMAND
        for line in lines
    }
    tried = {(need.extra, need.library) for need in NEEDS}
    assert named <= tried
    assert {extra for extra, _ in tried} <= set(extras)


@pytest.mark.parametrize("words", [(*ASSESS, "--out", "without"), ("report", "run")])
def test_a_report_without_typst_is_written_and_says_why_it_is_no_pdf(folder, words):
    done = command(words, folder, "typst")
    assert done.returncode in (0, 1), done.stderr
    assert 'no PDF was written, typst is not installed: `pip install "equipoise' in done.stderr
    assert "report.html" in done.stdout
    assert "report.pdf" not in done.stdout


def test_a_library_that_its_library_needs_is_named(tmp_path, monkeypatch):
    (tmp_path / "needs_another.py").write_text("import another.inside", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(InputError, match="found a log, but another, which needs_another needs,"):
        extra_library("needs_another", "run.log", "a log", "logs")


def test_a_library_that_is_there_and_broken_is_not_called_missing(tmp_path, monkeypatch):
    (tmp_path / "broken_one.py").write_text("raise ImportError('no libssl.so.3')", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(InputError, match=r"broken_one cannot be imported \(no libssl\.so\.3\)"):
        extra_library("broken_one", "run.log", "a log", "logs", ", or unpack it")
