"""A walk through an MCAP file, whole, cut or garbled, that goes on behind what is broken.

Messages stand in chunks, which have a checksum; a chunk that is broken is lost as a whole. Where a
record makes no sense, the next that does is sought. What is unpacked, and what is tried in vain, is
counted: for each byte of the file there is but so much of it.
"""

from array import array
from collections.abc import Iterable, Iterator
from itertools import chain
from typing import Any

from equipoise.io.files.file_content import BLOCK, Content
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.logs.unpacking_work import Work
from equipoise.io.mcap.mcap_chunks import unpacked
from equipoise.io.mcap.mcap_records import (
    CHUNK_HEAD,
    CODES,
    HEAD,
    HEADING,
    KINDS,
    MAGIC,
    MESSAGE,
    PARSED,
    PLACE,
    chunk_in,
    fits_chunk,
    message_in,
    record_in,
)
from equipoise.model.errors import EquipoiseError

IN_CHUNKS = {CODES[kind]: kind for kind in ("Schema", "Channel")}  # beside messages
UNSURE = frozenset({"Message", None})  # kinds that nothing but what follows them makes sure
OBJECT = 1000  # bytes of a schema or a channel, beside its texts (chosen: measured are 700)
NEAR = 4096  # bytes that are searched first: most often a record is near (chosen)
Found = tuple[Iterable[Any] | None, int]  # records, None: there is none; where they end


class Walk:
    """One way through a file, from its first record to its last."""

    def __init__(self, content: Content, source: str) -> None:
        self._content, self._meter = content, content.meter
        self._library = log_library("mcap.records", source)
        self._work = Work(content.meter, len(content))
        self.lost_bytes = self.lost_places = 0

    def records(self) -> Iterator[Any]:
        """Yield the records, those of chunks in place of the chunks."""
        content = self._content
        at = len(MAGIC) if content.startswith(MAGIC) else 0
        while at < len(content) and not self._ends(at):
            found, stop = self._record(at)
            if found is None:
                stop = self._next_place(at)
                self.lost_bytes += stop - at
                self.lost_places += 1
            else:
                yield from found
            at = stop

    def _ends(self, at: int) -> bool:
        """Say whether nothing but the magic is left."""
        return len(self._content) - at == len(MAGIC) and self._content.startswith(MAGIC, at)

    def _next_place(self, after: int) -> int:
        """Return the next place where a record makes sense, or the end."""
        return next((at for at in self._places(after + 1) if self._is_record(at)), self._size)

    @property
    def _size(self) -> int:
        return len(self._content)

    def _places(self, at: int) -> Iterator[int]:
        """Yield the places from one on at which a record may begin."""
        step = NEAR
        while at + HEAD <= self._size:
            block = self._content[at : at + step]
            for place in PLACE.finditer(block):
                yield at + place.start()
            at += step - HEAD + 1
            step = min(2 * step, BLOCK)

    def _is_record(self, at: int) -> bool:
        self._meter.check(0)
        opcode, length = HEADING.unpack(self._peeked(at))
        stop = at + HEAD + length
        if stop > self._size or not self._may_be(opcode, at, stop):
            self._work.add(HEAD)
            return False
        self._work.add(HEAD + length)
        return self._record(at)[0] is not None

    def _may_be(self, opcode: int, at: int, stop: int) -> bool:
        """Say whether it is worth a try to read a record that is sought."""
        sure = KINDS.get(opcode) not in UNSURE and stop - at <= BLOCK
        return sure or self._is_long(opcode, at, stop)

    def _is_long(self, opcode: int, at: int, stop: int) -> bool:
        """Say whether it is worth to read so long a record: it is a chunk, or another follows."""
        head = self._peeked(at + HEAD, CHUNK_HEAD) if opcode == CODES["Chunk"] else b""
        return fits_chunk(head, stop - at - HEAD) or _goes_on(self._peeked(stop))

    def _peeked(self, at: int, count: int = HEAD) -> bytes:
        """Return a few bytes, past the window, which is to stay where it is."""
        self._content.file.seek(at)
        return self._content.file.read(count)

    def _record(self, at: int) -> Found:
        """Return the record at a place, or those of a chunk."""
        self._meter.check(0)
        head = self._content[at : at + HEAD]
        stop = at + HEAD + int.from_bytes(head[1:], "little")
        if stop > self._size or (stop - at > BLOCK and not self._is_long(head[0], at, stop)):
            return None, stop
        try:
            found, exact = self._read(KINDS.get(head[0]), at + HEAD, stop)
        except EquipoiseError:
            raise
        except Exception:  # a parser of broken bytes raises anything, MemoryError too
            return None, stop
        sure = exact or _goes_on(self._content[stop : stop + HEAD])
        return (found if sure else None), stop

    def _read(self, kind: str | None, start: int, stop: int) -> tuple[Iterable[Any], bool]:
        """Return what a record holds, and whether its own lengths fill it exactly.

        A record may have more at its end, of a later version of the format, and there may be
        records of other kinds; either is accepted only if another record follows.
        """
        if kind is None:
            return (), False
        body = self._content[start:stop]
        if kind == "Message":  # it has no length of its own
            return (message_in(body, 0, len(body)),), False
        if kind == "Chunk":
            return self._inside(unpacked(chunk_in(body), self._work)), True
        record, exact = self._parsed(kind, body)
        return (record,), exact

    def _inside(self, data: bytes | memoryview) -> Iterator[Any]:
        """Return a chunk's records; raises if the lengths do not fit."""
        messages, others, at, held = array("Q"), list[Any](), 0, 0
        while at < len(data):
            self._meter.check(0)
            opcode, length = HEADING.unpack_from(data, at)
            start, at = at + HEAD, at + HEAD + length
            if at > len(data) or (opcode == CODES["Message"] and length < MESSAGE.size):
                raise EOFError
            if opcode == CODES["Message"]:
                messages.append(start)
            elif opcode in IN_CHUNKS:
                held += OBJECT + PARSED * length
                self._meter.check(held)
                others.append(self._parsed(IN_CHUNKS[opcode], bytes(data[start:at]))[0])
        return chain(others, (_message(data, start) for start in messages))

    def _parsed(self, kind: str, body: bytes) -> tuple[Any, bool]:
        if kind not in ("Attachment", "Schema"):
            self._meter.check(PARSED * len(body))
        return record_in(kind, body, self._library)


def _message(data: bytes | memoryview, start: int) -> Any:
    length = int.from_bytes(data[start - HEAD + 1 : start], "little")
    return message_in(data, start, start + length)


def _goes_on(rest: bytes) -> bool:
    """Say whether bytes behind a record are those of a record, the magic or the cut."""
    return len(rest) < HEAD or PLACE.match(rest) is not None
