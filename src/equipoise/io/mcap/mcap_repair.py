"""A cut or garbled MCAP file, or one without index, made whole: every record that makes sense."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from equipoise.io.files.atomic_file import whole_file
from equipoise.io.files.file_content import USUAL, opened
from equipoise.io.files.reading_budget import ReadingBudget
from equipoise.io.formats.clock_units import PER_S
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.mcap.mcap_recording import time_zero
from equipoise.io.mcap.mcap_salvage import Salvage, nothing, salvaged
from equipoise.io.mcap.mcap_walk import Walk
from equipoise.model.errors import InputError, declared

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


def repair(path: str | Path, out: str | Path, budget: ReadingBudget = USUAL) -> Repaired:
    """Write what is whole of a file to another, with an index; InputError if nothing is.

    A file that is whole and has an index is left as it is. It is walked through twice: what stands
    in front of a file that is written is known when all of the other has been seen.
    """
    with declared(str(path), WANTED), opened(path, WANTED, budget) as content:
        found = salvaged(content, str(path), nothing)
        if not found.count:
            raise InputError(str(path), "no whole message", WANTED)
        done = _repaired(found)
        if done.written:
            with whole_file(out) as temporary, temporary.open("wb") as file:
                _write(file, found, Walk(content, str(path)))
    return done


def _repaired(found: Salvage) -> Repaired:
    zero = time_zero(found)
    return Repaired(found, (found.last - (found.first if zero is None else zero)) / PER_S)


def _write(file: BinaryIO, found: Salvage, walk: Walk) -> None:
    """Write the records as a file of their own; every message as it was, to the last bit."""
    library: Any = log_library("mcap.writer", found.meter.source)
    writer = library.Writer(file)
    writer.start(profile=found.header.profile if found.header is not None else "")
    for each in found.metadata:
        writer.add_metadata(each.name, each.metadata)
    channels = _registered(writer, found)
    for each in walk.records():
        match type(each).__name__:
            case "Message" if each.channel_id in channels:
                times = each.log_time, each.data, each.publish_time
                writer.add_message(channels[each.channel_id], *times, each.sequence)
            case "Attachment":
                times = each.create_time, each.log_time
                writer.add_attachment(*times, each.name, each.media_type, each.data)
            case _:
                pass
    writer.finish()


def _registered(writer: Any, found: Salvage) -> dict[int, int]:
    """Return the numbers that channels have in the new file, by those in the old one."""
    schemas = {0: 0} | {
        key: writer.register_schema(each.name, each.encoding, each.data)
        for key, each in found.schemas.items()
    }
    return {
        key: writer.register_channel(
            each.topic, each.message_encoding, schemas.get(each.schema_id, 0), each.metadata
        )
        for key, each in found.channels.items()
    }
