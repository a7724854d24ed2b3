"""The door of the readers: nothing undeclared passes, and what it was is kept for a crash file."""

import pytest

from equipoise.io.logs import log_table
from equipoise.io.recording import format_registry
from equipoise.io.recording.recording_file import read_recording, read_table
from equipoise.model.errors import InputError, UnforeseenError
from tests.support.file_fuzz_targets import TARGETS

READERS = (read_recording, read_table)
OF_LOGS = ("log of", "bag of", "ULog", "MCAP")
LOGS = [target for target in TARGETS if target.name.startswith(OF_LOGS)]


@pytest.fixture
def failing(tmp_path, monkeypatch):
    """Return a function that lets a format fail, and the path of a file."""
    path = tmp_path / "run.csv"
    path.write_text("time_s,omega_x_rad_s\n0,1\n", encoding="utf-8")

    def fail(error):
        def cut(*_words):
            raise error

        monkeypatch.setattr(format_registry, "_format", cut)
        return path

    return fail


@pytest.mark.parametrize("read", READERS, ids=lambda each: each.__name__)
@pytest.mark.parametrize("error", [TypeError("no"), OverflowError("no"), RecursionError("no")])
def test_what_nobody_foresaw_is_named_as_such(failing, read, error):
    path = failing(error)
    with pytest.raises(UnforeseenError, match=rf"run\.csv: {type(error).__name__}: no") as found:
        read(path)
    assert found.value.__cause__ is error


@pytest.mark.parametrize("read", READERS, ids=lambda each: each.__name__)
def test_memory_at_its_end_and_a_disk_that_fails_are_declared(failing, read):
    with pytest.raises(InputError, match="more than this computer's memory holds"):
        read(failing(MemoryError()))
    with pytest.raises(InputError, match="Input/output error; wanted a recording"):
        read(failing(OSError(5, "Input/output error")))


@pytest.mark.parametrize("stop", [KeyboardInterrupt, SystemExit])
def test_a_person_who_stops_is_not_caught(failing, stop):
    with pytest.raises(stop):
        read_recording(failing(stop()))


@pytest.mark.parametrize("target", LOGS, ids=lambda each: each.name)
def test_a_fault_of_ours_in_a_log_is_not_called_a_broken_log(monkeypatch, target):
    def cut(*_words):
        raise TypeError("ours")

    monkeypatch.setattr(log_table, "seconds", cut)
    with pytest.raises(UnforeseenError, match="TypeError: ours"):
        target.take(target.valid())


def test_logs_of_every_kind_are_tried():
    assert len(LOGS) == 7
