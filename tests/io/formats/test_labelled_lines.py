"""Texts whose numbers have their names before them, and numbers as Fortran prints them."""

import pytest

from equipoise.io.columns.column_map import Layout
from equipoise.io.formats.cell_numbers import number_in
from equipoise.io.formats.csv_table import cut
from equipoise.io.formats.labelled_lines import NOTE

ROWS = [(0.01, 1.0), (0.02, -0.5), (0.03, 1e-3)]


def lines(form: str) -> str:
    return "\n".join(form.format(t, q) for t, q in ROWS)


@pytest.mark.parametrize(
    "form",
    [
        "t:{} qw:{}",
        "t={}, qw={}",
        "t: {}\tqw: {}",
        "t = {} ; qw = {}",
        " t:{}|qw:{} ",
        "14:03:21.000 -> t:{},qw:{}",
    ],
)
def test_names_before_numbers_become_the_header(form) -> None:
    table = cut(lines(form), "run.txt", Layout())
    assert table.names == ("t", "qw")
    assert list(zip(table.numbers("t").values, table.numbers("qw").values, strict=True)) == ROWS
    assert list(table.lines) == [1, 2, 3]


def test_lines_may_have_another_order_and_words_between() -> None:
    text = "ready\nt:1 q:2\nq:4 t:3\nt:5\nt:6 q:7 r:8\nt:9 q:10\nt:11 q:12"
    table = cut(text, "run.txt", Layout())
    assert table.names == ("t", "q")
    assert [each.rows.tolist() for each in table.faulty] == [[2, 3]]
    kept = [0, 1, 4, 5]
    assert table.numbers("t").values[kept].tolist() == [1, 3, 9, 11]
    assert table.numbers("q").values[kept].tolist() == [2, 4, 10, 12]


@pytest.mark.parametrize(
    "text",
    [
        "t,q\n1,2\n3,4",
        "t:q\n1:2\n3:4",
        "only:1\nonly:2",
        "12:01:02 3\n12:01:03 4",
        "a:1 a:2\na:3 a:4",
    ],
)
def test_other_texts_are_cut_as_before(text) -> None:
    notes = cut(text, "run.txt", Layout()).notes
    assert NOTE not in notes


@pytest.mark.parametrize(
    ("cell", "number"),
    [("1.0D+00", 1.0), ("-2.5d-03", -2.5e-3), (".5D1", 5.0), ("3D2", 300.0), ("1.5e2", 150.0)],
)
def test_exponents_of_fortran_are_numbers(cell, number) -> None:
    assert number_in(cell, ".") == number


@pytest.mark.parametrize("cell", ["D", "1D", "D+00", "0x1D", "1.0D+", "ID3"])
def test_words_with_a_d_are_none(cell) -> None:
    assert number_in(cell, ".") is None
