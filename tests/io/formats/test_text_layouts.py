"""Texts as loggers, spreadsheets and terminals write them: each gives the same numbers."""

import numpy as np
import pytest

from equipoise.io.columns.column_map import Layout
from equipoise.io.formats.csv_table import cut
from equipoise.model.errors import InputError

NAMES = ["ms", "qw", "gx"]
ROWS = [[25 * k, 1.0 - 0.001 * k, -0.25 + k] for k in range(8)]
PLAIN = [",".join(map(str, row)) for row in ROWS]
HEADER = ",".join(NAMES)


def text(header: list[str], rows: list[str], end: str = "\n") -> str:
    """Return lines."""
    return end.join([*header, *rows]) + end


def spaced(row: str) -> str:
    return row.replace(",", "   ")


CUT_IN_TWO = [
    ",".join(f"{value:.3f}".replace(".", ",").replace("+", "") for value in row) for row in ROWS
]
LAYOUTS = {
    "plain": text([HEADER], PLAIN),
    "a comma too many in the header": text([HEADER + ","], PLAIN),
    "a comma too many everywhere": text([HEADER + ","], [row + "," for row in PLAIN]),
    "a comma too many in the rows": text([HEADER], [row + "," for row in PLAIN]),
    "a row of units": text([HEADER, "[ms],-,[rad/s]"], PLAIN),
    "a row of bare units": text([HEADER, "ms,,rad/s"], PLAIN),
    "decimal commas between commas": text([HEADER], CUT_IN_TWO),
    "NumPy's savetxt": text(["# ms qw gx"], [row.replace(",", " ") for row in PLAIN]),
    "columns in spaces": text(["  ms     qw   gx"], ["  " + spaced(row) for row in PLAIN]),
    "a comment before": text(["# made on a Monday", HEADER], PLAIN),
    "a terminal": text(
        ["14:03:21.000 -> Ready", "14:03:21.001 -> " + HEADER],
        [f"14:03:21.{k:03d} -> {row}" for k, row in enumerate(PLAIN, 2)],
    ),
    "a terminal with brackets": text(
        ["[14:03:21.001] " + HEADER], [f"[14:03:21.{k:03d}] {row}" for k, row in enumerate(PLAIN)]
    ),
}


@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize("made", LAYOUTS.values(), ids=LAYOUTS.keys())
def test_a_layout_gives_the_same_columns(made, end) -> None:
    """Every number is that of the plain table."""
    table = cut(made.replace("\n", end), "r.csv", Layout())
    assert table.names == tuple(NAMES)
    assert not table.faulty
    for name, column in zip(NAMES, np.array(ROWS).T, strict=True):
        np.testing.assert_allclose(table.numbers(name).values, column, atol=1e-12)


def test_a_table_without_a_header_has_columns_by_number() -> None:
    """No row is lost."""
    table = cut(text([], PLAIN), "r.csv", Layout())
    assert table.names == ("1", "2", "3")
    assert len(table) == len(ROWS)
    np.testing.assert_array_equal(table.numbers("1").values, [row[0] for row in ROWS])


STATED = {
    "names on line 3": (["a note", "another,1,2", HEADER], Layout(skip_rows=2)),
    "then units": (["a note", HEADER, "a,b,c"], Layout(skip_rows=1, units_row=True)),
    "units of no known kind": ([HEADER, "a,b,c"], Layout(units_row=True)),
}


@pytest.mark.parametrize(("header", "layout"), STATED.values(), ids=STATED.keys())
def test_a_layout_that_is_stated_goes_before_what_is_detected(header, layout) -> None:
    """Names and rows are where the person says."""
    table = cut(text(header, PLAIN), "r.csv", layout)
    assert table.names == tuple(NAMES)
    assert len(table) == len(ROWS)


@pytest.mark.parametrize("skip_rows", [None, 1])
def test_a_table_that_has_no_header_by_what_is_stated(skip_rows) -> None:
    """A line of text before the numbers is none."""
    table = cut(text(["made,on,Monday"], PLAIN), "r.csv", Layout(skip_rows=skip_rows, header=False))
    assert table.names == ("1", "2", "3")
    assert len(table) == len(ROWS)


def test_decimal_commas_that_cannot_be_joined_name_the_remedy() -> None:
    """Whole numbers have no second part, so that rows have any number of cells."""
    rows = ["0,1,0,250", "25,0,999,0,750", "50,0,998,1,75"]
    table = cut(text([HEADER], rows), "r.csv", Layout())
    assert len(table.faulty[0].rows) == 3
    assert "';'" in table.faulty[0].wanted


def test_units_are_not_taken_for_names_nor_names_for_units() -> None:
    """A header of one-letter names such as 's' above data is a header."""
    table = cut(text(["note,here,too", "s,m,g"], PLAIN), "r.csv", Layout())
    assert table.names == ("note", "here", "too")
    table = cut(text(["s,m,g"], PLAIN), "r.csv", Layout())
    assert table.names == ("s", "m", "g")


def test_blank_lines_do_not_shift_the_line_of_a_fault() -> None:
    """The header is line 3, a blank line follows."""
    table = cut("\n\n" + text([HEADER, ""], [*PLAIN[:3], "100,1", *PLAIN[3:]]), "r.csv", Layout())
    assert table.faulty[0].where == "r.csv, line 8"


def test_a_line_too_long_for_any_table_is_an_error() -> None:
    """A cell of two million characters is not a table's."""
    with pytest.raises(InputError, match="line 2"):
        cut(f"a,b\n{'1' * (1 << 21)},2\n", "r.csv", Layout())
