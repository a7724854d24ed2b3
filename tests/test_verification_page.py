"""The page of what was verified: sections are measured, and written, one by one."""

import re
from pathlib import Path

from verification.document import page, section, sections_of
from verification.result import Result, Row

ROOT = Path(__file__).parents[1]
CITED = re.compile(r"(?:`make verify`[,:]|verification\.md`,(?: section)?)((?:,? `\w+`)+)")
RUN = re.compile(r"`python -m verification (\w+)")


def measured(name: str, *found: bool) -> str:
    rows = tuple(Row(f"quantity {k} | {ok}", "1", "1", ok) for k, ok in enumerate(found))
    return section(Result(name, "It holds.", rows), f"measure {name}", 12.0, "2026-01-02")


def test_sections_come_back_as_they_were_written():
    one, other = measured("one", True, False), measured("other", True)
    text = page([one, other])
    assert sections_of(text) == {"one": one, "other": other}
    assert page(sections_of(text).values()) == text


def test_the_head_counts_the_numbers_of_all_sections():
    """Rows, not the words in them."""
    head = page([measured("one", True, False), measured("other", True)]).split("\n## ")[0]
    assert head.endswith("3 numbers, 1 not as wanted.\n")


def test_a_section_says_what_measures_it_again_and_when_it_was():
    assert measured("one", True).endswith("Command: `measure one` (12 s, 2026-01-02).")


def cited_sections() -> set[str]:
    """Return the measurements that README and the documents name as what shows a claim."""
    paths = (ROOT / "README.md", *(ROOT / "docs").glob("*.md"))
    text = "\n".join(path.read_text() for path in paths if path.name != "verification.md")
    listed = {name for names in CITED.findall(text) for name in names.split("`")[1::2]}
    return listed | set(RUN.findall(text))


def test_what_documents_cite_was_measured():
    """A claim that names a section of the page has it there."""
    cited = cited_sections()
    assert len(cited) > 30, cited
    assert cited <= set(sections_of((ROOT / "docs/verification.md").read_text())), cited
