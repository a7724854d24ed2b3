"""Results of many runs in a folder, written as they come, for a run that was ended to go on from.

    question.json           what was to be computed: testbed, options, version of the program
    results-xxxxxxxx.parquet    question, key, result; as many files as there were writings

A key is what a piece is known by, such as its seed; ``question`` is the digest of the question. A
file is written whole or not at all, and read with any other, in any order: files of several
computers may be put together. A key that is there twice counts once. A file that cannot be read
counts as not there, which is said, and stays as it is; so do rows of another question.

Results are written once a hundredth of the time that has passed is over again, between ``SOONEST``
and ``LONGEST``: so there are hundreds of files after an hour, and not millions.
"""

import hashlib
import json
import time
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from uuid import uuid4

from equipoise.app.engine.record_text import KINDS, Plain, plain, text_of, value_of
from equipoise.io.files.atomic_file import check_folder, write_whole
from equipoise.io.files.file_content import opened
from equipoise.io.formats.parquet_table import parquet_of_cells, read_parquet
from equipoise.model.errors import EquipoiseError, InputError
from equipoise.model.version import __version__

QUESTION = "question.json"
PATTERN = "results-*.parquet"
COLUMNS = ("question", "key", "result")
SHARE = 0.01  # of the time since the beginning, chosen: what is lost at most when it is ended
SOONEST, LONGEST = 0.1, 10.0  # s, chosen: a chunk; what a person would wait for again
PAIR = 2  # a key and its value
WHOLE = "a file of results of the same study"


class KeptResults:
    """The results of one question in a folder; ``key`` names a piece."""

    def __init__(
        self,
        folder: Path,
        question: Mapping[str, object],
        key: Callable[[Any], str],
        notice: Callable[[str], None],
    ) -> None:
        """Open the folder, or make it; InputError if its results are of another question.

        ``notice`` receives what is to be said of files that cannot be read.
        """
        self._folder, self._key, self._notice = folder, key, notice
        stated = {"version": __version__} | {k: plain(each) for k, each in question.items()}
        text = json.dumps(stated, indent=1)
        self._digest = hashlib.sha256(text.encode()).hexdigest()
        check_folder(folder)
        parquet_of_cells({"key": []}, str(folder))  # names the extra now, not after the first run
        folder.mkdir(parents=True, exist_ok=True)
        self._check(stated, folder / QUESTION, text)

    def _check(self, stated: Any, path: Path, text: str) -> None:
        """Write the question down, or compare it with the one that is there."""
        if not path.exists():
            write_whole(path, text)
        elif (before := path.read_text(encoding="utf-8")) != text:
            found = f"results of another study ({first_difference(json.loads(before), stated)})"
            raise InputError(str(self._folder), found, "the same study, or another folder")

    def found(self, pieces: Sequence[Any]) -> dict[int, Any]:
        """Return the results that are kept, by the index of their piece."""
        by_key = dict(self._rows())
        texts = {k: by_key[key] for k, key in enumerate(map(self._key, pieces)) if key in by_key}
        return {k: value_of(text) for k, text in texts.items()}

    def _rows(self) -> Iterator[tuple[str, str]]:
        """Yield keys and results of all files that can be read."""
        for path in sorted(self._folder.glob(PATTERN)):
            try:
                rows = list(_read(path))
            except EquipoiseError as error:
                self._notice(f"{error}; its results are computed again")
                continue
            yield from ((key, result) for question, key, result in rows if question == self._digest)

    @contextmanager
    def keeping(self) -> Generator[Callable[[Any, Any], None]]:
        """Lend what keeps a piece's result; at the end of the block all of them are on the disk."""
        waiting, began = list[tuple[str, str]](), time.monotonic()
        written = began

        def keep(piece: Any, result: Any) -> None:
            nonlocal written
            waiting.append((self._key(piece), text_of(result)))
            now = time.monotonic()
            if now - written >= min(max(SHARE * (now - began), SOONEST), LONGEST):
                self._write(waiting)
                written = time.monotonic()

        try:
            yield keep
        finally:
            self._write(waiting)

    def _write(self, waiting: list[tuple[str, str]]) -> None:
        """Write what waits into a file of its own."""
        if waiting:
            columns: dict[str, list[str]] = {
                "question": [self._digest] * len(waiting),
                "key": [key for key, _ in waiting],
                "result": [result for _, result in waiting],
            }
            path = self._folder / f"results-{uuid4().hex[:8]}.parquet"
            write_whole(path, parquet_of_cells(columns, str(path)))
            waiting.clear()


def _read(path: Path) -> Iterator[tuple[str, ...]]:
    """Yield the rows of a file; InputError for one that is none of results."""
    with opened(path, WHOLE) as content:
        table = read_parquet(content, str(path))
        if table.names != COLUMNS or table.cell is None:
            raise InputError(str(path), f"the columns {', '.join(table.names)}", WHOLE)
        for row in range(table.count):
            yield tuple(table.cell(name, row) for name in COLUMNS)


def first_difference(before: Plain, now: Plain, where: str = "") -> str:
    """Return where two questions differ first, and what stands there."""
    if isinstance(before, dict) and isinstance(now, dict) and before.keys() == now.keys():
        pairs = [(where + _part(key), before[key], now[key]) for key in before]
    elif isinstance(before, list) and isinstance(now, list) and len(before) == len(now):
        place = where + (_key(now) if _key(before) == _key(now) else "")
        pairs = [(place, b, n) for b, n in zip(before, now, strict=True)]
    else:
        return f"{where.strip()}: {before} there, {now} here"
    return next(first_difference(b, n, place) for place, b, n in pairs if b != n)


def _part(key: str) -> str:
    """Return a key as a part of a place; a kind of content is none."""
    return "" if key in KINDS else f" {key}"


def _key(content: list[Plain]) -> str:
    """Return the key of a pair of key and value, as a part of a place; nothing of another list."""
    first = content[0] if len(content) == PAIR else None
    return f" {first}" if isinstance(first, str) and ":" not in first else ""
