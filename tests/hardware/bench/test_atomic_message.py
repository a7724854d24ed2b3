"""A message is whole before a signal to stop takes effect, and the signal is not forgotten."""

import signal
import sys
import threading

import pytest

from equipoise.hardware.bench.atomic_message import whole_message
from equipoise.hardware.bench.stop_signals import STOPPING, put_back


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


@pytest.mark.parametrize("number", STOPPING)
def test_it_does_what_it_did_before(number):
    """Whoever had taken the signal over has it again, and receives it once."""
    reported = []
    before = signal.signal(number, lambda *_: reported.append("received"))
    try:
        with whole_message():
            signal.raise_signal(number)
            assert reported == []
        assert reported == ["received"]
        signal.raise_signal(number)
        assert reported == ["received"] * 2
    finally:
        signal.signal(number, before)


@pytest.mark.parametrize("number", STOPPING)
def test_what_is_ignored_stays_ignored(number):
    """As in a keeper's process, and under nohup."""
    before = signal.signal(number, signal.SIG_IGN)
    try:
        with whole_message():
            signal.raise_signal(number)
        assert signal.getsignal(number) is signal.SIG_IGN
    finally:
        signal.signal(number, before)


class Interruption:
    """Ctrl-C at one line of a function: the ``moment``-th that runs after Ctrl-C works again."""

    def __init__(self, function, moment):
        self.code, self.moments_left = function.__code__, moment

    def __call__(self, frame, event, _):
        if frame.f_code is not self.code:
            return None
        if event == "line" and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            self.moments_left -= 1
            if self.moments_left == 0:
                signal.raise_signal(signal.SIGINT)
        return self


@pytest.mark.parametrize("moment", range(1, 1 + 2 * len(STOPPING)))
def test_a_signal_while_handlers_are_put_back_leaves_none_behind(moment):
    """Ctrl-C works again already while SIGTERM is still held back."""
    before = [signal.getsignal(number) for number in STOPPING]
    tracer = sys.gettrace()
    try:
        with pytest.raises(KeyboardInterrupt), whole_message():
            sys.settrace(Interruption(put_back, moment))
    finally:
        sys.settrace(tracer)
    assert [signal.getsignal(number) for number in STOPPING] == before


def test_an_error_of_the_block_comes_out_and_the_handlers_are_back():
    before = [signal.getsignal(number) for number in STOPPING]
    with pytest.raises(ValueError, match="broken"), whole_message():
        raise ValueError("broken")
    assert [signal.getsignal(number) for number in STOPPING] == before


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
