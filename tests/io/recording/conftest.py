"""A motion whose truth is known, and the command line."""

import pytest

from equipoise.app.cli import run
from tests.support.recordings.judged import Printed
from tests.support.recordings.recorded_motion import turning


@pytest.fixture(scope="session")
def motion():
    return turning()


@pytest.fixture
def equipoise(capsys, monkeypatch, tmp_path):
    """Return a function that runs a command line in an empty folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("EQUIPOISE_RUNS", "")

    def call(*words: object) -> Printed:
        capsys.readouterr()
        code = run([str(word) for word in words])
        left = capsys.readouterr()
        return Printed(code, left.out, left.err)

    return call
