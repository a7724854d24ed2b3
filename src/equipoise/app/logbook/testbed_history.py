"""How a platform was built over time: the testbed files of its runs, and what changed in them."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from datetime import datetime
from typing import cast

from equipoise.app.text.blocks import Blocks, Column, number, prose, table
from equipoise.app.text.json_lists import BUILDS
from equipoise.app.text.json_shape import View
from equipoise.io.documents.logbook import Logbook
from equipoise.model.logged_run import Build

NOTHING = "comments or layout alone"
NONE = "none"
COLUMNS = (prose("platform"), Column("build"), Column("first run"), Column("last run"),
           number("runs"), prose("changes since the previous one"))  # fmt: skip


def letters(book: Logbook) -> Mapping[tuple[str, str], str]:
    """Return a letter for each testbed file that a platform has had, in their order."""
    found: dict[tuple[str, str], str] = {}
    count: dict[str, int] = {}
    for build in book.builds():
        count[build.platform] = count.get(build.platform, 0) + 1
        found[build.platform, build.configuration] = lettered(count[build.platform])
    return found


def lettered(number: int) -> str:
    """Return A, B, ... Z, AA, AB, ... for 1, 2, ..."""
    letters = ""
    while number:
        number, last = divmod(number - 1, 26)
        letters = chr(ord("A") + last) + letters
    return letters


def builds_blocks(book: Logbook, shown: Sequence[Build]) -> Blocks:
    """Return a line for each testbed file, and in it what changed, line by line."""
    rows = (
        (build.platform, letter, _day(build.first), _day(build.last), str(build.runs),
         "\n".join(changes))
        for build, letter, changes in described(book, shown)
    )  # fmt: skip
    return (table("", COLUMNS, rows),)


def builds_json(book: Logbook, shown: Sequence[Build]) -> View:
    """Return the same, with each testbed file's text."""
    return BUILDS.write({"builds": [_build(book, *each) for each in described(book, shown)]})


def _build(book: Logbook, build: Build, letter: str, changes: Sequence[str]) -> View:
    return {
        "platform": build.platform,
        "build": letter,
        "configuration": build.configuration,
        "first_run": _time(build.first).isoformat(),
        "last_run": _time(build.last).isoformat(),
        "runs": build.runs,
        "changed": changes,
        "text": book.configuration(build.configuration),
    }


def described(book: Logbook, shown: Sequence[Build]) -> Iterator[tuple[Build, str, Sequence[str]]]:
    """Yield each build of those shown, its letter, what changed since the platform's one before."""
    before: dict[str, str] = {}
    wanted = {(build.platform, build.configuration): build for build in shown}
    for (platform, configuration), letter in letters(book).items():
        text = book.configuration(configuration)
        build, known = wanted.get((platform, configuration)), before.get(platform)
        if build is not None:
            yield build, letter, () if known is None else changed(known, text)
        before[platform] = text


def changed(before: str, after: str) -> Sequence[str]:
    """Return which values differ between two testbed files, as ``key: before -> after``."""
    old, new = (_values_of(text) for text in (before, after))
    lines = [f"{key}: {old.get(key, NONE)} -> {new.get(key, NONE)}"
             for key in dict.fromkeys((*old, *new)) if old.get(key) != new.get(key)]  # fmt: skip
    return lines or [NOTHING]


def _values_of(text: str) -> dict[str, str]:
    """Return the values of a testbed file by key; a run of elsewhere may hold what is none."""
    try:
        return dict(_values(tomllib.loads(text)))
    except (tomllib.TOMLDecodeError, RecursionError):
        return {"file": "not TOML"}


def _values(node: object, path: str = "") -> Iterator[tuple[str, str]]:
    """Yield key and text of each value; tables of a list go by their name, else by number."""
    if isinstance(node, dict):
        for key, below in cast("dict[str, object]", node).items():
            yield from _values(below, f"{path}.{key}" if path else key)
        return
    tables = cast("list[dict[str, object]]", node if _is_tables(node) else [])
    for k, each in enumerate(tables, 1):
        yield from _values(each, f"{path}.{each.get('name', k)}")
    if not tables:
        yield path, str(node)


def _is_tables(node: object) -> bool:
    return isinstance(node, list) and all(isinstance(x, dict) for x in cast("list[object]", node))


def _time(utc: float) -> datetime:
    return datetime.fromtimestamp(utc).astimezone()


def _day(utc: float) -> str:
    return f"{_time(utc):%Y-%m-%d %H:%M}"
