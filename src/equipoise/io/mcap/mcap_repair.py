"""A cut or garbled MCAP file, or one without index, made whole: every record that makes sense."""

from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

from equipoise.io.files.atomic_file import write_whole
from equipoise.io.files.file_content import opened
from equipoise.io.formats.clock_units import PER_S
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.mcap.mcap_recording import time_zero
from equipoise.io.mcap.mcap_salvage import Salvage, salvaged
from equipoise.model.errors import InputError

WANTED = "a recording to repair (MCAP)"


@dataclass(frozen=True, slots=True)
class Repaired:
    """What became of a file."""

    found: Salvage
    last: float  # s, time of the last whole message

    @property
    def written(self) -> bool:
        """Say whether there was anything to mend, so that the other file is there."""
        return not (self.found.whole and self.found.findable)


def repair(path: str | Path, out: str | Path) -> Repaired:
    """Write what is whole of a file to another, with an index; InputError if nothing is.

    A file that is whole and has an index is left as it is.
    """
    with opened(path, WANTED) as content:
        found = salvaged(content, str(path))
    if not found.messages:
        raise InputError(str(path), "no whole message", WANTED)
    done = _repaired(found)
    if done.written:
        write_whole(out, _written(found, str(path)))
    return done


def _repaired(found: Salvage) -> Repaired:
    zero, times = time_zero(found), [m.log_time for m in found.messages]
    return Repaired(found, (max(times) - (min(times) if zero is None else zero)) / PER_S)


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
