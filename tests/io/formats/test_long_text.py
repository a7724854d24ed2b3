"""A long text, cut in blocks and by pyarrow where they are plain, is the table of a short one."""

import sys
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equipoise.io.columns.column_map import Layout
from equipoise.io.columns.table import Table
from equipoise.io.files.reading_budget import ReadingBudget
from equipoise.io.formats.csv_table import FIRST_LINES, cut, table_in
from equipoise.io.formats.long_text import LONG, PlainBlocks
from equipoise.io.formats.text_blocks import Text
from equipoise.model.errors import InputError
from tests.support.thorough import count

ROWS = FIRST_LINES + 20
AS_IT_IS = Layout()
# What doubles are written as, and what only looks like one.
NUMBERS = ["0", "-0", "1e-400", "4.9e-324", "1.7976931348623157e308", "+1.5", ".5", "5.", "1E+05"]
WORDS = ["", " ", "nan", "NaN", "-nan", "nan(1)", "inf", "-", "n/a", "1_0", "1e400", "0x10", "1f",
         " 1.5 ", "1 5", "1,5", "OK", "2024-05-03T14:11:40"]  # fmt: skip
ODD_LINES = ["", " ", ",,", ";;", "\t\t", ", ,", "1,2", "1,2,3,4", '"1",2,3', "# 1,2,3", "% 1,2,3",
             "1\x0b,2,3", "1\x85,2,3", "1\u2028,2,3", "\u00b5,2,3", "1\r,2,3", "1,\x00,3",
             "1,2,3,"]  # fmt: skip
PLAIN_LINES = ["1,2,3\r", "12:11:40 -> 1,2,3", ",2,3", ",,3"]
HEADS = ["a,b,c", "a,b,b", "a,,c", "a,b,c,", '"a, s",b,"c"', "# a, b, c", "t,x,y\ns,deg,deg",
         "made by us\n\na,b,c", "", "\u03c9 (\u00b0/s),b,c"]  # fmt: skip

finite = st.floats(allow_nan=False, allow_infinity=False).map(repr)
cell = st.one_of(finite, finite, finite, st.sampled_from(NUMBERS), st.sampled_from(WORDS))


@st.composite
def texts(draw: st.DrawFn, clean: bool) -> str:
    """Return a table of three columns; one that is not clean has lines of any kind in it."""
    separator = draw(st.sampled_from(",;\t"))
    one = finite if clean else cell
    block = draw(st.lists(st.lists(one, min_size=3, max_size=3), min_size=1, max_size=6))
    lines = [separator.join(block[k % len(block)]) for k in range(ROWS)]
    if not clean:
        odd = st.tuples(st.integers(0, ROWS), st.sampled_from(ODD_LINES + PLAIN_LINES))
        for place, line in draw(st.lists(odd, max_size=2)):
            lines.insert(place, line)
    head = "a,b,c" if clean else draw(st.sampled_from(HEADS))
    end = draw(st.sampled_from(["\n", "\r\n"] if clean else ["\n", "\r\n", "\r", "\r\r\n"]))
    last = draw(st.sampled_from(["", end, end + end]))
    return end.join([*head.replace(",", separator).split("\n"), *lines]) + last


layouts = st.builds(
    Layout,
    st.sampled_from([None, ",", ";", "\t"]),
    st.sampled_from([None, ".", ","]),
    st.sampled_from([None, None, 0, 1, ROWS]),
    st.booleans(),
    st.sampled_from([None, True, False]),
)


def in_blocks(text: str, least: int) -> Iterator[str]:
    """Yield a text in blocks of whole lines, each of so many characters at least."""
    begin = 0
    while begin < len(text):
        end = text.find("\n", begin + least) + 1 or len(text)
        yield text[begin:end]
        begin = end


def contents(table: Table) -> dict[str, object]:
    """Return all that a table holds, in a form that can be compared to the last bit."""
    return {
        "head": (table.source, table.names, table.units, table.blank, len(table)),
        "lines": (list(table.lines), table.notes),
        "faulty": [(f.fault, f.rows.tolist(), f.where, f.found, f.wanted) for f in table.faulty],
        "columns": [column(table, name) for name in table.names],
        "cells": [
            table.cell(name, row)
            for name in table.names
            for row in (0, len(table) // 2, len(table) - 1)
        ],
    }


def column(table: Table, name: str) -> object:
    """Return a column's bits, or the sentence why it is none."""
    try:
        numbers = table.numbers(name)
    except InputError as error:
        return str(error)
    return numbers.values.view(np.int64).tolist(), numbers.nan.tolist(), numbers.garbage.tolist()


def result(text: str, layout: Layout) -> object:
    """Return the table that a text is in one block, or the sentence why it is none."""
    try:
        return contents(cut(text, "a.csv", layout))
    except InputError as error:
        return str(error)


def long_result(text: str, layout: Layout, least: int) -> object:
    """Return what a text is in blocks, as one so long that pyarrow cuts those that are plain."""
    made = Text(lambda: in_blocks(text, least), LONG + 1)
    try:
        return contents(table_in(made, "a.csv", layout, ReadingBudget().of("a.csv", LONG)))
    except InputError as error:
        return str(error)


@pytest.fixture
def plain(monkeypatch) -> list[bool]:
    """Return, of each block since, whether pyarrow has cut it."""
    found: list[bool] = []
    columns = PlainBlocks.columns

    def noted(self: PlainBlocks, block: str) -> object:
        made = columns(self, block)
        found.append(made is not None)
        return made

    monkeypatch.setattr(PlainBlocks, "columns", noted)
    return found


@settings(max_examples=count(300, 40), deadline=None)
@given(texts(clean=True), st.integers(0, 3000))
def test_a_plain_text_is_the_same_table(text, least):
    assert long_result(text, AS_IT_IS, least) == result(text, AS_IT_IS)


@settings(max_examples=count(3000, 70), deadline=None)
@given(texts(clean=False), st.one_of(st.just(AS_IT_IS), layouts), st.integers(0, 3000))
def test_any_text_is_the_same_table(text, layout, least):
    assert long_result(text, layout, least) == result(text, layout)


@pytest.mark.parametrize("odd", ODD_LINES)
def test_a_block_with_a_line_that_is_not_plain_is_left_to_the_rules(odd, plain):
    rows = ["a,b,c", *["1,2,3"] * 4 * ROWS]
    text = "\n".join([*rows, odd, *rows[1:]])
    assert long_result(text, AS_IT_IS, 6 * ROWS) == result(text, AS_IT_IS)
    assert plain.count(False) == 1
    assert plain.count(True) >= 4


@pytest.mark.parametrize("word", WORDS)
def test_a_cell_that_is_no_number_is_read_by_the_rules(word, plain):
    shown = f'"{word}"' if "," in word else word
    text = "\n".join(["a,b,c", *["1,2,3"] * ROWS, f"1,{shown},3", "1,2,3"])
    assert long_result(text, AS_IT_IS, 6 * ROWS - 60) == result(text, AS_IT_IS)
    assert plain == ["," not in word]


@pytest.mark.parametrize("line", PLAIN_LINES)
def test_a_line_with_all_its_cells_is_plain(line, plain):
    rows = ["a,b,c", *["1,2,3"] * ROWS]
    text = "\n".join([*rows, line, *rows[1:]])
    assert long_result(text, AS_IT_IS, 6 * ROWS - 60) == result(text, AS_IT_IS)
    assert all(plain)


def test_a_row_in_quotes_goes_on_into_the_next_block():
    rows = ["a,b,c", *["1,2,3"] * ROWS]
    text = "\n".join([*rows, '1,"two', "and", *["more"] * ROWS, 'lines",3', *rows[1:]])
    table = cut(text, "a.csv", AS_IT_IS)
    assert long_result(text, AS_IT_IS, 100) == contents(table)
    assert table.place(ROWS) == f"line {2 * ROWS + 4}"


def test_cells_that_seem_cut_in_two_are_not_joined_where_a_later_row_cannot_be():
    rows = ["a,b", *["1,5,2,25"] * ROWS]
    last = "\n".join([*rows, "1,5,2,25,3", *rows[1:]])
    joined = cut("\n".join(rows), "a.csv", AS_IT_IS)
    assert joined.numbers("a").values.tolist() == [1.5] * ROWS
    assert long_result("\n".join(rows), AS_IT_IS, 100) == contents(joined)
    assert long_result(last, AS_IT_IS, 100) == result(last, AS_IT_IS)
    (fault,) = cut(last, "a.csv", AS_IT_IS).faulty
    assert len(fault.rows) == 2 * ROWS + 1


@pytest.mark.parametrize("least", [1, 50, 10_000])
def test_a_last_row_that_is_cut_short_is_left_out(least):
    text = "\n".join(["a,b", *["1,2"] * ROWS, "3"])
    table = cut(text, "a.csv", AS_IT_IS)
    assert len(table) == ROWS
    assert table.notes == (f"The last row (line {ROWS + 2}) is cut short; it was left out.",)
    assert long_result(text, AS_IT_IS, least) == contents(table)


def test_a_clock_before_each_line_leaves_the_text_to_the_rules(plain):
    lines = ["a,b", *["1,2"] * ROWS]
    text = "\n".join(f"14:11:40.12{k % 10} -> {line}" for k, line in enumerate(lines))
    assert cut(text, "a.csv", AS_IT_IS).names == ("a", "b")
    assert long_result(text, AS_IT_IS, 1000) == result(text, AS_IT_IS)
    assert not plain


def test_a_short_text_is_left_to_the_rules(plain):
    assert cut("\n".join(["a,b", *["1,2"] * ROWS]), "a.csv", AS_IT_IS).count == ROWS
    assert not plain


def test_without_pyarrow_a_long_text_is_left_to_the_rules(plain, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    text = "\n".join(["t,a", *[f"{k},{0.1 * k!r}" for k in range(ROWS)]])
    assert long_result(text, AS_IT_IS, 1000) == result(text, AS_IT_IS)
    assert not plain


def test_a_fault_in_a_later_block_keeps_its_line_and_its_text():
    lines = ["t,a,b", *[f"{0.001 * k!r},{0.1 * k!r},{-0.7 * k!r}" for k in range(ROWS)]]
    lines[160], lines[165] = "7.0", "7.0,seven,1.0"
    text = Text(lambda: in_blocks("\n".join(lines), 100), LONG + 1)
    table = table_in(text, "a.csv", AS_IT_IS, ReadingBudget().of("a.csv", LONG))
    assert table.faulty[0].where == "a.csv, line 161"
    (row,) = table.numbers("a").garbage.tolist()
    assert table.place(row) == "line 166"
    assert table.found("a", row) == "'seven'"
