"""A report's blocks come through JSON, HTML and PDF as they are."""

from html.parser import HTMLParser

import pypdfium2
import pytest

from equipoise.app.report.html import html
from equipoise.app.report.pdf import pdf
from equipoise.app.text.blocks import (
    Claim,
    Drawn,
    Grid,
    Heading,
    Items,
    Moment,
    Page,
    Pairs,
    Paragraph,
    Section,
    page_of_text,
    text_of_page,
)
from equipoise.model.errors import InputError

ODD = r"""#let *a* _b_ $x$ @c `d` \e <f> & "g" 'h' [i] {j} ~ = + - / // 4. k"""
DOT = b"\x89PNG"
SVG = b'<svg xmlns="http://www.w3.org/2000/svg" width="40" height="30"/>'
PAGE = Page(
    f"Title {ODD}",
    f"Platform {ODD}",
    (
        Section("", (Claim("It is not so.", False), Claim("It is so.", True))),
        Section(
            f"Section {ODD}",
            (
                Heading(f"Heading {ODD}"),
                Paragraph(f"Paragraph {ODD}"),
                Items((f"Item {ODD}", "Another")),
                Pairs(((f"name {ODD}", f"value {ODD}"),)),
                Grid(("", "what"), (("1", f"cell {ODD}"), ("2", "words " * 40)), (1,)),
                Moment("1.5 s", "measurement", f"Moment {ODD}"),
                Drawn("one", f"Caption {ODD}"),
            ),
        ),
    ),
)


class Words(HTMLParser):
    """Keeps the text."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.parts: list[str] = []
        self.feed(page)

    def handle_data(self, data):
        self.parts.append(data)


def texts(page):
    """Yield every text that a reader is told."""
    yield from (page.title, page.platform)
    for section in page.sections:
        yield section.title
        for block in section.blocks:
            for name in ("text", "time", "what", "caption"):
                yield getattr(block, name, "")
            yield from getattr(block, "texts", ())
            yield from (word for pair in getattr(block, "pairs", ()) for word in pair)
            yield from (cell for line in getattr(block, "lines", ()) for cell in line)


def bare(text):
    """Return a text without blanks, hyphens and quotes: a page is broken into lines."""
    return "".join(
        c
        for c in text
        if not c.isspace() and c not in "-\u2010\u2212\u00ad\ufffe\"'\u2018\u2019\u201c\u201d"
    )


def reported_in_pdf(data):
    document = pypdfium2.PdfDocument(data)
    return bare("".join(page.get_textpage().get_text_range() for page in document))


def test_every_block_comes_back_from_json():
    assert page_of_text(text_of_page(PAGE), "here") == PAGE


@pytest.mark.parametrize(
    "text", ["", "{}", "[]", '{"title": 1}', '{"schema": "equipoise/report/2"}']
)
def test_what_is_no_report_is_refused_in_words(text):
    with pytest.raises(InputError, match="equipoise/report/1"):
        page_of_text(text, "here")


def test_html_says_it_all_as_it_is():
    page = html(PAGE, {"one": DOT})
    words = bare(" ".join(Words(page).parts))
    for text in texts(PAGE):
        assert bare(text) in words


def test_pdf_says_it_all_as_it_is():
    """Word by word: cells that stand side by side are broken into lines of their own."""
    reported = reported_in_pdf(pdf(PAGE, {"one": SVG}))
    for text in texts(PAGE):
        for word in text.split():
            assert bare(word) in reported
