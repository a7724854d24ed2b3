"""MCAP files to tables and back: our own, and others' with poses or inertial messages.

Of another program's file attitude comes from foxglove.FrameTransform or foxglove.PoseInFrame
(protobuf or JSON; public Foxglove schemas) or from ROS messages (``ros_messages``). The times of
their own stamps count, not those at which they were logged, unless a stamp is zero. A cut or
garbled file is read as far as it is sound, and that is noted.
"""

import json
import re
from array import array
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
from equipoise.io.logs.log_topics import (
    BEST,
    DECODED,
    FRAME_TRANSFORM,
    LATEST,
    Topics,
    left_out,
)
from equipoise.io.mcap.foreign_mcap import add_foreign, is_foreign
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

OURS = frozenset((*map(topic_of, CHANNELS), EVENT_TOPIC))
DIGITS = re.compile("[0-9]{1,19}")
SLICE = 2.0  # s to a chunk of a file that is written in one go (chosen: what a broken byte costs)


def read_mcap(content: Content, source: str, options: ReadOptions) -> tuple[Table, ColumnMap]:
    """Return an MCAP file's rows and what they mean; InputError if there are none."""
    found = salvaged(content, source, _is_read)
    notes, zero = loss_notes(found), time_zero(found)
    if zero is None:
        topics = Topics(found.meter)
        add_foreign(found, source, topics)
        channels, notices = chosen(topics.sources(), source, options, BEST)
        notes = (*notes, *topics.notes, *notices)
        return log_table(found.meter, channels, None, notes), log_map(channels)
    refuse_choice(options, source, "a recording of ours, which is read as a whole")
    by_topic: dict[str, Any] = {each.topic: each for each in found.channels.values()}
    present = [(name, by_topic[topic_of(name)]) for name in CHANNELS if topic_of(name) in by_topic]
    made = (_our_channel(name, channel, found) for name, channel in present)
    ours = [channel for channel in made if len(channel.ns)]
    lost = sum(found.counted(channel.id) for _, channel in present)
    lost -= sum(len(channel.ns) for channel in ours)
    known = replace(log_map(ours, ours=True), free_from=_free_from(found, zero))
    return log_table(found.meter, ours, zero, (*notes, *left_out(lost))), known


def _is_read(channel: Any, schema: Any) -> bool:
    """Say whether messages of a channel may be of use."""
    return channel.topic in OURS or is_foreign(channel, schema)


def _free_from(found: Salvage, zero: int) -> float | None:
    """Return from when on the platform was free, s; None if nothing says so."""
    ids = {key: each for key, each in found.channels.items() if each.topic == EVENT_TOPIC}
    starts: list[int] = []
    for _, ns, data in found.kept.of(ids):
        found.meter.check(DECODED * len(data))
        if json_object(data).get("kind") == START:
            starts.append(ns - zero)
    return max(starts) / PER_S if starts else None


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
        if DIGITS.fullmatch(zero) and int(zero) < LATEST:
            return int(zero)
    ours = [c for c in found.channels.values() if CHANNEL_KEY in c.metadata]
    # Garbled where the start stood: the first row is time zero then.
    return found.first if ours else None


def _our_channel(name: str, channel: Any, found: Salvage) -> LogChannel:
    names = _names(channel)
    keys = () if name == "attitude" else value_names(name, names)
    times, values, width = array("q"), array("d"), 4 if name == "attitude" else len(keys)
    for ns, data in found.kept.of_one(channel.id):
        found.meter.check(DECODED * len(data))
        row = _values(name, keys, data)
        if row is not None and ns < LATEST:
            times.append(ns)
            values.extend(row)
    return LogChannel(name, np.array(times), np.array(values).reshape(len(times), width), names)


def _names(channel: Any) -> tuple[str, ...]:
    """Return the names of a channel's columns; none if they are not listed."""
    try:
        named: Any = json.loads(channel.metadata.get(NAMES_KEY, "[]"))
    except (ValueError, RecursionError):
        return ()
    return tuple(map(str, cast("list[Any]", named))) if isinstance(named, list) else ()


def _values(name: str, keys: tuple[str, ...], data: bytes) -> tuple[float, ...] | None:
    """Return the numbers of a message; None if it does not hold them."""
    try:
        if name == "attitude":
            return turned(FRAME_TRANSFORM, data)[1]
        decoded = json_object(data)
        return tuple(float(decoded[key]) for key in keys)
    except (KeyError, OverflowError, TypeError, ValueError):
        return None


def json_object(data: bytes) -> Any:
    """Return what JSON says if it is an object; else an empty one."""
    try:
        decoded: Any = json.loads(data)
    except (ValueError, RecursionError):
        return {}
    return cast("dict[str, Any]", decoded) if isinstance(decoded, dict) else {}
