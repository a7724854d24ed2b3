"""A long plain text, cut by pyarrow, is the same table as one cut row by row."""

import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equipoise.io.columns.column_map import Layout
from equipoise.io.columns.table import Table
from equipoise.io.formats import csv_table
from equipoise.io.formats.csv_table import cut, row_by_row
from equipoise.io.formats.long_text import FIRST_LINES, plain_table
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


def contents(table: Table) -> dict[str, object]:
    """Return all that a table holds, in a form that can be compared to the last bit."""
    return {
        "head": (table.source, table.names, table.units, table.blank, len(table)),
        "lines": (table.lines, table.notes),
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
    """Return the table that a text is row by row, or the sentence why it is none."""
    try:
        return contents(row_by_row(text, "a.csv", layout))
    except InputError as error:
        return str(error)


@settings(max_examples=count(300, 40), deadline=None)
@given(texts(clean=True))
def test_a_plain_text_is_the_same_table(text):
    plain = plain_table(text, "a.csv", AS_IT_IS)
    assert plain is not None
    assert contents(plain) == result(text, AS_IT_IS)


@settings(max_examples=count(3000, 150), deadline=None)
@given(texts(clean=False), st.one_of(st.just(AS_IT_IS), layouts))
def test_any_text_is_the_same_table_or_is_left_to_the_rules(text, layout):
    plain = plain_table(text, "a.csv", layout)
    assert plain is None or contents(plain) == result(text, layout)


@pytest.mark.parametrize("odd", ODD_LINES)
def test_a_line_that_is_not_plain_leaves_the_text_to_the_rules(odd):
    rows = ["a,b,c", *["1,2,3"] * ROWS]
    assert plain_table("\n".join([*rows, odd, *rows[1:]]), "a.csv", AS_IT_IS) is None


@pytest.mark.parametrize("word", WORDS)
def test_a_cell_that_is_no_number_spoils_its_own_column_alone(word):
    shown = f'"{word}"' if "," in word else word
    text = "\n".join(["a,b,c", *["1,2,3"] * ROWS, f"1,{shown},3", "1,2,3"])
    table = plain_table(text, "a.csv", AS_IT_IS)
    assert (table is None) == ("," in word)
    assert table is None or contents(table) == result(text, AS_IT_IS)


@pytest.mark.parametrize("line", PLAIN_LINES)
def test_a_line_with_all_its_cells_is_plain(line):
    rows = ["a,b,c", *["1,2,3"] * ROWS]
    text = "\n".join([*rows, line, *rows[1:]])
    table = plain_table(text, "a.csv", AS_IT_IS)
    assert table is not None
    assert contents(table) == result(text, AS_IT_IS)


def test_a_clock_before_each_line_leaves_the_text_to_the_rules():
    lines = ["a,b", *["1,2"] * ROWS]
    text = "\n".join(f"14:11:40.12{k % 10} -> {line}" for k, line in enumerate(lines))
    assert row_by_row(text, "a.csv", AS_IT_IS).names == ("a", "b")
    assert plain_table(text, "a.csv", AS_IT_IS) is None


def test_a_short_text_is_left_to_the_rules():
    assert plain_table("a,b\n1,2\n3,4\n", "a.csv", AS_IT_IS) is None
    assert plain_table("", "a.csv", AS_IT_IS) is None


@pytest.fixture
def long_text(monkeypatch) -> str:
    """Return a table that is longer than what is read row by row, here a short one."""
    text = "\n".join(["t,a,b", *[f"{0.001 * k!r},{0.1 * k!r},{-0.7 * k!r}" for k in range(ROWS)]])
    monkeypatch.setattr(csv_table, "LONG", len(text) - 100)
    return text


def test_a_long_text_is_not_cut_row_by_row(long_text, monkeypatch):
    whole = row_by_row(long_text, "a.csv", AS_IT_IS)
    monkeypatch.setattr(csv_table, "row_by_row", None)  # nobody calls it
    assert contents(cut(long_text, "a.csv", AS_IT_IS)) == contents(whole)


def test_without_pyarrow_a_long_text_is_cut_row_by_row(long_text, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow.csv", None)
    assert plain_table(long_text, "a.csv", AS_IT_IS) is None
    assert len(cut(long_text, "a.csv", AS_IT_IS)) == ROWS


def test_a_fault_in_a_long_text_keeps_its_line(long_text):
    lines = long_text.splitlines()
    lines[160] = "7.0"
    (fault,) = cut("\n".join(lines), "a.csv", AS_IT_IS).faulty
    assert fault.where == "a.csv, line 161"
    lines[160] = "7.0,seven,1.0"
    table = cut("\n".join(lines), "a.csv", AS_IT_IS)
    (row,) = table.numbers("a").garbage.tolist()
    assert table.place(row) == "line 161"
    assert table.found("a", row) == "'seven'"
