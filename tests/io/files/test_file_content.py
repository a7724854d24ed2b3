"""A file through a window gives the bytes that are in it, wherever the blocks end."""

import hashlib

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equipoise.io.files import file_content
from equipoise.io.files.file_content import Content, opened
from equipoise.io.files.reading_budget import ReadingBudget
from equipoise.model.errors import InputError

BYTES = st.binary(max_size=60) | st.text("ab", max_size=60).map(str.encode)


@pytest.fixture(scope="module", autouse=True)
def short_blocks():
    """Let the window be seven bytes wide."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(file_content, "BLOCK", 7)
        yield


@settings(deadline=None)
@given(BYTES, st.lists(st.tuples(st.integers(-70, 70), st.integers(-70, 70)), max_size=6))
def test_slices_are_those_of_the_bytes(data, places):
    content = Content.of(data, "a")
    for start, stop in places:
        assert content[start:stop] == data[start:stop]
    assert len(content) == len(data)
    assert content.whole() == data
    assert b"".join(content.blocks()) == data
    assert content.sha256() == hashlib.sha256(data).hexdigest()


@settings(deadline=None)
@given(BYTES, BYTES.map(lambda data: data[:9]), st.integers(0, 70))
def test_what_is_sought_is_found_where_it_is(data, mark, at):
    content = Content.of(data, "a")
    if mark:
        assert content.find(mark, at) == data.find(mark, at)
    assert content.startswith(mark, min(at, len(data))) == data.startswith(mark, min(at, len(data)))
    assert content.endswith(mark) == data.endswith(mark)


def test_what_is_sought_is_found_across_the_end_of_a_block():
    """The window's seven bytes end amid it."""
    assert Content.of(b"aaaaaa" + b"bb" + b"aaaaaaaa", "a").find(b"bb") == 6


def test_a_byte_beyond_the_end_is_none():
    content = Content.of(b"abc", "a")
    assert content[2] == ord("c")
    with pytest.raises(IndexError):
        content[3]


def test_the_limits_are_stated():
    """64 times the file, at least 256 MB and at most 2 GB; or what a person states, exactly."""
    for size, budget, limit in (
        (10, ReadingBudget(), 256_000_000),
        (10_000_000, ReadingBudget(), 640_000_000),
        (10**9, ReadingBudget(), 2_000_000_000),
        (10, ReadingBudget(5000), 5000),
    ):
        meter = budget.of("a", size)
        meter.take(limit - 1)
        meter.take(1)
        with pytest.raises(InputError, match="once it is read"):
            meter.check(1)


def test_the_time_is_limited(monkeypatch):
    """A file of 2 MB has 30 s, and three times as long where three times the memory is stated."""
    clock = [0.0]
    monkeypatch.setattr("equipoise.io.files.reading_budget.time.monotonic", lambda: clock[0])
    for budget, seconds in ((ReadingBudget(), 30.0), (ReadingBudget(3 * 256_000_000), 90.0)):
        clock[0] = 0.0
        meter = budget.of("a", 2_000_000)
        clock[0] = seconds
        meter.check(0)
        clock[0] = seconds + 0.1
        with pytest.raises(InputError, match=f"not read within {seconds:.0f} s"):
            meter.check(0)


def test_an_empty_file_is_named(tmp_path):
    (tmp_path / "a.csv").write_bytes(b" ")
    with pytest.raises(InputError, match="an empty file"), opened(tmp_path / "a.csv", "a table"):
        pass
