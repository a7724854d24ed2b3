"""Read a file's bytes or text, with a sentence for everything that can be wrong with it.

Only regular files are read: a pipe may never end, a device gives what nobody asked for.
"""

import os
import stat
from io import BufferedReader
from pathlib import Path

from equipoise.io.files.file_marks import binary_text
from equipoise.model.errors import InputError
from equipoise.model.units import MEGABYTE

TEXT_CONTROL = frozenset(b"\t\n\r\f")
MARKS = ((b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"))
PDF = b"%PDF-"  # begins as a text does
SAMPLE = 4096  # bytes examined to distinguish text from binary; chosen: several lines of any table
LARGEST = 64_000_000  # bytes of a document or a picture (chosen)
KINDS = (
    (stat.S_ISDIR, "a directory"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a disk"),
)


def open_bytes(path: str | Path, wanted: str) -> BufferedReader:
    """Return a regular file open for its bytes; ``wanted`` says what kind should be there."""
    file = Path(path)
    try:
        mode = file.stat().st_mode
        kind = next((name for is_kind, name in KINDS if is_kind(mode)), None)
        if kind is not None:
            raise InputError(str(path), kind, wanted)
        return file.open("rb")
    except FileNotFoundError as error:
        raise InputError(str(path), "no such file", wanted) from error
    except (OSError, ValueError) as error:  # a name with a zero in it is no OSError
        found = error.strerror if isinstance(error, OSError) else None
        raise InputError(str(path), found or str(error), wanted) from error


def size_of(file: BufferedReader) -> int:
    """Return how many bytes an open file has."""
    return os.fstat(file.fileno()).st_size


def read_bytes(path: str | Path, wanted: str, most: int = LARGEST) -> bytes:
    """Return the file's bytes; ``wanted`` says what kind of file should have been there.

    InputError if there are more than ``most``.
    """
    with open_bytes(path, wanted) as file:
        try:
            content = file.read(most + 1)
        except OSError as error:
            raise InputError(str(path), error.strerror or str(error), wanted) from error
    if len(content) > most:
        found = f"more than {most / MEGABYTE:g} MB"
        raise InputError(str(path), found, f"{wanted}, of {most / MEGABYTE:g} MB at most")
    if not content.strip():
        raise InputError(str(path), "an empty file", wanted)
    return content


def read_text(path: str | Path, wanted: str, most: int = LARGEST) -> str:
    """Return the file's text, as ``text_of`` reads it."""
    return text_of(read_bytes(path, wanted, most), path, wanted)


def text_of(content: bytes, path: str | Path, wanted: str) -> str:
    """Return the bytes as text: UTF-8 or UTF-16 by mark or by its zeros, else UTF-8, else Latin-1.

    InputError says what the bytes are if they are no text.
    """
    return decoded(content, encoding_of(content, path, wanted))


def encoding_of(beginning: bytes, path: str | Path, wanted: str) -> str:
    """Return the encoding of a text by its first bytes; InputError if they are no text's."""
    encoding = _encoding(beginning)
    if encoding == "utf-8" and _is_binary(beginning):
        raise InputError(str(path), binary_text(beginning), wanted)
    return encoding


def decoded(content: bytes, encoding: str) -> str:
    """Return the bytes as text in an encoding; those that are not UTF-8 are read as Latin-1."""
    if encoding.startswith("utf-16"):
        return content.decode(encoding, errors="replace")  # a cut file ends within a letter
    try:
        return content.decode(encoding)
    except UnicodeDecodeError:
        # Old instruments write a degree sign or a micro sign in an 8-bit code page; the columns
        # we read are plain ASCII, so Latin-1 reads every one of them.
        return content.decode("latin-1")


def _encoding(content: bytes) -> str:
    """Return the encoding that a text's mark states, else that of its zeros, else UTF-8."""
    marked = next((name for mark, name in MARKS if content.startswith(mark)), None)
    if marked is not None:
        return marked
    sample = content[:SAMPLE]
    halves = (("utf-16-le", sample[0::2], sample[1::2]), ("utf-16-be", sample[1::2], sample[0::2]))
    for name, letters, zeros in halves:
        if zeros and not any(zeros) and not _is_binary(letters):
            return name
    return "utf-8"


def _is_binary(content: bytes) -> bool:
    """Say whether bytes are no text: control characters occur that none has, or a PDF's mark."""
    if content.startswith(PDF):
        return True
    return any(byte < 32 and byte not in TEXT_CONTROL for byte in content[:SAMPLE])
