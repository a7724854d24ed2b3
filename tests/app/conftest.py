"""A platform, a record of it and the command line, for every test of the app."""

import json
from dataclasses import dataclass
from pathlib import Path

import pytest

from equipoise.app.cli import run
from tests.support.schema_check import faults
from tests.support.write_schemas import FOLDER, file_of

KNOWN_MOVE = "60: x1=-10 y1=-10 z1=-50"


@dataclass(frozen=True)
class Outcome:
    code: int
    out: str
    err: str


@pytest.fixture(autouse=True, scope="session")
def crash_folder(tmp_path_factory):
    """Keep crash files of programs under test out of the folder of the person who tests."""
    with pytest.MonkeyPatch.context() as patch:
        state = tmp_path_factory.mktemp("state")
        patch.setenv("XDG_STATE_HOME", str(state))
        yield state / "equipoise" / "crashes"


@pytest.fixture
def equipoise(capsys, monkeypatch, tmp_path):
    """Return a function that runs a command line in an empty folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("EQUIPOISE_RUNS", "")  # to keep every run takes long; some tests want it

    def call(*words: object) -> Outcome:
        capsys.readouterr()
        code = run([str(word) for word in words])
        observed = capsys.readouterr()
        return Outcome(code, observed.out, observed.err)

    return call


@pytest.fixture(scope="session")
def record_file(tmp_path_factory) -> Path:
    """Return a record of the preset with a known move, as CSV."""
    path = tmp_path_factory.mktemp("record") / "run.csv"
    assert run(["simulate", "sputnix", "--out", str(path), "--move", KNOWN_MOVE]) == 0
    return path


@pytest.fixture(scope="session")
def free_file(tmp_path_factory) -> Path:
    """Return a record of the preset in which no mass moves, as CSV."""
    path = tmp_path_factory.mktemp("free") / "free.csv"
    assert run(["simulate", "sputnix", "--out", str(path)]) == 0
    return path


@pytest.fixture(scope="session")
def strict_json():
    """Return a reader of JSON that refuses NaN, infinity and what the shipped schema refuses."""

    def refuse(word: str) -> None:
        raise ValueError(word)

    def read(text: str) -> dict:
        document = json.loads(text, parse_constant=refuse)
        schema = json.loads((FOLDER / file_of(document["schema"])).read_text(encoding="utf-8"))
        assert not list(faults(document, schema))
        return document

    return read
