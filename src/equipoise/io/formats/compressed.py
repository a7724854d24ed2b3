"""A recording in a compressed file: gzip (RFC 1952), zip (PKWARE's APPNOTE), Zstandard (RFC 8878).

What is inside is one file, whose name and bytes say what it is. zstandard is an extra, imported
when such a file is met and not before.
"""

import gzip
import zipfile
from collections.abc import Iterator
from io import BufferedIOBase
from pathlib import Path, PurePosixPath
from typing import IO

from equipoise.io.files.broken_bytes import as_broken
from equipoise.io.files.file_content import Content
from equipoise.model.errors import InputError
from equipoise.model.optional_libraries import extra_library

GZIP, ZIP, ZSTD = b"\x1f\x8b", b"PK\x03\x04", b"\x28\xb5\x2f\xfd"
KINDS = {GZIP: "gzip", ZIP: "zip", ZSTD: "Zstandard"}
SUFFIXES = (".gz", ".zip", ".zst")
CHUNK = 4096  # bytes handed to Zstandard at once (chosen: they unpack to 0.2 GB at most)
PIECE = 1 << 20  # bytes that are unpacked at once of the others (chosen)
LISTED = 12  # files of an archive that an error names (chosen)


def unpacked(content: Content, path: Path, suffixes: tuple[str, ...]) -> tuple[str, bytes]:
    """Return name and bytes of the file inside one that begins with a mark of ``KINDS``.

    ``suffixes`` are those of recordings: other files of an archive are ignored if one has such.
    InputError if the file is broken, unpacks to too much, or holds several.
    """
    kind = next(name for mark, name in KINDS.items() if content.startswith(mark))
    with as_broken(str(path), f"{kind} file", f"a whole {kind} file: copy it again"):
        return _unpacked(content, path, suffixes)


def _unpacked(content: Content, path: Path, suffixes: tuple[str, ...]) -> tuple[str, bytes]:
    if content.startswith(ZIP):
        return _member(content, str(path), suffixes)
    name = path.stem if path.suffix.lower() in SUFFIXES else path.name
    if content.startswith(ZSTD):
        return name, _counted(_of_frames(content, str(path)), content)
    with gzip.GzipFile(fileobj=content.from_start()) as file:
        return name, _counted(_pieces(file), content)


def _counted(pieces: Iterator[bytes], content: Content) -> bytes:
    """Return pieces as one; InputError as soon as they are too much."""
    whole = bytearray()
    for piece in pieces:
        content.meter.take(2 * len(piece))  # here, and as bytes in the end
        whole += piece
    return bytes(whole)


def _pieces(file: BufferedIOBase | IO[bytes]) -> Iterator[bytes]:
    return iter(lambda: file.read(PIECE), b"")


def _member(content: Content, source: str, suffixes: tuple[str, ...]) -> tuple[str, bytes]:
    """Return the one file of an archive that can be a recording."""
    with zipfile.ZipFile(content.from_start()) as archive:
        names = [each.filename for each in archive.infolist() if not _is_aside(each)]
        fitting = [name for name in names if PurePosixPath(name).suffix.lower() in suffixes]
        found = fitting or names
        if len(found) != 1:
            raise InputError(source, _listed(found), "one recording: unpack the one you want")
        with archive.open(found[0]) as file:
            return found[0], _counted(_pieces(file), content)


def _is_aside(member: zipfile.ZipInfo) -> bool:
    """Say whether a member is a folder, or what an operating system put beside the files."""
    place = PurePosixPath(member.filename)
    return member.is_dir() or place.name.startswith(".") or "__MACOSX" in place.parts


def _listed(names: list[str]) -> str:
    if not names:
        return "a zip archive without a file in it"
    more = f" and {len(names) - LISTED} more" if len(names) > LISTED else ""
    return f"{len(names)} files in a zip archive: {', '.join(names[:LISTED])}{more}"


def _of_frames(content: Content, source: str) -> Iterator[bytes]:
    """Yield what frames of Zstandard unpack to."""
    library = extra_library("zstandard", source, "a Zstandard file", "logs", ", or unpack it")
    at, frame = 0, None
    while at < len(content):
        frame = library.ZstdDecompressor().decompressobj() if frame is None or frame.eof else frame
        chunk = content[at : at + CHUNK]
        yield frame.decompress(chunk)
        at += len(chunk) - len(frame.unused_data)
    if frame is not None and not frame.eof:
        raise EOFError("it ends in the middle of a frame")
