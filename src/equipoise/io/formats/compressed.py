"""A recording in a compressed file: gzip (RFC 1952), zip (PKWARE's APPNOTE), Zstandard (RFC 8878).

What is inside is one file, whose name and bytes say what it is. zstandard is an extra, imported
when such a file is met and not before.
"""

import gzip
import io
import zipfile
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from equipoise.io.formats.optional_libraries import extra_library
from equipoise.model.errors import EquipoiseError, InputError

GZIP, ZIP, ZSTD = b"\x1f\x8b", b"PK\x03\x04", b"\x28\xb5\x2f\xfd"
KINDS = {GZIP: "gzip", ZIP: "zip", ZSTD: "Zstandard"}
SUFFIXES = (".gz", ".zip", ".zst")
LARGEST = 2 << 30  # bytes unpacked (chosen)
CHUNK = 4096  # bytes handed to Zstandard at once (chosen: they unpack to 0.2 GB at most)
LISTED = 12  # files of an archive that an error names (chosen)


def unpacked(content: bytes, path: Path, suffixes: tuple[str, ...]) -> tuple[str, bytes]:
    """Return name and bytes of the file inside one that begins with a mark of ``KINDS``.

    ``suffixes`` are those of recordings: other files of an archive are left aside if one has such.
    InputError if the file is broken, unpacks to too much, or holds several.
    """
    kind = next(name for mark, name in KINDS.items() if content.startswith(mark))
    try:
        name, inside = _unpacked(content, path, suffixes)
    except EquipoiseError:
        raise
    except Exception as error:  # a parser of broken bytes raises anything
        found = f"a {kind} file that is cut short or broken ({error})"
        raise InputError(str(path), found, f"a whole {kind} file: copy it anew") from error
    if len(inside) > LARGEST:
        found = f"more than {LARGEST / 2**30:g} GiB once it is unpacked"
        raise InputError(str(path), found, "a shorter recording")
    return name, inside


def _unpacked(content: bytes, path: Path, suffixes: tuple[str, ...]) -> tuple[str, bytes]:
    """Return name and bytes, of which there may be one too many."""
    if content.startswith(ZIP):
        return _member(content, str(path), suffixes)
    name = path.stem if path.suffix.lower() in SUFFIXES else path.name
    if content.startswith(ZSTD):
        return name, b"".join(_of_frames(content, str(path)))
    with gzip.GzipFile(fileobj=io.BytesIO(content)) as file:
        return name, file.read(LARGEST + 1)


def _member(content: bytes, source: str, suffixes: tuple[str, ...]) -> tuple[str, bytes]:
    """Return the one file of an archive that can be a recording."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        names = [each.filename for each in archive.infolist() if not _is_aside(each)]
        fitting = [name for name in names if PurePosixPath(name).suffix.lower() in suffixes]
        found = fitting or names
        if len(found) != 1:
            raise InputError(source, _listed(found), "one recording: unpack the one you want")
        with archive.open(found[0]) as file:
            return found[0], file.read(LARGEST + 1)


def _is_aside(member: zipfile.ZipInfo) -> bool:
    """Say whether a member is a folder, or what an operating system put beside the files."""
    place = PurePosixPath(member.filename)
    return member.is_dir() or place.name.startswith(".") or "__MACOSX" in place.parts


def _listed(names: list[str]) -> str:
    if not names:
        return "a zip archive without a file in it"
    more = f" and {len(names) - LISTED} more" if len(names) > LISTED else ""
    return f"{len(names)} files in a zip archive: {', '.join(names[:LISTED])}{more}"


def _of_frames(content: bytes, source: str) -> Iterator[bytes]:
    """Yield what frames of Zstandard unpack to, up to the limit or a chunk beyond it."""
    library = extra_library("zstandard", source, "a Zstandard file", "logs", ", or unpack it")
    at, size, frame = 0, 0, None
    while at < len(content) and size <= LARGEST:
        frame = library.ZstdDecompressor().decompressobj() if frame is None or frame.eof else frame
        chunk = content[at : at + CHUNK]
        piece = frame.decompress(chunk)
        at, size = at + len(chunk) - len(frame.unused_data), size + len(piece)
        yield piece
    if size <= LARGEST and frame is not None and not frame.eof:
        raise EOFError("it ends within a frame")
