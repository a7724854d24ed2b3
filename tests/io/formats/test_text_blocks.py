"""A text is read in blocks of whole lines, whatever its encoding and its ends of lines."""

from pathlib import Path

import numpy as np
import pytest

from equipoise.io.columns.column_map import Layout
from equipoise.io.columns.table import Table
from equipoise.io.files.file_content import Content
from equipoise.io.files.reading_budget import ReadingBudget
from equipoise.io.formats.csv_table import table_in
from equipoise.io.formats.text_blocks import BLOCK, FIRST, LONGEST, Text, text_in
from equipoise.io.formats.text_rows import CELLS
from equipoise.model.errors import InputError

PATH = Path("a.csv")
ROWS = FIRST // 4  # of a text that has several blocks
SMALL, USUAL = ReadingBudget(1_000_000), ReadingBudget()


def text_of_bytes(data: bytes, budget: ReadingBudget = USUAL) -> Text:
    return text_in(Content.of(data, "a.csv", budget), PATH, "a table")


def table_of_bytes(data: bytes, budget: ReadingBudget = USUAL) -> Table:
    content = Content.of(data, "a.csv", budget)
    return table_in(text_in(content, PATH, "a table"), "a.csv", Layout(), content.meter)


def lines(count: int, end: str = "\n") -> str:
    return end.join(["t,a,b", *[f"{k},{k / 4},-7" for k in range(count)]]) + end


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"])
def test_blocks_hold_the_lines_of_the_whole(encoding, end) -> None:
    whole = lines(ROWS, end) if encoding[-3:] in ("-le", "-be") else f"\u03b1{lines(ROWS, end)}"
    text = text_of_bytes(whole.encode(encoding))
    blocks = list(text.blocks())
    assert len(blocks) > 1
    assert "".join(blocks) == whole
    assert [line for block in blocks for line in block.splitlines()] == whole.splitlines()
    assert list(text.lines()) == whole.splitlines()  # a second time


def test_a_block_that_is_not_utf_8_is_read_as_latin_1() -> None:
    whole = lines(ROWS)
    text = text_of_bytes(whole.encode() + b"9999999,\xb5,1\n")
    assert "".join(text.blocks()) == whole + "9999999,\xb5,1\n"


def test_a_utf_16_text_that_ends_within_a_letter_has_all_its_rows() -> None:
    table = table_of_bytes(lines(ROWS).encode("utf-16")[:-1])
    assert len(table) == ROWS
    np.testing.assert_array_equal(table.numbers("t").values, np.arange(ROWS))


@pytest.mark.parametrize("before", ["", lines(200), lines(ROWS)])
def test_a_line_without_an_end_is_refused_by_its_number(before) -> None:
    number = before.count("\n") + 1
    with pytest.raises(InputError, match=f"line {number}: found more than {LONGEST} bytes"):
        table_of_bytes((before + "1" * (LONGEST + BLOCK)).encode())


@pytest.mark.parametrize("before", [1, 300])
def test_a_row_of_more_cells_than_any_table_has_is_refused(before) -> None:
    text = lines(before) + "1," * 200_000 + "\n"
    with pytest.raises(InputError, match=f"line {before + 2}: found 200001 cells; wanted {CELLS}"):
        table_of_bytes(text.encode())


def test_what_takes_more_than_its_budget_is_refused_while_it_is_read() -> None:
    whole = lines(100_000).encode()
    with pytest.raises(InputError, match="--max-memory-mb 2 lets it take more"):
        table_of_bytes(whole, SMALL)
    assert len(table_of_bytes(whole, ReadingBudget(20_000_000))) == 100_000


def test_words_in_a_column_are_counted_as_well() -> None:
    whole = "\n".join(["t,a", *[f"{k},{'word' * 20}" for k in range(10_000)]])
    with pytest.raises(InputError, match="--max-memory-mb"):
        table_of_bytes(whole.encode(), SMALL)


def test_lines_to_skip_are_not_held_as_cells_without_end() -> None:
    content = Content.of(lines(50_000).encode(), "a.csv", SMALL)
    text = text_in(content, PATH, "a table")
    with pytest.raises(InputError, match="--max-memory-mb"):
        table_in(text, "a.csv", Layout(skip_rows=10**9), content.meter)
