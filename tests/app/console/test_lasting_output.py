"""Output to a terminal that is gone goes nowhere; all other output is as it was."""

import errno
import io
import os

import pytest

from equipoise.app.console.lasting_output import lasting

pty = pytest.importorskip("pty", reason="no pseudo terminals, no SIGHUP")


def at_terminal():
    """Return our end of a pseudo terminal, and a stream to it."""
    ours, theirs = pty.openpty()
    return ours, os.fdopen(theirs, "w", encoding="utf-8", errors="replace")


def test_a_terminal_gets_what_is_written():
    ours, stream = at_terminal()
    with stream:
        found = lasting(stream)
        print("masses \u00b1 1", file=found)
        assert os.read(ours, 100) == "masses \u00b1 1\r\n".encode()
        assert (found.encoding, found.errors, found.isatty()) == ("utf-8", "replace", True)
    os.close(ours)


def test_what_is_written_after_the_end_of_a_terminal_goes_nowhere():
    ours, stream = at_terminal()
    with stream:
        found = lasting(stream)
        os.close(ours)
        with pytest.raises(OSError, match="Input/output error") as failed:
            os.write(stream.fileno(), b"x")
        assert failed.value.errno == errno.EIO
        print("more than a buffer takes: " + "x" * 100_000, file=found, flush=True)
        found.close()


def test_a_stream_to_no_terminal_is_the_same_one(tmp_path):
    with (tmp_path / "out.txt").open("w") as stream:
        assert lasting(stream) is stream
    text = io.StringIO()
    assert lasting(text) is text
