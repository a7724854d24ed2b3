"""Ctrl-C, SIGTERM and SIGHUP are one request, made where it can be carried out, and never lost."""

import signal
import threading
import time
from contextlib import contextmanager

import pytest

from equipoise.app import cli
from equipoise.app.console import stop_request
from equipoise.app.console.stop_request import Stopped, cause_of, exit_code_of, stoppable
from equipoise.hardware.bench.stop_signals import HANG_UP, STOPPING

SOON = 10.0  # s, much longer than a request waits
EXIT_CODES = {"SIGINT": 130, "SIGTERM": 143, "SIGHUP": 129}  # 128 and the number, as shells have it
CAUSES = {"SIGINT": "hand", "SIGTERM": "SIGTERM", "SIGHUP": "SIGHUP"}
needs_hang_up = pytest.mark.skipif(HANG_UP is None, reason="no SIGHUP here")


def handlers():
    return [signal.getsignal(number) for number in STOPPING]


@contextmanager
def ignored(number):
    before = signal.signal(number, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(number, before)


@contextmanager
def unrequested():
    """Fail where a request is made: it would end the tests as Ctrl-C does."""
    try:
        yield
    except Stopped:
        pytest.fail("a request was made")


def wait():
    """Wait until a request is made."""
    end = time.monotonic() + SOON
    while time.monotonic() < end:
        time.sleep(1e-3)
    pytest.fail("the request was lost")


@pytest.mark.parametrize("number", STOPPING)
def test_each_signal_requests_a_stop_and_has_its_exit_code(number):
    before = handlers()
    with pytest.raises(KeyboardInterrupt) as found, stoppable():
        signal.raise_signal(number)
    assert exit_code_of(found.value) == EXIT_CODES[number.name]
    assert cause_of(found.value) == CAUSES[number.name]
    assert handlers() == before


def test_a_signal_that_had_to_wait_until_all_was_done_ends_the_program_as_any(monkeypatch, capsys):
    """Its handler was called where nothing may be raised; after that there is nothing to stop."""

    def carried_out(_arguments):
        signal.getsignal(signal.SIGTERM).__self__._pending = signal.SIGTERM
        return 0

    monkeypatch.setattr(cli, "_run", carried_out)
    assert cli.run([]) == EXIT_CODES["SIGTERM"]
    assert "stopped by SIGTERM" in capsys.readouterr().err


def test_a_plain_keyboard_interrupt_counts_as_ctrl_c():
    assert (exit_code_of(KeyboardInterrupt()), cause_of(KeyboardInterrupt())) == (130, "hand")


@needs_hang_up
def test_what_nohup_ignores_stays_ignored():
    with ignored(HANG_UP), stoppable():
        signal.raise_signal(HANG_UP)
        assert signal.getsignal(HANG_UP) is signal.SIG_IGN


def test_a_handler_of_somebody_else_stays():
    received = []
    before = signal.signal(signal.SIGTERM, lambda *_: received.append("received"))
    try:
        with stoppable():
            signal.raise_signal(signal.SIGTERM)
        assert received == ["received"]
    finally:
        signal.signal(signal.SIGTERM, before)


def test_a_block_within_another_is_the_same():
    with stoppable() as outer, stoppable((signal.SIGINT,)) as inner:
        assert inner is outer


def test_outside_the_main_thread_nothing_changes():
    before, found = handlers(), []

    def work():
        with stoppable():
            found.extend(handlers())

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert found == before


def test_what_is_put_off_comes_when_the_block_has_ended():
    done = []
    with pytest.raises(Stopped), stoppable() as requests, requests.put_off():  # noqa: PT012
        signal.raise_signal(signal.SIGTERM)
        time.sleep(3 * stop_request.AGAIN)
        done.append("all of it")
    assert done == ["all of it"]


@pytest.mark.parametrize("module", ["numba.core.compiler", "_frozen_importlib", "weakref"])
def test_where_an_exception_is_lost_it_is_made_soon_afterwards(module):
    """A line of Python that runs as if it were of that module."""
    within = {"__name__": module, "signal": signal, "done": []}
    with pytest.raises(Stopped), stoppable():  # noqa: PT012
        exec("signal.raise_signal(signal.SIGINT)\ndone.append('all of it')", within)
        wait()
    assert within["done"] == ["all of it"]


class Finalised:
    def __del__(self):
        signal.raise_signal(signal.SIGTERM)


def test_it_is_not_lost_in_a_finaliser():
    """Python only prints what is raised there."""
    with pytest.raises(Stopped), stoppable():  # noqa: PT012
        Finalised()
        wait()


def test_it_is_made_in_the_end_wherever_it_is(monkeypatch):
    monkeypatch.setattr(stop_request, "PATIENCE", 0.1)
    within = {"__name__": "numba.core.compiler", "wait": wait, "signal": signal}
    with pytest.raises(Stopped), stoppable():
        exec("signal.raise_signal(signal.SIGINT)\nwait()", within)


def test_a_request_that_waited_is_made_once():
    with stoppable() as requests:
        with pytest.raises(Stopped), requests.put_off():
            signal.raise_signal(signal.SIGINT)
        with unrequested():
            time.sleep(3 * stop_request.AGAIN)


@needs_hang_up
def test_a_terminal_that_says_twice_that_it_is_gone_is_no_second_request():
    """Kernel and shell both say it; another signal, or the same later, is a second request."""
    with stoppable():
        with pytest.raises(Stopped):
            signal.raise_signal(HANG_UP)
        with unrequested():
            signal.raise_signal(HANG_UP)
        with pytest.raises(Stopped):
            signal.raise_signal(signal.SIGTERM)
        with pytest.raises(Stopped):
            signal.raise_signal(signal.SIGTERM)


@needs_hang_up
def test_a_hang_up_long_afterwards_is_a_second_request(monkeypatch):
    monkeypatch.setattr(stop_request, "ECHO", 0.0)
    with stoppable():
        for _ in range(2):
            with pytest.raises(Stopped):
                signal.raise_signal(HANG_UP)
