"""A keeper that fails tells its commander what it was, and halts; nothing of it is a traceback."""

import threading
from multiprocessing import Pipe

import pytest

from equipoise.hardware.bench import controller_process
from equipoise.hardware.bench.bench_controller import BenchState
from equipoise.hardware.bench.controller_process import run_keeper
from equipoise.model.errors import InputError, UnforeseenError

REFUSED = InputError("tcp:here:1", "no lock of its port", "a folder with space in it")


class Clock:
    """A clock of a bench."""

    begun_ns, now = 5, 0.0

    def wait(self):
        """Time does not pass."""


class Failing:
    """What is kept, and fails at its first turn."""

    def __init__(self, error):
        self.keeper, self.clock, self.closed = self, Clock(), False
        self.state, self._error = BenchState(), error

    def turn(self, _t):
        """Fail."""
        raise self._error

    def close(self):
        """Note that the masses were halted."""
        self.closed = True


def messages_of(monkeypatch, make):
    """What a keeper's life puts into the pipe."""
    monkeypatch.setattr(controller_process, "leave_to_commander", lambda: None)
    ours, theirs = Pipe()
    life = threading.Thread(target=run_keeper, args=(theirs, make, None))
    life.start()
    life.join()
    theirs.close()
    found = []
    while True:
        try:
            found.append(ours.recv())
        except EOFError:
            return found


@pytest.mark.parametrize(
    ("error", "kind", "said"),
    [
        (REFUSED, InputError, "no lock of its port"),
        (TypeError("no"), UnforeseenError, "the keeper of the bench: TypeError: no"),
    ],
)
def test_what_it_cannot_begin_with_is_its_answer(monkeypatch, error, kind, said):
    def make(_what):
        raise error

    ((name, (number, answer)),) = messages_of(monkeypatch, make)
    assert (name, number, type(answer)) == ("answer", 0, kind)
    assert said in str(answer)


def test_what_ends_it_reaches_its_commander_and_the_masses_are_halted(monkeypatch):
    kept = Failing(TypeError("no"))
    begun, (name, error) = messages_of(monkeypatch, lambda _what: kept)
    assert begun == ("answer", (0, 5))
    assert (name, type(error)) == ("end", UnforeseenError)
    assert kept.closed
    assert "in turn" in "".join(error.__notes__)
