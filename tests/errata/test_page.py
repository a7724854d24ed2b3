"""`docs/errata.md` has every erratum that is cited, and says of each what shows it."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "errata.md"
ITEMS = ROOT / "src" / "equipoise" / "study" / "papers" / "items.py"  # has numbers of its own


def entries():
    rows = (line.strip("| ").split(" | ") for line in PAGE.read_text("utf-8").splitlines())
    return {row[0]: row for row in rows if re.fullmatch(r"[IRL]\d+", row[0])}


def spelled(text):
    """Return the numbers of 'I7-I11' or 'R14'."""
    first, *last = text.split("-")
    low, high = int(first[1:]), int((last or [first])[0][1:])
    return [f"{first[0]}{k}" for k in range(low, high + 1)]


def cited():
    """Return number and file of every erratum that a source or another page cites."""
    files = [*(ROOT / "src").rglob("*.py"), *(p for p in (ROOT / "docs").glob("*.md") if p != PAGE)]
    for path in files:
        if path == ITEMS:
            continue
        for found in re.findall(r"\b[IRL]\d{1,2}(?:-[IRL]\d{1,2})?\b", path.read_text("utf-8")):
            yield from ((number, path.name) for number in spelled(found))


def test_every_erratum_that_is_cited_is_on_the_page():
    known = entries()
    found = list(cited())
    assert len(found) > 20
    assert [pair for pair in found if pair[0] not in known] == []


def test_every_entry_says_what_shows_it():
    """A test by its name, which exists, or that it is seen by reading."""
    tests = "\n".join(p.read_text("utf-8") for p in (ROOT / "tests").rglob("test_*.py"))
    for number, row in entries().items():
        assert len(row) == 5, number
        shown = row[4]
        named = re.findall(r"`(test_\w+)`", shown)
        assert named or shown == "by reading", number
        for name in named:
            assert f"def {name}(" in tests, f"{number}: {name}"
