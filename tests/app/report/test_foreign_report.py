"""`equipoise report` on the folder of a run that anyone may have written."""

import base64
import json
import struct

import pypdfium2
import pytest
from matplotlib.figure import Figure as Drawn

from equipoise.app.figures.base.files import rendered
from equipoise.app.text.blocks import (
    Column,
    Document,
    Figure,
    Heading,
    Item,
    Items,
    Pairs,
    Paragraph,
    Row,
    Section,
    Table,
    text_of_document,
)
from equipoise.app.text.charts import Chart, Heatmap, Panel, Rows

NAMES = ("[red]a[/red] [link=http://x]b[/link]", "<script>alert(1)</script>", "#eval(\"1\") $x$ @a",
         "=cmd|'/c calc'!A1", "\x1b]0;t\x07", "a\u202eb\u200b", "../../x")  # fmt: skip
VISIBLE = (r"\x1b]0;t\x07", r"a\u202eb\u200b")
SVG = b'<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9">%s</svg>'


def drawn():
    figure = Drawn(figsize=(1, 1))
    figure.subplots().imshow([[0.0, 1.0]])
    return rendered(figure, "svg")


OWN_SVG = drawn()


def document(*blocks, title="a run"):
    return text_of_document(Document(title, "bed", (Section("", blocks),)))


@pytest.fixture
def report(equipoise, tmp_path):
    """Return a function that writes the folder of a run and sets its report."""
    (tmp_path / "secret.svg").write_bytes(OWN_SVG)

    def call(text, svg=OWN_SVG):
        folder = tmp_path / "run"
        (folder / "figures").mkdir(parents=True)
        (folder / "report.json").write_text(text, encoding="utf-8")
        (folder / "figures" / "a.svg").write_bytes(svg)
        return equipoise("report", folder), folder

    return call


def refused(done, folder):
    """Say whether that was one sentence, and nothing was written."""
    lines = done.err.strip().splitlines()
    return (done.code, len(lines), done.out) == (2, 1, "") and not (folder / "report.html").exists()


def test_a_report_of_our_own_is_set(report):
    done, folder = report(document(Paragraph("x"), Figure("a", "it")))
    assert done.code == 0
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF")


def test_figures_come_as_png_too_on_request(report, equipoise):
    """One inch of drawing is 300 pixels wide."""
    _, folder = report(document(Figure("a", "it")))
    assert equipoise("report", folder, "--png").code == 0
    picture = (folder / "figures" / "a.png").read_bytes()
    assert picture.startswith(b"\x89PNG\r\n\x1a\n")
    assert struct.unpack(">II", picture[16:24]) == (300, 300)


def test_whatever_texts_hold_is_shown_and_does_nothing(report):
    blocks = [
        *map(Heading, NAMES), *map(Paragraph, NAMES), Pairs(tuple((n, n) for n in NAMES)),
        Table(NAMES[0], (Column(NAMES[1], NAMES[2]),), tuple(Row((n,)) for n in NAMES), NAMES),
    ]  # fmt: skip
    done, folder = report(document(*blocks, title=NAMES[1]))
    assert done.code == 0
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "<script>alert" not in page
    printed = pdf_text(folder / "report.pdf")
    for name in (*NAMES[:4], NAMES[6], *VISIBLE):
        assert "".join(name.split()) in printed
    for text in (page, printed):
        assert not {"\x1b", "\x07", "\u202e"} & set(text)


def pdf_text(path):
    pages = pypdfium2.PdfDocument(path.read_bytes())
    text = "".join(page.get_textpage().get_text_range() for page in pages)
    return "".join(text.replace("\ufffe", "").replace("\u200b", "").split())


NOT_PLAIN = ["../../secret", "../secret", "/secret", "a/../../../secret", "", ".a", "a.b", "a\\b"]


@pytest.mark.parametrize("name", NOT_PLAIN)
def test_a_figure_is_named_plainly(report, name):
    """With ``..`` any picture of the disk came into the report."""
    done, folder = report(document(Figure(name, "it")))
    assert refused(done, folder)
    assert "plain name" in done.err


def test_a_figure_is_no_link_to_elsewhere(report, equipoise, tmp_path):
    _, folder = report(document(Paragraph("x")))
    (folder / "report.html").unlink()
    (folder / "report.json").write_text(document(Figure("a", "it")))
    (folder / "figures" / "a.svg").unlink()
    (folder / "figures" / "a.svg").symlink_to(tmp_path / "secret.svg")
    done = equipoise("report", folder)
    assert refused(done, folder)
    assert "a link to elsewhere" in done.err


def large_picture():
    head = b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII", 13, b"IHDR", 100_000, 100_000) + bytes(9)
    return b'<image href="data:image/png;base64,' + base64.b64encode(head) + b'"/>'


DRAWINGS = {
    "cut short": OWN_SVG[:2000],
    "empty": b" ",
    "no drawing": b"\0\0\0",
    "compressed": b"\x1f\x8b\x08\0" + OWN_SVG,
    "link to a picture": SVG % b'<image href="secret.png" width="9" height="9"/>',
    "old link to a picture": SVG % b"<image xlink:href='secret.png'/>",
    "link with an entity": SVG % b'<image href="&#x73;ecret.png"/>',
    "other drawing": SVG % b'<image href="data:image/svg+xml;base64,AAAA"/>',
    "entities": b'<!DOCTYPE svg [<!ENTITY a "aaa">]>' + SVG % b"<text>&a;</text>",
    "filter": SVG % b'<filter id="f"/>',
    "large picture": SVG % large_picture(),
    "not well formed": SVG % b"<g>",
    "deep": SVG % (b"<g>" * 20_000 + b"</g>" * 20_000),
}


@pytest.mark.parametrize("drawing", DRAWINGS.values(), ids=DRAWINGS.keys())
def test_a_drawing_that_is_broken_or_shows_something_else_is_refused(report, drawing):
    assert refused(*report(document(Figure("a", "it")), svg=drawing))


def nested(depth):
    return '{"title": ' + "[" * depth + "]" * depth + "}"


UNEQUAL = Rows(("x",), (1.0, 2.0), ((1.0,),))
MANY = Rows(("x",), tuple(map(float, range(60_000))), ((0.0,) * 60_000,))
LARGE = {
    "20 000 paragraphs": document(*[Paragraph("x")] * 20_000),
    "200 000 texts": document(Items((Item("x"),) * 200_000)),
    "long text": document(Paragraph("x" * 6_000_000)),
    "long file": document(Paragraph("x")) + " " * (1 << 25),
    "character NUL": document(Paragraph("a\0b")),
    "nesting": nested(100_000),
    "row too wide": document(Table("", (Column("a"),), (Row(("1", "2")),))),
    "row too narrow": document(Table("", (Column("a"), Column("b")), (Row(("1",)),))),
    "columns of unequal length": document(Chart("a", "", (Panel("", "", (UNEQUAL,)),))),
    "a million numbers": document(*[Chart("a", "", (Panel("", "", (MANY,)),))] * 10),
    "correlations not square": document(Heatmap("", ("a", "b"), ((1.0,),))),
    "no text": json.dumps({"title": 3}),
    "lone surrogate": document(Paragraph("x")).replace('"x"', '"\\ud800"'),
    "unknown block": document(Paragraph("x")).replace('"paragraph"', '"script"'),
    "not JSON": "\x1b[31m",
    "list": "[]",
}


@pytest.mark.parametrize("text", LARGE.values(), ids=LARGE.keys())
def test_a_document_that_is_none_of_ours_is_refused(report, text):
    done, folder = report(text)
    assert refused(done, folder)
    assert "report.json" in done.err
