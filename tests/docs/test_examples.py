"""The examples of README.md and docs/ run as they stand.

Every ```python block is executed, and every line `$ equipoise ...` of a ```console block, in the
order of the page, in one empty folder, with one namespace: a page may build on what it did before.
The first command of a page starts the program; those after it enter it by its door, in this
process, since a start takes seconds.
Code that is only to be read goes into a block of another kind (```text, ```toml, or none).
"""

import re
import shlex
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from equipoise.app.cli import run

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
FENCE = re.compile(r"^(?P<ticks>```+)(?P<kind>.*)$")


@dataclass(frozen=True)
class Block:
    kind: str
    line: int  # of its first line, from 1
    text: str


def blocks(page: str) -> list[Block]:
    """Return the fenced blocks of a page."""
    found: list[Block] = []
    ticks, kind, start, held = "", "", 0, []
    for number, line in enumerate(page.splitlines(), start=1):
        fence = FENCE.match(line)
        if not ticks and fence:
            ticks, kind, start, held = fence["ticks"], fence["kind"].strip(), number + 1, []
        elif ticks and line.rstrip() == ticks:
            found.append(Block(kind, start, "\n".join(held)))
            ticks = ""
        else:
            held.append(line)
    if ticks:
        raise ValueError(f"the block that starts at line {start} is never closed")
    return found


def commands(block: Block) -> list[tuple[int, list[str]]]:
    """Return line and words of every command a console block gives to equipoise."""
    return [
        (block.line + i, shlex.split(line.removeprefix("$ "), comments=True))
        for i, line in enumerate(block.text.splitlines())
        if line.startswith("$ equipoise")
    ]


def run_python(block: Block, name: str, namespace: dict[str, object]) -> None:
    padding = "\n" * (block.line - 1)  # so that a traceback names the line of the page
    exec(compile(padding + block.text, name, "exec"), namespace)


def as_a_program(words: list[str]) -> int:
    program = shutil.which(words[0], path=Path(sys.executable).parent)
    assert program, f"{words[0]} is not installed beside Python"
    return subprocess.run([program, *words[1:]], check=False).returncode


def run_console(given: list[tuple[int, list[str]]], name: str, started: bool) -> None:
    """Carry out commands; unless the page has started the program before, the first does."""
    for line, words in given:
        code = run(words[1:]) if started else as_a_program(words)
        started = True
        assert code == 0, f"{name}:{line}: exit {code}"


def has_examples(page: Path) -> bool:
    found = blocks(page.read_text(encoding="utf-8"))
    return any(b.kind == "python" or (b.kind == "console" and commands(b)) for b in found)


WITH_EXAMPLES = [page for page in PAGES if has_examples(page)]


@pytest.mark.skipif(not WITH_EXAMPLES, reason="no page has an example yet")
@pytest.mark.parametrize("page", WITH_EXAMPLES, ids=lambda p: p.relative_to(ROOT).as_posix())
def test_examples_run(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    name = page.relative_to(ROOT).as_posix()
    namespace: dict[str, object] = {"__name__": "__main__"}
    started = False
    for block in blocks(page.read_text(encoding="utf-8")):
        if block.kind == "python":
            run_python(block, name, namespace)
        elif block.kind == "console":
            given = commands(block)
            run_console(given, name, started)
            started = started or bool(given)


def test_blocks_are_found_with_their_lines():
    page = "Text\n```python\nx = 1\n```\n\n````\n```python\nnot run\n```\n````\n"
    assert blocks(page) == [
        Block("python", 3, "x = 1"),
        Block("", 7, "```python\nnot run\n```"),
    ]


def test_a_block_left_open_is_an_error():
    with pytest.raises(ValueError, match="starts at line 2 "):
        blocks("```python\nx = 1\n")


def test_only_lines_given_to_equipoise_are_commands():
    block = Block("console", 5, "$ cd there\n$ equipoise new 'my file.toml'  # a preset\nwrote it")
    assert commands(block) == [(6, ["equipoise", "new", "my file.toml"])]


@pytest.mark.parametrize("started", [False, True])
def test_a_command_that_fails_names_its_line(started):
    with pytest.raises(AssertionError, match=r"README\.md:7: exit 2"):
        run_console([(7, ["equipoise", "new", "sputnik"])], "README.md", started)


def test_a_failing_example_names_its_line():
    with pytest.raises(ZeroDivisionError) as caught:
        run_python(Block("python", 7, "x = 1\nx / 0"), "README.md", {})
    last = caught.traceback[-1]
    assert last.lineno + 1 == 8
