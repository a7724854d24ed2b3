"""What leaves is visible and acts nowhere: no medium runs it, and nothing of it is lost."""

import html
import json
import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from equipoise.app.text.csv_lines import csv_lines
from equipoise.app.text.escaping import (
    for_csv_cell,
    for_figure,
    for_file_name,
    for_html,
    for_json,
    for_one_line,
    for_terminal,
    for_typst,
)

ACTING = ("Cc", "Cf", "Cs", "Zl", "Zp")


def acts(letter: str) -> bool:
    return letter not in "\n\t" and unicodedata.category(letter) in ACTING


@given(st.text(st.characters()))
def test_no_text_acts_on_a_terminal(text):
    shown = for_terminal(text)
    assert not any(map(acts, shown))
    shown.encode()  # no lone surrogate is left


@given(st.text(st.characters(exclude_categories=("C", "Z"), include_characters=" \n\t")))
def test_visible_texts_stay_as_they_are(text):
    assert for_terminal(text) == text


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("\x1b]0;owned\x07", r"\x1b]0;owned\x07"),
        ("a\u202eb", r"a\u202eb"),
        ("a\u200bb", r"a\u200bb"),
        ("a\u2028b", r"a\u2028b"),
        ("a\x9bb", r"a\x9bb"),
        ("a\rb", r"a\x0db"),
        ("a\0b", r"a\x00b"),
        ("\U000e0041", r"\U000e0041"),
        ("\udcff", r"\xff"),  # a byte of a file's name that is no UTF-8
        ("12\u00a0µm, [red]\tü\n", "12\u00a0µm, [red]\tü\n"),
    ],
)
def test_what_is_not_visible_becomes_an_escape(text, shown):
    assert for_terminal(text) == shown


def test_no_separator_of_lines_is_taken_for_a_space():
    assert for_one_line("a\u2028b\x85c \n d") == r"a\u2028b\x85c d"


@given(st.dictionaries(st.text(), st.text()))
def test_json_means_the_same_and_is_visible(values):
    text = for_json(json.dumps(values, ensure_ascii=False, indent=1))
    assert json.loads(text) == values
    assert not any(map(acts, text))


@pytest.mark.parametrize(
    "cell",
    ["=cmd|'/c calc'!A1", "+1+1", "-1+1", "@SUM(A1)", "\tx", "\rx", " =1", "＝1+1", "-a"],  # noqa: RUF001
)
def test_a_cell_that_a_spreadsheet_would_run_is_quoted(cell):
    assert for_csv_cell(cell) == "'" + for_terminal(cell)


@pytest.mark.parametrize("cell", ["-1.5", "+2e-3", "-.5", "1e5", "-inf", -1.5, None, 3, "a=b", ""])
def test_numbers_and_plain_texts_stay(cell):
    assert for_csv_cell(cell) == cell


def test_tables_of_runs_are_quoted():
    assert csv_lines(["=a", "b"], [["@x", -1.0]]) == "'=a,b\n'@x,-1.0\n"


@given(st.text())
def test_no_text_is_markup_in_html(text):
    written = for_html(text)
    assert not set("<>\"'") & set(written)
    assert html.unescape(written) == for_terminal(text)


def test_typst_gets_visible_texts_at_any_depth():
    found = for_typst({"a": ["\x1b", ("\0", 1)], "b": {"c": "#eval"}})
    assert found == {"a": [r"\x1b", [r"\x00", 1]], "b": {"c": "#eval"}}


def test_a_dollar_sign_begins_no_formula_in_a_figure():
    assert for_figure("a $\\frac{ $\nb") == "a \\$\\frac{ \\$ b"


@given(st.text(st.characters()))
def test_a_name_is_one_part_of_a_path(text):
    name = for_file_name(text)
    assert name
    assert not set("/\\:\0") & set(name)
    assert not name.startswith((".", "-"))
    assert not name.endswith(".")
    assert len(name) <= 40


@pytest.mark.parametrize(
    ("name", "plain"),
    [("../../x", "x"), ("..", "platform"), ("", "platform"), ("con", "platform"),
     ("nul.txt", "platform"), ("Sputnix mock-up", "sputnix-mock-up"), ("Käfer 3.1", "käfer-3.1")],
)  # fmt: skip
def test_names_of_files(name, plain):
    assert for_file_name(name) == plain
