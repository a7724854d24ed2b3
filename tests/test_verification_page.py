"""The page of what was verified: sections are measured, and written, one by one."""

from verification.document import page, section, sections_of
from verification.result import Result, Row


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
