"""The documents are written in the field's English: no private words, no long sentences.

Read are README.md, CONTRIBUTING.md, SECURITY.md and the pages of docs/, but for
``docs/verification.md``, which the checks write. Fenced blocks, code spans and quotations are left
out of the words. A code span counts as one word of a sentence, a formula's single letters as none.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.docs.test_examples import FENCE, PAGES, ROOT

WRITTEN_BY_CODE = ROOT / "docs" / "verification.md"
EDITED = [page for page in PAGES if page != WRITTEN_BY_CODE]
EDITED += [ROOT / "CONTRIBUTING.md", ROOT / "SECURITY.md"]

# chosen: words that English uses otherwise, or no longer, in technical prose.
PRIVATE = re.compile(
    r"\b(told|felt|heard|believed|beliefs?|candour|lone|strangers?|beforehand|anew|nobody|somebody"
    r"|amid|unasked|begun|seeks?|sought|leaves aside|to and fro|mend(?:s|ed|ing)?|hither"
    r"|as it were|ought)\b",
    re.IGNORECASE,
)

LONGEST = 35  # chosen: words of a sentence that no page exceeds
LONG, LONG_SHARE = 25, 0.05  # chosen: of a page's sentences, one, or one in twenty, is longer
MEAN = 18.0  # chosen: words of a sentence, mean of a page's running text

SPAN = re.compile(r"(`+)(.+?)\1")
LINK = re.compile(r"!?\[([^\]]*)\]\([^)]*\)")
QUOTED = re.compile(r'"[^"]*"')
ITEM = re.compile(r"^\s*(?:[-*+]|\d+\.)\s+")
WORD = re.compile(r"[^\W\d_]{2,}(?:[-'][^\W\d_]+)*|\b[aAI]\b")
ABBREVIATED = re.compile(r"\b(Eqs?|Figs?|Tab|No|vs|al|approx|ca|cf|resp|e\.g|i\.e)\.$")
END = re.compile(r"(?<!\.\.)[.!?](?:(?=\s)|[\")']+(?=\s+[A-Z(`]))")


@dataclass(frozen=True)
class Passage:
    """A paragraph, an item of a list, a cell of a table or a heading."""

    text: str
    kind: str  # "text", "cell" or "heading"


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", SPAN.sub(escaped, line))[1:-1]]


def escaped(span: re.Match[str]) -> str:
    return re.sub(r"(?<!\\)\|", r"\\|", span[0])


def outside_fences(page: str) -> Iterator[str]:
    ticks = ""
    for line in page.splitlines():
        fence = FENCE.match(line.strip())
        if fence and not ticks:
            ticks = fence["ticks"]
            yield ""
        elif ticks and line.strip() == ticks:
            ticks = ""
        elif not ticks:
            yield line


def passages(page: str) -> list[Passage]:
    """Return the prose of a page; the lines of a paragraph or an item are joined."""
    found: list[Passage] = []
    held: list[str] = []

    def close() -> None:
        if held:
            found.append(Passage(" ".join(held), "text"))
            held.clear()

    for line in outside_fences(re.sub(r"<!--.*?-->", "", page, flags=re.DOTALL)):
        if not line.strip() or line.startswith(("#", "|")) or ITEM.match(line):
            close()
        if line.startswith("#"):
            found.append(Passage(line.lstrip("# "), "heading"))
        elif line.startswith("|"):
            found.extend(Passage(cell, "cell") for cell in cells(line) if set(cell) - set("-: "))
        elif line.strip():
            held.append(ITEM.sub("", line).strip())
    close()
    return found


def plain(text: str) -> str:
    """Return a passage without marks; code spans become one word, links their text."""
    return LINK.sub(r"\1", SPAN.sub("Code", text)).replace("*", "")


def sentences(passage: Passage) -> list[str]:
    """Return the sentences of a passage; an entry of a cell's enumeration counts as one."""
    text, found, start = plain(passage.text), [], 0
    for end in END.finditer(text):
        if not ABBREVIATED.search(text[: end.start() + 1]):
            found.append(text[start : end.end()].strip())
            start = end.end()
    found.append(text[start:].strip())
    if passage.kind == "cell":
        found = [entry.strip() for each in found for entry in each.split(";")]
    return [each for each in found if WORD.search(each)]


def length(sentence: str) -> int:
    return len(WORD.findall(sentence))


def private_words(page: str) -> list[str]:
    """Return the words of a page that may not stand there, each with its surroundings."""
    texts = [QUOTED.sub('""', SPAN.sub("Code", passage.text)) for passage in passages(page)]
    return [
        text[max(found.start() - 30, 0) : found.end() + 30]
        for text in texts
        for found in PRIVATE.finditer(text)
    ]


def of_page(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def prose(path: Path) -> list[tuple[str, str]]:
    """Return kind and text of every sentence of a page, but for its headings."""
    found = [each for each in passages(of_page(path)) if each.kind != "heading"]
    return [(passage.kind, each) for passage in found for each in sentences(passage)]


each_page = pytest.mark.parametrize(
    "path", EDITED, ids=lambda path: path.relative_to(ROOT).as_posix()
)


@each_page
def test_a_page_has_no_private_word(path):
    assert private_words(of_page(path)) == []


@each_page
def test_no_sentence_is_longer_than_a_breath(path):
    assert [each for _, each in prose(path) if length(each) > LONGEST] == []


@each_page
def test_few_sentences_are_long(path):
    found = [each for _, each in prose(path)]
    long = [each for each in found if length(each) > LONG]
    assert len(long) <= max(1, LONG_SHARE * len(found)), long


@each_page
def test_the_mean_sentence_is_short(path):
    """Cells of tables do not count: they would only lower the mean."""
    lengths = [length(each) for kind, each in prose(path) if kind == "text"]
    assert not lengths or sum(lengths) / len(lengths) < MEAN


def test_a_page_is_divided_into_passages():
    page = (
        "# Of it\n\nTwo lines\nof text.\n\n```text\ntold\n```\n- one\n  item\n- two\n\n"
        "| a | `b|c` |\n|---|---|\n| d; e | |\n"
    )
    assert passages(page) == [
        Passage("Of it", "heading"),
        Passage("Two lines of text.", "text"),
        Passage("one item", "text"),
        Passage("two", "text"),
        Passage("a", "cell"),
        Passage("`b\\|c`", "cell"),
        Passage("d; e", "cell"),
    ]


@pytest.mark.parametrize(
    "found",
    [
        ["See Eq. 2.2 of S.", "It has 3.5 mm.", "typst is one wheel."],
        ['He asks "Is it level?" and waits.', "(So do we.)"],
        ["Ivanov et al. 2021 has no link."],
        [],
    ],
)
def test_sentences_end_where_a_reader_stops(found):
    assert sentences(Passage(" ".join(found), "text")) == found


def test_marks_and_links_are_no_words():
    text = "See [the page](https://a.b/c) for `x = 1`: **all** of it."
    assert sentences(Passage(text, "text")) == ["See the page for Code: all of it."]
    assert sentences(Passage("1 = 2", "text")) == []


def test_words_are_counted_without_the_letters_of_a_formula():
    assert length("Here H = J w + h is the angular momentum of a body-fixed frame.") == 9


def test_a_private_word_is_found_in_prose_alone():
    page = 'We seek it.\n\n`seek` and "nobody" are quoted.\n\n| Felt | x |\n\n```text\nanew\n```\n'
    assert private_words(page) == ["We seek it.", "Felt"]
