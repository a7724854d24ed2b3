"""Lines out of a stream of bytes, however it is cut."""

import pytest

from equipoise.hardware.transport.line_splitter import LONGEST, Lines


@pytest.mark.parametrize("size", [1, 2, 3, 100])
def test_lines_come_out_whole_however_the_stream_is_cut(size):
    stream, lines = b"one\r\ntwo\n\nthree\rhalf", Lines()
    parts = [stream[k : k + size] for k in range(0, len(stream), size)]
    assert [line for part in parts for line in lines.cut(part)] == [b"one", b"two", b"three"]
    assert lines.cut(b" a line\n") == [b"half a line"]


def test_a_line_that_never_ends_is_dropped_and_counted():
    lines = Lines()
    assert lines.cut(b"x" * LONGEST) == []
    assert lines.dropped == 0
    assert lines.cut(b"x") == []
    assert lines.dropped == 1
    assert lines.cut(b"next\n") == [b"next"]
