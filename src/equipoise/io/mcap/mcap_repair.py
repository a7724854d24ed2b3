"""A cut or garbled MCAP file, or one without index, made whole: every record that makes sense."""

from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

from equipoise.io.files.atomic_file import write_whole
from equipoise.io.files.source_file import read_bytes
from equipoise.io.formats.clock_units import PER_S
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.mcap.mcap_recording import time_zero
from equipoise.io.mcap.mcap_salvage import Salvage, salvaged
from equipoise.model.errors import InputError

WANTED = "a recording to repair (MCAP)"


@dataclass(frozen=True, slots=True)
class Repaired:
    """What became of a file."""

    whole: bool  # nothing was missing
    indexed: bool  # there was an index
    messages: int  # that are whole
    last: float  # s, time of the last of them
    ended: bool  # the old file has its end; else what followed its last bytes is not known
    lost_messages: int  # known to be lost
    lost_bytes: int  # that made no sense
    lost_places: int

    @property
    def written(self) -> bool:
        """Say whether there was anything to mend, so that the other file is there."""
        return not (self.whole and self.indexed)


def repair(path: str | Path, out: str | Path) -> Repaired:
    """Write what is whole of a file to another, with an index; InputError if nothing is.

    A file that is whole and has an index is left as it is.
    """
    found = salvaged(read_bytes(path, WANTED), str(path))
    if not found.messages:
        raise InputError(str(path), "no whole message", WANTED)
    done = _repaired(found)
    if done.written:
        write_whole(out, _written(found, str(path)))
    return done


def _repaired(found: Salvage) -> Repaired:
    zero = time_zero(found)
    first = min(m.log_time for m in found.messages) if zero is None else zero
    return Repaired(
        whole=found.whole,
        indexed=found.findable,
        messages=len(found.messages),
        last=(max(m.log_time for m in found.messages) - first) / PER_S,
        ended=found.ended,
        lost_messages=found.lost_messages,
        lost_bytes=found.lost_bytes,
        lost_places=found.lost_places,
    )


def _written(found: Salvage, source: str) -> bytes:
    """Return the records as a file of their own; every message as it was, to the last bit."""
    library: Any = log_library("mcap.writer", source)
    stream = BytesIO()
    writer = library.Writer(stream)
    writer.start(profile=found.header.profile if found.header is not None else "")
    for each in found.metadata:
        writer.add_metadata(each.name, each.metadata)
    for each in found.attachments:
        writer.add_attachment(
            each.create_time, each.log_time, each.name, each.media_type, each.data
        )
    schemas = {0: 0} | {
        key: writer.register_schema(each.name, each.encoding, each.data)
        for key, each in found.schemas.items()
    }
    channels = {
        key: writer.register_channel(
            each.topic, each.message_encoding, schemas.get(each.schema_id, 0), each.metadata
        )
        for key, each in found.channels.items()
    }
    for each in found.messages:
        writer.add_message(
            channels[each.channel_id], each.log_time, each.data, each.publish_time, each.sequence
        )
    writer.finish()
    return stream.getvalue()
