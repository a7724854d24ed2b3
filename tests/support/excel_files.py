"""Excel workbooks, written by hand from ECMA-376, part by part: no library rounds a number."""

import io
import zipfile
from collections.abc import Mapping, Sequence
from xml.sax.saxutils import escape

OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"
SHEETS = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
TYPE = "application/vnd.openxmlformats-officedocument.spreadsheetml"
RELATIONS = "application/vnd.openxmlformats-package.relationships+xml"
DATE = 1  # the style of a cell that is shown as a date and a time
Cell = object  # None: blank; a number, a text, or XML of a cell's content after its place


class Xml(str):
    """The rest of a cell: what stands behind its place."""


def date(days: float) -> Xml:
    """Return a cell that is shown as a date, so many days after the last of 1899."""
    return Xml(f' s="{DATE}"><v>{days!r}</v></c>')


def workbook(sheets: Mapping[str, Sequence[Sequence[Cell]]]) -> bytes:
    """Return a workbook's bytes."""
    return archive(parts({name: sheet_xml(rows) for name, rows in sheets.items()}))


def archive(members: Mapping[str, str | bytes]) -> bytes:
    """Return a zip archive's bytes."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as file:
        for name, content in members.items():
            file.writestr(name, content)
    return stream.getvalue()


def parts(sheets: Mapping[str, str]) -> dict[str, str | bytes]:
    """Return the files of a workbook by their names."""
    numbers = range(1, len(sheets) + 1)
    types = "".join(
        f'<Override PartName="/xl/{part}.xml" ContentType="{TYPE}.{kind}+xml"/>'
        for part, kind in (
            ("workbook", "sheet.main"),
            ("styles", "styles"),
            *((f"worksheets/sheet{k}", "worksheet") for k in numbers),
        )
    )
    rels = f'<Default Extension="rels" ContentType="{RELATIONS}"/>'
    named = "".join(
        f'<sheet name="{escape(name)}" sheetId="{k}" r:id="rId{k}"/>'
        for k, name in enumerate(sheets, 1)
    )
    related = [("worksheet", f"worksheets/sheet{k}.xml") for k in numbers]
    return {
        "[Content_Types].xml": f'<Types xmlns="{PACKAGE}/content-types">{rels}{types}</Types>',
        "_rels/.rels": relations([("officeDocument", "xl/workbook.xml")]),
        "xl/workbook.xml": f'<workbook xmlns="{SHEETS}" xmlns:r="{OFFICE}">'
        f"<sheets>{named}</sheets></workbook>",
        "xl/_rels/workbook.xml.rels": relations([*related, ("styles", "styles.xml")]),
        "xl/styles.xml": STYLES,
        **{f"xl/worksheets/sheet{k}.xml": xml for k, xml in enumerate(sheets.values(), 1)},
    }


def relations(related: Sequence[tuple[str, str]]) -> str:
    """Return which part stands where."""
    rows = (
        f'<Relationship Id="rId{k}" Type="{OFFICE}/{kind}" Target="{target}"/>'
        for k, (kind, target) in enumerate(related, 1)
    )
    return f'<Relationships xmlns="{PACKAGE}/relationships">{"".join(rows)}</Relationships>'


def sheet_xml(rows: Sequence[Sequence[Cell]]) -> str:
    """Return a sheet; a row without cells is left out of it, as Excel does."""
    lines = (
        f'<row r="{k}">{"".join(cell_xml(place(k, j), cell) for j, cell in enumerate(row))}</row>'
        for k, row in enumerate(rows, 1)
        if row
    )
    body = f"<sheetData>{''.join(lines)}</sheetData>"
    return f'<worksheet xmlns="{SHEETS}">{body}</worksheet>'


def place(row: int, column: int) -> str:
    """Return a cell's place, such as B7, of the first 26 columns."""
    return f"{chr(ord('A') + column)}{row}"


def cell_xml(where: str, cell: Cell) -> str:
    """Return a cell."""
    if cell is None:
        return ""
    if isinstance(cell, Xml):
        return f'<c r="{where}"{cell}'
    if isinstance(cell, str):
        return f'<c r="{where}" t="inlineStr"><is><t>{escape(cell)}</t></is></c>'
    return f'<c r="{where}"><v>{cell!r}</v></c>'


STYLES = (
    f'<styleSheet xmlns="{SHEETS}"><fonts count="1"><font/></fonts>'
    '<fills count="1"><fill><patternFill/></fill></fills><borders count="1"><border/></borders>'
    '<cellStyleXfs count="1"><xf/></cellStyleXfs><cellXfs count="2"><xf numFmtId="0"/>'
    '<xf numFmtId="22" applyNumberFormat="1"/></cellXfs></styleSheet>'
)
RATE_SHEET: list[list[Cell]] = [
    ["time_s", "omega_x_rad_s", "omega_y_rad_s", "omega_z_rad_s"],
    *([k / 7, k / 3, 0.1 + k, -2e-17 * k] for k in range(6)),
]
