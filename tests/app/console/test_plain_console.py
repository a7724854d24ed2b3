"""Whatever is printed is text: names are shown as they are written, styles are the program's."""

import ast
import re
from pathlib import Path

import pytest
from rich.console import Group
from rich.spinner import Spinner
from rich.table import Table
from rich.text import Text

from equipoise.app.console import terminal
from equipoise.app.console.plain_console import PlainConsole, shown
from equipoise.app.console.rich_blocks import renderable
from equipoise.app.text import blocks

PACKAGE = Path(__file__).parents[3] / "src" / "equipoise"
STYLING = re.compile(r"\x1b\[[\d;]*m")  # colours and the like, nothing else
HOSTILE = "run [red]a[/red] [link=http://x]b[/link] :smile: [/] \x1b]0;t\x07 \u202e\x9b\r\b"
SHOWN = r"run [red]a[/red] [link=http://x]b[/link] :smile: [/] \x1b]0;t\x07 \u202e\x9b\x0d\x08"


@pytest.fixture
def console():
    return PlainConsole(width=200, color_system="truecolor", force_terminal=True)


def table_of(text):
    grid = Table(title=text)
    grid.add_column(text)
    grid.add_row(text)
    return grid


@pytest.mark.parametrize(
    "of",
    [str, shown, table_of, lambda text: Group(text, shown(text)),
     lambda text: renderable(blocks.Paragraph(text)),
     lambda text: renderable(blocks.table(text, [blocks.Column(text)], [[text]], [text]))],
)  # fmt: skip
def test_a_name_is_shown_as_it_is_written(console, of):
    with console.capture() as captured:
        console.print(of(HOSTILE))
    printed = STYLING.sub("", captured.get())
    assert SHOWN in printed
    assert not {"\x1b", "\x07", "\u202e", "\x9b", "\r", "\b"} & set(printed)


def test_a_text_that_went_round_the_maker_of_texts_acts_no_more(console):
    with console.capture() as captured:
        console.print(Text("a\x1b]0;t\u202eb"))
    assert captured.get() == "a\\x1b]0;t\\u202eb\n"


def test_the_styles_of_the_program_still_work(console):
    with console.capture() as captured:
        console.print(shown("a", "bold"), "b")
    assert captured.get() == "\x1b[1ma\x1b[0m b\n"


def test_progress_lines_read_no_markup(capsys):
    """``[/red]`` ended the program, a brace too: the text was markup, and a format."""
    with terminal.busy(HOSTILE), terminal.counted("a {x} [/red]") as progress:
        progress(0.5)
    err = capsys.readouterr().err
    assert SHOWN in err
    assert "a {x} [/red] ..." in err
    with terminal.counted_pieces("[/red]") as report:
        report(1, 2)


def test_a_complaint_is_one_line_of_text(capsys):
    terminal.complain(f"{HOSTILE}\nnext\u2028")
    assert capsys.readouterr().err == f"equipoise: {SHOWN} next\\u2028\n"


# --- One maker of consoles, and nothing that reads markup ----------------------------------------

MARKUP_READERS = {"from_markup", "render_markup", "from_ansi"}


def calls(path: Path) -> set[str]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    found = {node.func for node in ast.walk(tree) if isinstance(node, ast.Call)}
    return {f.id if isinstance(f, ast.Name) else getattr(f, "attr", "") for f in found}


@pytest.fixture(scope="module")
def called() -> dict[str, set[str]]:
    return {p.relative_to(PACKAGE).as_posix(): calls(p) for p in PACKAGE.rglob("*.py")}


def test_one_module_makes_consoles(called):
    makers = {path for path, names in called.items() if {"Console", "PlainConsole"} & names}
    assert makers == {"app/console/terminal.py"}


def test_nothing_reads_markup(called):
    assert {path for path, names in called.items() if MARKUP_READERS & names} == set()
    sources = [p.read_text(encoding="utf-8") for p in PACKAGE.rglob("*.py")]
    assert [text for text in sources if "markup=True" in text] == []


def test_one_module_prints_and_reads_answers(called):
    raw = {path for path in called if any(is_print(node) for node in nodes(path))}
    assert raw == {"app/console/terminal.py"}


def nodes(path: str):
    return ast.walk(ast.parse((PACKAGE / path).read_text(encoding="utf-8")))


def is_print(node: ast.AST) -> bool:
    """Say whether a node is a call of Python's own print, or a use of a bare stream."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        return node.func.id in ("print", "input")
    return isinstance(node, ast.Attribute) and node.attr == "write" and is_stream(node.value)


def is_stream(node: ast.AST) -> bool:
    return isinstance(node, ast.Attribute) and node.attr in ("stdout", "stderr", "__stderr__")


def test_a_bare_stream_is_found():
    tree = ast.parse("sys.stderr.write('x')\nprint(1)\nconsole.print(1)\nself._print(1)")
    assert sum(map(is_print, ast.walk(tree))) == 2


@pytest.mark.parametrize("text", ["", "a", "a\nb"])
def test_spinners_keep_their_text(console, text):
    with console.capture() as captured:
        console.print(Spinner("line", text=shown(text)))
    assert text in captured.get()
