"""The events of a recording that we wrote, as a test asks for them."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from equipoise.io.files.file_content import Content
from equipoise.io.formats.clock_units import PER_S
from equipoise.io.mcap.log_messages import EVENT_TOPIC
from equipoise.io.mcap.mcap_recording import time_zero
from equipoise.io.mcap.mcap_salvage import salvaged


@dataclass(frozen=True, slots=True)
class RecordedEvent:
    """What happened while it was recorded: a command, an interlock, a note."""

    t: float  # s
    kind: str
    sentence: str
    data: Mapping[str, Any]


def events_of(path: Path) -> tuple[RecordedEvent, ...]:
    """Return the events of a file, in order."""
    found = salvaged(Content.of(path.read_bytes(), "log"), str(path))
    zero = time_zero(found) or 0
    ids = {each.id for each in found.channels.values() if each.topic == EVENT_TOPIC}
    events = [each for each in found.messages if each.channel_id in ids]
    return tuple(_event(each.log_time, zero, json.loads(each.data)) for each in events)


def _event(ns: int, zero: int, message: dict[str, Any]) -> RecordedEvent:
    stamp = message.pop("timestamp")
    assert ns == stamp["sec"] * PER_S + stamp["nsec"]
    return RecordedEvent((ns - zero) / PER_S, **message)
