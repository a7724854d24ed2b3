"""A text cut into blocks of whole lines, so that a long one is never in memory as a whole."""

import codecs
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from equipoise.io.files.file_content import Content
from equipoise.io.files.source_file import MARKS, decoded, encoding_of
from equipoise.model.errors import InputError

FIRST = 1 << 16  # bytes of the block that shows what a text is (chosen)
BLOCK = 1 << 20  # bytes of each of the others (chosen: as rows of cells they take 10 MB)
LONGEST = 1 << 20  # bytes of a line, as of a cell (chosen)


@dataclass(frozen=True, slots=True)
class Text:
    """A text in blocks of whole lines."""

    blocks: Callable[[], Iterator[str]]  # each call begins it anew
    size: int  # bytes

    @classmethod
    def of(cls, text: str) -> "Text":
        """Return a text in memory, as one block."""
        return cls(lambda: iter([text]), len(text))

    def watched(self, on_progress: Callable[[float], None]) -> "Text":
        """Return it, which says as its blocks are read what share of it that is."""

        def blocks() -> Iterator[str]:
            done = 0
            for block in self.blocks():
                yield block
                done += len(block)
                on_progress(min(done / self.size, 1.0))

        return Text(blocks, self.size)

    def lines(self) -> Iterator[str]:
        """Yield its lines."""
        return (line for block in self.blocks() for line in block.splitlines())

    def first_lines(self) -> list[str]:
        """Return the lines of its first block."""
        return next(self.blocks(), "").splitlines()


def text_in(content: Content, path: Path, wanted: str) -> Text:
    """Return a file's text; InputError if it is none."""
    beginning = content[:FIRST]
    encoding = encoding_of(beginning, path, wanted)
    mark = next((mark for mark, _ in MARKS if beginning.startswith(mark)), b"")
    plain = encoding.replace("-sig", "")
    if plain == "utf-16":
        plain += "-le" if mark == b"\xff\xfe" else "-be"

    def blocks() -> Iterator[str]:
        pieces = _pieces(content, len(mark))
        if plain != "utf-8":
            pieces = _recoded(pieces, plain)
        return (decoded(each, "utf-8") for each in _whole_lines(pieces, str(path)))

    return Text(blocks, len(content))


def _pieces(content: Content, begin: int) -> Iterator[bytes]:
    """Yield the bytes of a file from a place on, few at first."""
    at, size = begin, FIRST
    while at < len(content):
        content.meter.check(size)
        yield content[at : at + size]
        at, size = at + size, BLOCK


def _recoded(pieces: Iterator[bytes], encoding: str) -> Iterator[bytes]:
    """Yield a text of another encoding as UTF-8, where no byte of a letter looks like a line's end.

    A cut file ends within a letter.
    """
    decoder = codecs.getincrementaldecoder(encoding)(errors="replace")
    for piece in pieces:
        yield decoder.decode(piece).encode(errors="surrogatepass")
    yield decoder.decode(b"", final=True).encode()


def _whole_lines(pieces: Iterator[bytes], source: str) -> Iterator[bytes]:
    """Yield bytes that end with a line; InputError for a line that has no end."""
    rest, before = b"", 0
    for piece in pieces:
        held = rest + piece
        end = _end_of_lines(held)
        if len(held) - end > LONGEST:
            line = before + held.count(b"\n", 0, end) + 1
            found = f"more than {LONGEST} bytes without a line end"
            raise InputError(f"{source}, line {line}", found, "a row of separated cells")
        rest = held[end:]
        before += held.count(b"\n", 0, end)
        if end:
            yield held[:end]
    if rest:
        yield rest


def _end_of_lines(held: bytes) -> int:
    """Return where the last whole line ends; a CR may be half of a line's end."""
    return held.rfind(b"\n") + 1 or held.rfind(b"\r", 0, max(len(held) - 1, 0)) + 1
