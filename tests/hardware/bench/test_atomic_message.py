"""A message is whole before Ctrl-C takes effect, and Ctrl-C is not forgotten."""

import signal
import threading

import pytest

from equipoise.hardware.bench.atomic_message import whole_message


def interrupted(done):
    with whole_message():
        signal.raise_signal(signal.SIGINT)
        done.append("all of it")
    done.append("more")


def test_the_block_ends_first():
    done = []
    with pytest.raises(KeyboardInterrupt):
        interrupted(done)
    assert done == ["all of it"]


def test_it_does_what_it_did_before():
    """Whoever had taken Ctrl-C over has it again, and receives it once."""
    reported = []
    before = signal.signal(signal.SIGINT, lambda *_: reported.append("received"))
    try:
        with whole_message():
            signal.raise_signal(signal.SIGINT)
            assert reported == []
        assert reported == ["received"]
        signal.raise_signal(signal.SIGINT)
        assert reported == ["received"] * 2
    finally:
        signal.signal(signal.SIGINT, before)


def test_an_error_of_the_block_comes_out_and_the_handler_is_back():
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(ValueError, match="broken"), whole_message():
        raise ValueError("broken")
    assert signal.getsignal(signal.SIGINT) is before


def test_other_threads_are_let_alone():
    """Python delivers a signal to the main thread only."""
    done = []

    def work():
        with whole_message():
            done.append("done")

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert done == ["done"]
