"""Bags of ROS 1 (public: wiki.ros.org/Bags/Format/2.0), read by rosbags and counted here.

A chunk's header says how large it is unpacked, and no more than that is unpacked. Where an index
names the same rows again and again, each time counts.
"""

import struct
from bz2 import BZ2Decompressor
from collections.abc import Iterable
from contextlib import closing
from typing import Any

from equipoise.io.files.broken_bytes import as_broken, each_unbroken
from equipoise.io.files.file_content import Content
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.logs.counted_file import CountedFile
from equipoise.io.logs.log_topics import TopicReader, Topics
from equipoise.io.logs.ros.ros_messages import is_known
from equipoise.io.logs.ros.ros_types import BROKEN, digest_of, ros_decoder
from equipoise.io.logs.unpacking_work import Work

ENTRY = 200  # bytes of an entry of an index as an object (chosen: measured are 180)
HEADER, PLACE = 55, 12  # bytes of an index's header, at whose end is a size, and of an entry
ANY = "*"  # the digest of a type that is not known


def add_ros1(content: Content, topics: Topics) -> None:
    """Add every topic of a bag, of known types the rows; InputError if the bag is broken."""
    source, reader = content.meter.source, _reader(content)
    with as_broken(source, *BROKEN):
        reader.open()
    with closing(reader):
        for each in reader.connections:
            topics.declare(each.topic, each.msgtype, each.msgcount)
        known = [each for each in reader.connections if _is_read(each, source)]
        kinds = {each.msgtype for each in known}
        decoders = {kind: ros_decoder(kind, False, source) for kind in kinds}
        messages: Iterable[Any] = reader.messages(connections=known) if known else ()
        for connection, logged, data in each_unbroken(messages, source, *BROKEN):
            kind = connection.msgtype
            topics.read(TopicReader(connection.topic, kind, decoders[kind]), logged, data)


def _is_read(connection: Any, source: str) -> bool:
    """Say whether messages are of a known type, and not of another of the same name."""
    kind = connection.msgtype
    return is_known(kind) and connection.digest in (ANY, digest_of(kind, source))


class _Place:
    """A content where a library wants a path."""

    def __init__(self, content: Content) -> None:
        self._content = content

    def exists(self) -> bool:
        """Say that it is there."""
        return True

    def open(self, _mode: str = "rb") -> CountedFile:
        """Return it as an open file."""
        return CountedFile(self._content)


def _reader(content: Content) -> Any:
    library: Any = log_library("rosbags.rosbag1.reader", content.meter.source)
    work = Work(content.meter, len(content))

    class Counted(library.Reader):
        """A reader that counts what it takes."""

        def read_chunk(self) -> Any:
            """Return where a chunk is, and how it is unpacked."""
            file = self.bio
            begin = file.tell()
            chunk: Any = library.Reader.read_chunk(self)
            end = file.tell()
            file.seek(begin)
            header = library.Header.read(file)
            file.seek(end)
            unpacker = _unpacker(header.get_string("compression"), work)
            size = header.get_uint32("size")
            if unpacker is None:
                return chunk

            def unpack(data: bytes) -> bytes:
                return _unpacked(data, size, unpacker, work)

            return chunk._replace(decompressor=unpack)

        def read_index_data(self, pos: int, indexes: Any) -> None:
            """Read where messages of a chunk are."""
            file = self.bio
            begin = file.tell()
            (size,) = struct.unpack("<I", file.read(HEADER)[-4:])
            work.meter.take(ENTRY * (size // PLACE))
            file.seek(begin)
            library.Reader.read_index_data(self, pos, indexes)

    return Counted(_Place(content))


def _unpacker(compression: str, work: Work) -> Any:
    """Return what unpacks a chunk; None where nothing is packed."""
    match compression:
        case "bz2":
            return BZ2Decompressor
        case "lz4":
            return log_library("lz4.frame", work.meter.source).LZ4FrameDecompressor
        case _:
            return None


def _unpacked(data: bytes, size: int, unpacker: Any, work: Work) -> bytes:
    """Return what a chunk unpacks to; ValueError if it is cut, or more than it says."""
    work.meter.check(size)
    work.add(size)
    unpacking = unpacker()
    found = unpacking.decompress(data, max_length=size + 1)
    if len(found) > size or not unpacking.eof:
        raise ValueError("a chunk of another size than it says")
    return found
