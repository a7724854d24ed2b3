"""The pages of a report as PDF: none stands half empty, nothing leaves its margins."""

import numpy as np
import pypdfium2
import pytest

EMPTY = 0.35  # of a page between its margins, at most; the last one excepted
TOP, BOTTOM, SIDE = 18 / 297, 20 / 297, 22 / 210  # margins of A4, of height and width
INK = 200  # of 255: darker is ink
COMMANDS = {
    "identify": ("identify", "RECORD", "--testbed", "sputnix"),
    "assess": ("assess", "RECORD", "--testbed", "sputnix"),
    "balance": ("balance", "sputnix", "--seed", "3"),
    "demo": ("demo",),
}


def pages_of(path):
    """Return the pages as grey pictures, 2 pixels a point."""
    with pypdfium2.PdfDocument(path) as document:
        return [np.asarray(page.render(scale=2.0).to_pil().convert("L")) for page in document]


@pytest.fixture(scope="module", params=COMMANDS)
def pages(request, tmp_path_factory):
    from equipoise.app.cli import run

    folder = tmp_path_factory.mktemp("pages")
    record = folder / "record.csv"
    assert run(["simulate", "sputnix", "--duration-s", "20", "--out", str(record)]) == 0
    words = [str(record) if word == "RECORD" else word for word in COMMANDS[request.param]]
    assert run([*words, "--out", str(folder / "out")]) in (0, 1)
    return pages_of(folder / "out" / "report.pdf")


def test_no_page_is_left_half_empty(pages):
    for page in pages[:-1]:
        height = len(page)
        body = page[int(TOP * height) : int((1 - BOTTOM) * height)]
        ink = np.flatnonzero((body < INK).any(axis=1))
        assert 1 - ink[-1] / len(body) < EMPTY


def test_the_last_page_holds_more_than_a_line(pages):
    """A title with its list at least: 3 % of a page is one line."""
    last = pages[-1]
    body = last[int(TOP * len(last)) : int((1 - BOTTOM) * len(last))]
    assert np.flatnonzero((body < INK).any(axis=1))[-1] / len(body) > 0.06


def test_no_ink_stands_in_the_margins(pages):
    for page in pages:
        side = int(0.9 * SIDE * page.shape[1])
        assert page[:, :side].min() > INK
        assert page[:, -side:].min() > INK
