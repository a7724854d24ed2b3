"""A page for each command, from the texts that `--help` shows."""

import re
import sys
from collections.abc import Generator, Iterator
from contextlib import contextmanager

from equipoise.app.cli import GROUPS, app

PLACE = "reference/commands"
HEADING = re.compile(r"^## equipoise (\S+)$", re.MULTILINE)
HEAD = """# Commands

`equipoise COMMAND --help` shows the same texts. An option takes what stands behind it: `STR` a
text, `INT` and `FLOAT` a number, `PATH` a file or folder. `STR...` may be repeated.

| exit code | meaning |
|---|---|
| 0 | done; a verdict passed |
| 1 | done; a verdict failed, or the estimate is not usable |
| 2 | wrong use or unreadable input |
| 3 | unforeseen error; the message names the crash file |
| 129, 130, 143 | stopped by SIGHUP, Ctrl-C or SIGTERM, after an orderly halt |
"""


def command_pages() -> Iterator[tuple[str, str]]:
    """Yield each command's page and the list of them, by their paths in the site."""
    pages = dict(_described())
    for name, text in pages.items():
        yield f"{PLACE}/{name}.md", text
    yield f"{PLACE}/index.md", "\n".join([HEAD, *_listed()])


def _described() -> Iterator[tuple[str, str]]:
    """Yield name and page of each command."""
    with _named_equipoise():
        whole = app.generate_docs("markdown")
    places = list(HEADING.finditer(whole))
    ends = [*(place.start() for place in places[1:]), len(whole)]
    for place, end in zip(places, ends, strict=True):
        body = whole[place.end() : end].replace("**Parameters**:", "**Options**:")
        yield place[1], f"# equipoise {place[1]}\n{body.rstrip()}\n"


@contextmanager
def _named_equipoise() -> Generator[None]:
    """Let this program have the name that usage lines are to have: cyclopts takes the running's."""
    words, sys.argv = sys.argv, ["equipoise"]
    try:
        yield
    finally:
        sys.argv = words


def _listed() -> Iterator[str]:
    """Yield the list of commands, a section for each group of them."""
    names = {app[name].default_command: name for name in app if not name.startswith("-")}
    for title, commands in GROUPS.items():
        yield f"## {title}\n\n| command | purpose |\n|---|---|"
        for command in commands:
            name = names[command]
            purpose = (command.__doc__ or "").strip().splitlines()[0]
            yield f"| [`{name}`]({name}.md) | {purpose} |"
        yield "\n```{toctree}\n:hidden:\n"
        yield from (names[command] for command in commands)
        yield "```\n"
