"""MCAP files to tables and back: our own, and others' with poses or inertial messages.

Of another program's file attitude comes from foxglove.FrameTransform or foxglove.PoseInFrame
(protobuf or JSON; public Foxglove schemas) or from ROS messages (``ros_messages``). The times of
their own stamps count, not those at which they were logged, unless a stamp is zero. A cut or
garbled file is read as far as it is sound, and that is noted.
"""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

import numpy as np

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.columns.table import Table
from equipoise.io.files.file_content import Content
from equipoise.io.formats.clock_units import PER_S, nanoseconds
from equipoise.io.logs.log_sources import chosen, refuse_choice
from equipoise.io.logs.log_table import LogChannel, log_map, log_table
from equipoise.io.logs.log_topics import BEST, FRAME_TRANSFORM, LATEST
from equipoise.io.mcap.foreign_mcap import foreign_sources
from equipoise.io.mcap.foxglove_messages import turned
from equipoise.io.mcap.live_recording import METADATA, ZERO_KEY, LiveRecording, Opening
from equipoise.io.mcap.log_messages import (
    CHANNEL_KEY,
    EVENT_TOPIC,
    NAMES_KEY,
    START,
    topic_of,
    value_names,
)
from equipoise.io.mcap.mcap_salvage import Salvage, salvaged
from equipoise.model.recording import CHANNELS, Recording, rows_between

SLICE = 2.0  # s to a chunk of a file that is written in one go (chosen: what a broken byte costs)


def read_mcap(content: Content, source: str, options: ReadOptions) -> tuple[Table, ColumnMap]:
    """Return an MCAP file's rows and what they mean; InputError if there are none."""
    found = salvaged(content, source)
    notes = loss_notes(found)
    zero = time_zero(found)
    if zero is None:
        channels, notices = chosen(foreign_sources(found, source), source, options, BEST)
        return log_table(source, channels, None, (*notes, *notices)), log_map(channels)
    refuse_choice(options, source, "a recording of ours, which is read as a whole")
    ours = _our_channels(found)
    known = log_map(ours, ours=True)
    ids = {each.id for each in found.channels.values() if each.topic == EVENT_TOPIC}
    events = [each for each in found.messages if each.channel_id in ids]
    starts = [e.log_time - zero for e in events if _json(e.data).get("kind") == START]
    free_from = max(starts) / PER_S if starts else None
    return log_table(source, ours, zero, notes), replace(known, free_from=free_from)


def write_mcap(recording: Recording, path: str | Path) -> None:
    """Write a recording in one go; one that bears no date ends in 1970."""
    channels = [c for name in CHANNELS if (c := getattr(recording, name)) is not None]
    times = np.unique(np.concatenate([np.zeros(0), *(channel.t for channel in channels)]))
    first = float(times[0]) if len(times) else 0.0
    ends = np.append(np.flatnonzero(np.diff(np.floor((times - first) / SLICE))), len(times) - 1)
    with LiveRecording(path, Opening(max(-nanoseconds(first), 0))) as file:
        since = -np.inf
        for until in times[ends] if len(times) else ():
            file.rows(rows_between(recording, since, until))
            file.turn(float(until))
            since = until


def loss_notes(found: Salvage) -> tuple[str, ...]:
    """Say what of a file is lost."""
    if found.whole:
        return ()
    known = f"{found.lost_messages} messages are known to be lost"
    places = f"{found.lost_bytes} bytes in {found.lost_places} places made no sense"
    decoded = [known] * bool(found.lost_messages) + [places] * bool(found.lost_places)
    cut = "The file has no end" if not found.ended else "The file is garbled"
    return ("; ".join([f"{cut}: it was read as far as it is whole", *decoded]) + ".",)


def time_zero(found: Salvage) -> int | None:
    """Return the clock's reading at time zero; None if the file is another program's."""
    for each in found.metadata:
        zero = each.metadata.get(ZERO_KEY, "") if each.name == METADATA else ""
        if zero.isdecimal() and int(zero) < LATEST:
            return int(zero)
    ours = [c for c in found.channels.values() if CHANNEL_KEY in c.metadata]
    # Garbled where the start stood: the first row is time zero then.
    return min((m.log_time for m in found.messages), default=0) if ours else None


def _our_channels(found: Salvage) -> list[LogChannel]:
    """Return the channels that we wrote, each of all its topics' messages."""
    by_topic: dict[str, Any] = {each.topic: each for each in found.channels.values()}
    rows: dict[int, list[Any]] = {}
    for message in found.messages:
        rows.setdefault(message.channel_id, []).append(message)
    channels: list[LogChannel] = []
    for name in CHANNELS:
        channel = by_topic.get(topic_of(name))
        if channel is None or channel.id not in rows:
            continue
        names = _names(channel)
        keys = () if name == "attitude" else value_names(name, names)
        decoded = [(m.log_time, _values(name, keys, m.data)) for m in rows[channel.id]]
        full = [(ns, values) for ns, values in decoded if values is not None and ns < LATEST]
        if full:
            times, values = zip(*full, strict=True)
            channels.append(LogChannel(name, np.array(times), np.array(values, float), names))
    return channels


def _names(channel: Any) -> tuple[str, ...]:
    try:
        return tuple(map(str, json.loads(channel.metadata.get(NAMES_KEY, "[]"))))
    except ValueError:
        return ()


def _values(name: str, keys: tuple[str, ...], data: bytes) -> tuple[float, ...] | None:
    """Return the numbers of a message; None if it does not hold them."""
    try:
        if name == "attitude":
            return turned(FRAME_TRANSFORM, data)[1]
        decoded = _json(data)
        return tuple(float(decoded[key]) for key in keys)
    except (KeyError, TypeError, ValueError):
        return None


def _json(data: bytes) -> Any:
    """Return what JSON says if it is an object; else an empty one."""
    try:
        decoded: Any = json.loads(data)
    except ValueError:
        return {}
    return cast("dict[str, Any]", decoded) if isinstance(decoded, dict) else {}
