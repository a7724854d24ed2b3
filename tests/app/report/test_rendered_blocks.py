"""Every kind of block comes through JSON, terminal, HTML and PDF as it is."""

from html.parser import HTMLParser
from typing import get_args

import pypdfium2
import pytest
from rich.console import Console

from equipoise.app.console.rich_blocks import renderable, show
from equipoise.app.report.html import html
from equipoise.app.report.pdf import pdf
from equipoise.app.text.blocks import (
    Block,
    Claim,
    Column,
    Document,
    Figure,
    Heading,
    Item,
    Items,
    Moment,
    Pairs,
    Paragraph,
    Row,
    Section,
    Table,
    Tone,
    document_of_text,
    number,
    printed,
    prose,
    table,
    text_of_document,
)
from equipoise.app.text.charts import (
    Chart,
    Ellipsoid,
    Heatmap,
    MovingMass,
    Panel,
    Replay,
    Rows,
)
from equipoise.model.errors import InputError

ODD = r"""#let *a* _b_ $x$ @c `d` \e <f> & "g" 'h' [i] {j} ~ = + - / // 4. k"""
DOT = b"\x89PNG"
SVG = b'<svg xmlns="http://www.w3.org/2000/svg" width="40" height="30"/>'
TONES = get_args(Tone)
UP = (0.0, 0.0, 1.0)
PANEL = Panel(f"panel {ODD}", "um", (Rows((f"line {ODD}",), (1.0, 2.0), ((0.5, None),)),), 1.0)
SAMPLES = {
    Heading: [Heading(f"Heading {ODD}")],
    Paragraph: [Paragraph(f"{tone} paragraph {ODD}", tone) for tone in TONES],
    Claim: [Claim(f"{tone} claim {ODD}", tone) for tone in TONES],
    Items: [Items(tuple(Item(f"{tone} item {ODD}", tone) for tone in TONES))],
    Pairs: [Pairs(((f"name {ODD}", f"value {ODD}"),))],
    Table: [
        Table(
            f"Table {ODD}",
            (Column(), number("what", "mm"), prose("why")),
            tuple(Row(("1", f"cell {ODD}", f"{tone} words " * 20), tone) for tone in TONES),
            (f"Note {ODD}",),
        ),
        table("No rows", (), (), ("too few",)),
        table("", (Column(), Column()), (("no title", "no headings"),)),
    ],
    Moment: [Moment("1.5 s", "measurement", f"Moment {ODD}")],
    Figure: [Figure("one", f"Caption {ODD}")],
    Chart: [Chart("one", f"Caption {ODD}", (PANEL,), f"axis {ODD}", "s", "", ((1.0, 1.5),),
                  f"Drawing {ODD}")],
    Replay: [
        Replay("two", f"Caption {ODD}", "a", "table-top", UP, (0.0,), ((1.0, 0.0, 0.0, 0.0),),
               (MovingMass(f"mass {ODD}", UP, UP, (0.0, 1.0)),), ((0.1,),), UP, (1.0,) * 9,
               Ellipsoid(UP, (UP, UP, UP)))
    ],
    Heatmap: [
        Heatmap(f"Title {ODD}", ("a", f"b {ODD}"), ((1.0, -0.5), (None, 1.0)), f"Note {ODD}")
    ],
}  # fmt: skip
EVERY = tuple(block for blocks in SAMPLES.values() for block in blocks)


def document_with(*blocks):
    return Document(f"Title {ODD}", f"Platform {ODD}", (Section(f"Section {ODD}", blocks),))


class Words(HTMLParser):
    """Keeps the text."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.parts: list[str] = []
        self.feed(page)

    def handle_data(self, data):
        self.parts.append(data)


IN_DRAWING = ("panels", "axis", "axis_unit")  # of a chart, in the terminal alone as texts
NOT_SHOWN = ("record", "layout", "masses", "mark")


def texts(block):
    """Yield every text of a block that a reader is shown; kinds and tones are none."""
    if block is None or isinstance(block, float):
        return
    if isinstance(block, str):
        yield block
    elif isinstance(block, tuple):
        for part in block:
            yield from texts(part)
    else:
        for name in block.__dataclass_fields__:
            if name not in ("kind", "tone", "align", "fold", "schema", *NOT_SHOWN):
                yield from texts(getattr(block, name))


def bare(text):
    """Return a text without blanks, hyphens and quotes: a page is broken into lines."""
    return "".join(
        c
        for c in text
        if not c.isspace() and c not in "-\u2010\u2212\u00ad\ufffe\"'\u2018\u2019\u201c\u201d"
    )


def in_terminal(block):
    console = Console(width=400, color_system=None)
    with console.capture() as capture:
        console.print(renderable(block))
    return capture.get()


def in_html(*blocks):
    return " ".join(Words(html(document_with(*blocks), {"one": DOT})).parts)


def in_pdf(*blocks):
    pages = pypdfium2.PdfDocument(pdf(document_with(*blocks), {"one": SVG}))
    return "".join(page.get_textpage().get_text_range() for page in pages)


RENDERERS = {"terminal": in_terminal, "html": in_html, "pdf": in_pdf}


def hidden_texts(block, renderer):
    """Return the texts of a block that a renderer draws or leaves out."""
    if renderer == "terminal":
        return (block.drawing,) if isinstance(block, Chart) else ()
    if isinstance(block, Figure):
        return ("one",)
    if isinstance(block, Chart):
        own = (block.caption,) if renderer == "pdf" else ()
        drawn = (text for name in IN_DRAWING for text in texts(getattr(block, name)))
        return ("one", *own, *drawn)
    if isinstance(block, Replay):
        return ("two", block.caption) if renderer == "pdf" else ("two",)
    return ()


def test_a_sample_of_every_kind_of_block_is_here():
    assert set(SAMPLES) == set(get_args(Block))


@pytest.mark.parametrize("renderer", RENDERERS)
@pytest.mark.parametrize("kind", get_args(Block), ids=lambda kind: kind.__name__)
def test_every_renderer_shows_every_text_of_every_block(kind, renderer):
    """Word by word: cells that stand side by side are broken into lines of their own."""
    for block in SAMPLES[kind]:
        shown = bare(RENDERERS[renderer](block))
        hidden = hidden_texts(block, renderer)
        for text in texts(block):
            for word in text.split():
                assert text in hidden or bare(word) in shown


@pytest.mark.parametrize("renderer", [in_html, in_pdf])
def test_a_report_shows_its_titles(renderer):
    shown = bare(renderer(*EVERY))
    for text in ("Title", "Platform", "Section"):
        assert bare(f"{text} {ODD}") in shown


def test_every_block_comes_back_from_json():
    document = document_with(*EVERY)
    assert document_of_text(text_of_document(document), "here") == document


@pytest.mark.parametrize(
    "text", ["", "{}", "[]", '{"title": 1}', '{"schema": "equipoise/report/2"}']
)
def test_what_is_no_report_is_refused_in_words(text):
    with pytest.raises(InputError, match="equipoise/report/1"):
        document_of_text(text, "here")


def test_a_printed_table_has_typeset_units_and_the_terminal_plain_ones():
    """In headings, and in a column of units; a word that merely contains one stays."""
    block = table("", (Column("of um"), number("com", "um")), (("kg m2", "1"), ("a um", "2")))
    (section,) = printed(document_with(block)).sections
    (typeset,) = section.blocks
    assert [column.title for column in typeset.columns] == ["of um", "com, µm"]
    assert [row.cells[0] for row in typeset.rows] == ["kg m²", "a um"]
    assert "com, um" in in_terminal(block)


def test_tables_stand_separation_and_sentences_together(capsys):
    one = table("One", (Column(),), (("cell",),))
    show((Moment("1 s", "measurement", "Read."), one, Paragraph("First."), Paragraph("Second.")))
    lines = [line.strip() for line in capsys.readouterr().out.splitlines()]
    assert lines[1:] == ["", "One", "cell", "", "First.", "Second."]


def test_what_stands_below_other_lines_is_set_off(capsys):
    show((Paragraph("First."),), below=True)
    show((), below=True)
    assert capsys.readouterr().out == "\nFirst.\n"
