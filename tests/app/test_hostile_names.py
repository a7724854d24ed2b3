"""Every option of every command repeats what it is given, and nothing of that acts.

Names are written by others: files, columns, testbeds. At a terminal they are visible, whole and
without effect; in a table no cell is a formula, in a page nothing is an element.
"""

import csv
import html
import re
from collections.abc import Iterator

import pypdfium2
import pytest

from equipoise.app.cli import GROUPS, app
from tests.support import thorough

COMMANDS = [command for commands in GROUPS.values() for command in commands]
NAME = "[red]a[/red] [link=x]b[/link] :smile: \x1b]0;t\x07\u202e\u200b\x9b=1"
SHOWN = r"[red]a[/red] [link=x]b[/link] :smile: \x1b]0;t\x07\u202e\u200b\x9b=1"
ACTING = set(map(chr, (*range(9), *range(11, 32), *range(127, 160)))) | set("\u202e\u200b\u2028")
# A file may have any letter but a slash and NUL; a testbed's name none that is not visible.
FILE = "=1 [red]a[link=x]b \x1b]0;t\x07\u202e"
FILE_SHOWN = r"=1 [red]a[link=x]b \x1b]0;t\x07\u202e"
MARKUP = "[red]a[/red] [link=x]b[/link] <script>c</script> #eval(1) $d @e =f ../../g"
PAGE = re.compile(r"<script>c|data:text|onerror=")
# What the other arguments of a command are, so that the one in question is what is wrong.
GIVEN = {"LANGUAGE": "c", "--method": "ekf_9", "--law": "pid", "TESTBED": "sputnix",
         "FILE": "run.csv", "SOURCE": "run.csv", "--testbed": "sputnix",
         "--out": "taken/x", "SHOWN": "run.csv", "OUT": "taken/x.csv", "RUN": "taken",
         "PAPER": "none", "--to": "urdf"}  # fmt: skip


def words_of() -> Iterator[tuple[str, ...]]:
    """Yield a command line for each argument of each command that takes a word."""
    for name in app:
        if name.startswith("-") or app[name].default_command not in COMMANDS:
            continue
        every = list(app[name].assemble_argument_collection())
        yield name, "--none", NAME
        for each in every:
            if each.hint is not bool and each.names and each.names[0] != "*":
                needed = [e for e in every if e.required and e is not each]
                yield (
                    name,
                    *(word for e in needed for word in given(e, GIVEN[e.names[0]])),
                    *given(each, f"taken/{NAME}" if "Path" in str(each.hint) else NAME),
                )


def given(argument, value: str) -> tuple[str, ...]:
    name = argument.names[0]
    return (name, value) if name.startswith("-") else (value,)


LINES = list(words_of())
SOME = thorough.some(LINES, 150)


def test_every_command_is_tried():
    assert len({words[0] for words in LINES}) == len(COMMANDS)
    assert len(LINES) > 200


@pytest.mark.parametrize("words", SOME, ids=[f"{words[0]} {k}" for k, words in enumerate(SOME)])
def test_what_an_option_is_given_is_shown_and_does_nothing(equipoise, tmp_path, free_file, words):
    (tmp_path / "taken").write_text("")
    (tmp_path / "run.csv").write_bytes(free_file.read_bytes())
    done = equipoise(*words)
    assert done.code in (0, 1, 2)
    assert not ACTING & set(done.out + done.err)
    if done.code == 2:
        assert done.err.splitlines()[-1].startswith("equipoise: ")
        assert "[red]" not in done.err or SHOWN[:16] in done.err  # cyclopts cuts some short


@pytest.mark.parametrize("text", ["", "a..b", "x" * 64 + ".y", "\0", "ü"])
def test_an_address_that_is_none_is_refused(equipoise, text):
    done = equipoise("dashboard", "sputnix", "--expose", text)
    assert done.code == 2
    assert "--expose" in done.err


# --- What is done with such names, to its end ----------------------------------------------------


@pytest.fixture
def named(equipoise, tmp_path, record_file):
    """Return the names of a testbed and a recording; both mean to do something."""
    made = equipoise("new", "sputnix", "--out", "bed.toml")
    assert made.code == 0
    text = (tmp_path / "bed.toml").read_text(encoding="utf-8")
    bed = f"{FILE} bed.toml"
    (tmp_path / bed).write_text(text.replace("Sputnix mock-up", MARKUP), encoding="utf-8")
    recording = f"{FILE} run.csv"
    (tmp_path / recording).write_bytes(record_file.read_bytes())
    return bed, recording


DONE = {
    "simulate": ("simulate", "BED", "--out", f"{FILE}.csv", "--duration-s", "5"),
    "new": ("new", "sputnix", "--out", f"{FILE}.toml"),
    "inspect": ("inspect", "RECORD", "--testbed", "BED", "--figure", f"{FILE}.svg"),
    "import": ("import", "RECORD", "--testbed", "BED"),
    "observe": ("observe", "RECORD", "--testbed", "BED"),
    "ledger": ("ledger", "RECORD", "--testbed", "BED", "--out", f"{FILE} out"),
    "identify": ("identify", "RECORD", "--testbed", "BED", "--out", f"{FILE} out"),
    "assess": ("assess", "RECORD", "--testbed", "BED", "--json"),
    "convert": ("convert", "RECORD", f"{FILE} out.csv"),
    "calibrate": ("calibrate", "--moves", "--testbed", "BED"),
}


@pytest.mark.parametrize("words", DONE.values(), ids=DONE.keys())
def test_work_on_such_files_shows_their_names_and_does_nothing(equipoise, tmp_path, named, words):
    given = dict(zip(("BED", "RECORD"), named, strict=True))
    done = equipoise(*(given.get(word, word) for word in words))
    assert (done.code in (0, 1), done.err) == (True, done.err)
    assert not ACTING & set(done.out + done.err)
    assert "[red]" not in done.out or FILE_SHOWN in done.out or "--json" in words
    for path in (p for p in tmp_path.rglob("*") if p.suffix in (".html", ".json", ".svg", ".csv")):
        text = path.read_text(encoding="utf-8")
        assert not ACTING & set(text)
        assert path.suffix not in (".html", ".svg") or not PAGE.search(text)


COLUMNS = ("=cmd|'/c calc'!A1", "[/red]\x1b]0;t\x07", "mass_[red]\u202e_mm", "wheel_$\\frac{_rad_s",
           "cmd_{x}\x9b")  # fmt: skip


@pytest.mark.parametrize("command", ["inspect", "import", "identify", "observe", "convert"])
@pytest.mark.parametrize("native", [True, False])
def test_names_of_columns_are_shown_and_do_nothing(equipoise, tmp_path, free_file, command, native):
    """Whether they are read, reported as unread, or refused."""
    rows = list(csv.reader(free_file.read_text().splitlines()[:200]))
    head = rows[0] if native else [f"[bold]{name}\x1b[31m" for name in rows[0]]
    with (tmp_path / "odd.csv").open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow((*head, *COLUMNS))
        table.writerows((*row, *(k * 0.01 for _ in COLUMNS)) for k, row in enumerate(rows[1:]))
    more = {"inspect": ("--figure", "a.svg"), "import": (), "convert": ("out.csv",)}
    done = equipoise(command, "odd.csv", *more.get(command, ("--testbed", "sputnix")))
    assert done.code in (0, 1, 2)
    assert not ACTING & set(done.out + done.err)


def test_a_kept_run_has_its_names_in_page_paper_list_and_table(
    equipoise, tmp_path, named, monkeypatch
):
    monkeypatch.setenv("EQUIPOISE_RUNS", "runs")
    bed, recording = named
    assert equipoise("identify", recording, "--testbed", bed).code == 0
    (folder,) = (tmp_path / "runs").glob("*/*")
    assert re.fullmatch(r"[\w.-]+", folder.name)
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert html.escape(MARKUP) in page
    assert html.escape(FILE_SHOWN) in page
    pages = pypdfium2.PdfDocument((folder / "report.pdf").read_bytes())
    paper = "".join(each.get_textpage().get_text_range() for each in pages)
    for text in (page, paper):
        assert not ACTING & set(text.replace("\r", "").replace("\u200b", ""))
    for word in MARKUP.split():
        assert word in paper.replace("\ufffe", "").replace("\u200b", "")
    assert equipoise("report", folder).code == 0
    assert (folder / "report.html").read_text(encoding="utf-8") == page
    listed = equipoise("logbook", "runs", "--export", "runs.csv")
    assert (listed.code, listed.err) == (0, "")
    for word in MARKUP.split():
        assert word in listed.out
