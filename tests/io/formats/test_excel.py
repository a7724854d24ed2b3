"""Excel workbooks: which sheet is read, every digit of a number, and a sentence for the rest."""

import sys

import numpy as np
import pytest

from equipoise.io.columns.column_map import Layout
from equipoise.io.files.file_content import Content
from equipoise.io.formats.xlsx_table import is_workbook, read_xlsx
from equipoise.io.recording.recording_file import read_recording
from equipoise.model.errors import InputError
from tests.support.broken_files import times_refused
from tests.support.excel_files import RATE_SHEET, Xml, archive, date, parts, sheet_xml, workbook

NUMBERS = np.array(RATE_SHEET[1:], dtype=float)


def table(sheets):
    return read_xlsx(Content.of(workbook(sheets), "run.xlsx"), "run.xlsx", Layout())


def test_a_workbook_is_read_to_the_last_digit(tmp_path):
    """Sevenths and thirds have 16 and 17 digits; the name of the file says nothing."""
    (tmp_path / "run.dat").write_bytes(workbook({"run": RATE_SHEET}))
    rate = read_recording(tmp_path / "run.dat").rate
    np.testing.assert_array_equal(rate.t, NUMBERS[:, 0])
    np.testing.assert_array_equal(rate.values, NUMBERS[:, 1:])


def test_one_sheet_needs_no_note():
    assert table({"run": RATE_SHEET}).notes == ()


def test_the_first_sheet_with_rows_of_numbers_is_taken_and_named():
    about = [["Operator", "A. B."], ["Mass", 4.2], ["Rate", 100]]
    found = table({"About": about, "Empty": [], "Run 1": RATE_SHEET, "Run 2": RATE_SHEET})
    assert found.names == tuple(RATE_SHEET[0])
    (note,) = found.notes
    assert note == "Taken from sheet 'Run 1'; sheets ignored: 'About', 'Empty', 'Run 2'."


def test_a_table_may_begin_anywhere_and_is_found_by_the_rows_of_the_sheet():
    """Title in B2, header in B4, blank columns between; row 6 of the sheet holds a text."""
    header = [None, "t", None, "a", "b"]
    rows = [[], [None, "Run of Monday"], [], header, [None, 0.0, None, 1.0, 2.0],
            [None, 0.1, None, "off", 3.0], [None, 0.2, None, 2.0, 4.0]]  # fmt: skip
    found = table({"run": rows})
    assert found.names == ("t", "a", "b")
    np.testing.assert_array_equal(found.numbers("b").values, [2.0, 3.0, 4.0])
    assert found.numbers("a").garbage.tolist() == [1]
    assert (found.place(1), found.found("a", 1)) == ("line 6", "'off'")


def test_blank_cells_errors_and_truth_values():
    """Blank: no reading; #DIV/0! is no number; TRUE and FALSE are 1 and 0."""
    broken, true = Xml(' t="e"><v>#DIV/0!</v></c>'), Xml(' t="b"><v>1</v></c>')
    false = Xml(' t="b"><v>0</v></c>')
    rows = [["t", "a", "lamp", "e"], [0, 1.5, true, 1], [1, None, false, broken], [2, 2.5, true, 1]]
    found = table({"run": rows})
    np.testing.assert_array_equal(found.numbers("a").values, [1.5, np.nan, 2.5])
    np.testing.assert_array_equal(found.numbers("lamp").values, [1, 0, 1])
    assert found.numbers("e").garbage.tolist() == [1]
    assert (found.place(1), found.found("e", 1)) == ("line 3", "'#DIV/0!'")


def test_a_date_is_its_text():
    """45000 days after 30 December 1899 is 15 March 2023; half a day is noon."""
    rows = [["day", "a", "b"], [date(45000.5), 1, 2], [date(45000.75), 1, 2], [date(45001.0), 1, 2]]
    found = table({"run": rows})
    assert found.found("day", 0) == "'2023-03-15 12:00:00'"


def test_a_workbook_without_numbers_names_its_sheets():
    with pytest.raises(InputError, match="no rows of numbers in sheets 'a', 'b'"):
        table({"a": [["x", "y"]], "b": []})


def test_a_sheet_that_states_a_place_beyond_all_is_refused(monkeypatch):
    """A row of number 99 999 999; five rows that are as wide as a sheet, of room for four."""
    monkeypatch.setattr("equipoise.io.formats.xlsx_table.CELLS", 4 * 16384)
    monkeypatch.setattr("equipoise.io.formats.xlsx_table.ROWS", 4096)
    row = '<row r="99999999"><c r="A99999999"><v>1</v></c></row>'
    numbers = sheet_xml(RATE_SHEET)
    late = numbers.replace("</sheetData>", f"{row}</sheetData>")
    wide = "".join(f'<row><c r="XFD{k}"><v>1</v></c></row>' for k in range(1, 6))
    wide = f"{numbers.partition('<row')[0]}{wide}</sheetData></worksheet>"
    for xml in (late, wide):
        with pytest.raises(InputError, match=r"sheet 'run': found too many cells"):
            read_xlsx(Content.of(archive(parts({"run": xml})), "run.xlsx"), "run.xlsx", Layout())


def test_without_openpyxl_the_sentence_names_the_extra(tmp_path, monkeypatch):
    (tmp_path / "run.xlsx").write_bytes(workbook({"run": RATE_SHEET}))
    monkeypatch.setitem(sys.modules, "openpyxl", None)
    with pytest.raises(InputError, match=r'pip install "equipoise\[excel\]"`, or save .* as CSV'):
        read_recording(tmp_path / "run.xlsx")


def test_a_text_under_the_name_of_a_workbook_is_read(tmp_path):
    rows = "\n".join(",".join(map(str, row)) for row in RATE_SHEET)
    (tmp_path / "run.xlsx").write_text(rows)
    assert len(read_recording(tmp_path / "run.xlsx").rate) == 6


def test_an_archive_is_no_workbook():
    assert not is_workbook(
        Content.of(archive({"xl/notes.txt": "xl/workbook.xml is not here"}), "run")
    )
    assert is_workbook(Content.of(workbook({"run": RATE_SHEET}), "run"))
    assert is_workbook(Content.of(workbook({"run": RATE_SHEET})[:-40], "run"))


@pytest.mark.parametrize("part", sorted(parts({"run": ""})))
def test_a_workbook_with_a_broken_part_is_refused_or_read(tmp_path, part):
    members = parts({"run": sheet_xml(RATE_SHEET)})
    valid = str(members[part]).encode()
    times_refused(valid, tmp_path / "run.xlsx", 40, lambda xml: archive(members | {part: xml}))


def test_a_broken_archive_of_a_workbook_is_refused_or_read(tmp_path):
    assert times_refused(workbook({"run": RATE_SHEET}), tmp_path / "run.xlsx", 150) > 75
