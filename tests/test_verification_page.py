"""The page of what was verified: sections are measured, and written, one by one."""

import re
from pathlib import Path

from verification.document import claim_of, index_of, page, section, sections_of
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
    assert "3 numbers, 1 not as wanted.\n" in head


def test_a_section_says_what_measures_it_again_and_when_it_was():
    assert measured("one", True).endswith("Command: `measure one` (12 s, 2026-01-02).")


def test_the_index_has_each_section_with_its_claim_and_its_day():
    page_ = page([measured("one", True), measured("other", False)])
    head = page_.split("\n## ")[0].rstrip().splitlines()
    assert head[-2:] == [
        "| [one](#one) | It holds. | 0 of 1 | 2026-01-02 |",
        "| [other](#other) | It holds. | 1 of 1 | 2026-01-02 |",
    ]


def test_a_long_claim_is_cut_behind_a_sentence():
    """Behind one that has said something, and not behind an abbreviation."""
    setting = f"Of 1.5 kg | at most.{' On platforms' * 6} of Silva et al. as they print it."
    text = section(Result("one", f"{setting} More.", ()), "measure", 1.0, "2026-01-02")
    assert claim_of(text) == setting
    assert f"| {setting.replace('|', chr(92) + '|')} |" in index_of([text])


def test_the_page_of_the_repository_has_its_index():
    """So that one who edits the page by hand, or writes it with older code, is found."""
    text = (ROOT / "docs/verification.md").read_text()
    assert index_of(sections_of(text).values()) in text.split("\n## ")[0]


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
