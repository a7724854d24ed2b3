"""The experiment's socket: words, answers, floods, and bytes of any kind."""

import contextlib
import socket

import pytest

from equipoise.hardware.transport.experiment_port import AT_ONCE, ExperimentPort
from equipoise.model.errors import InputError

HOST = "127.0.0.1"


@contextlib.contextmanager
def experiment():
    with ExperimentPort(HOST, 0) as port, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as own:
        own.settimeout(5.0)
        own.connect(port.address)

        def says(data):
            own.send(data)
            state = port()
            return state, own.recv(200).decode()

        yield port, own, says


def test_each_word_holds_until_the_next_and_is_answered():
    with experiment() as (port, _, says):
        assert port() == "free"
        assert says(b"hold\n") == ("hold", "ok hold")
        assert port() == "hold"
        assert says(b" FREE ") == ("free", "ok free")
        assert says(b"state") == ("free", "ok free")
        assert says(b"done") == ("done", "ok done")


@pytest.mark.parametrize("data", [b"stop", b"", b"\xff\x00\xfe", b"h" * 500, b"hold free"])
def test_what_is_no_word_changes_nothing_and_is_refused(data):
    with experiment() as (_, _, says):
        says(b"hold")
        state, answer = says(data)
        assert state == "hold"
        assert answer.startswith("error: found ")
        assert answer.endswith("; wanted free, hold, done, state")
        assert len(answer) < 400


def test_a_flood_delays_no_bench():
    """So many are read between two measurements; the rest waits, and the last word counts then."""
    with experiment() as (port, own, _):
        for _ in range(AT_ONCE):
            own.send(b"hold")
        own.send(b"free")
        assert port() == "hold"
        assert port() == "free"


def test_who_leaves_before_the_answer_ends_nothing():
    with ExperimentPort(HOST, 0) as port:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as own:
            own.sendto(b"hold", port.address)
        assert port() == "hold"
        assert port() == "hold"


def test_a_port_in_use_is_named():
    with ExperimentPort(HOST, 0) as port:
        with pytest.raises(InputError) as refused:
            ExperimentPort(*port.address)
        assert f"experiment port {HOST}:{port.address[1]}" in str(refused.value)
