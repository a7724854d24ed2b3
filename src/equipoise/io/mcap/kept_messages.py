"""Messages in the order of their file, without the cost of an object each."""

from array import array
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from equipoise.io.files.reading_budget import Meter
from equipoise.io.mcap.mcap_records import Message

ROW = 60  # bytes of a message beside its data, here and as a row (chosen: measured are 50)


class Kept(NamedTuple):
    """What is kept of a message."""

    channel_id: int
    log_time: int  # ns
    data: bytes


@dataclass(slots=True)
class KeptMessages:
    """The messages that are kept, counted."""

    _ids: "array[int]" = field(default_factory=lambda: array("H"))
    _times: "array[int]" = field(default_factory=lambda: array("Q"))
    _ends: "array[int]" = field(default_factory=lambda: array("Q"))
    _data: bytearray = field(default_factory=bytearray)

    def add(self, message: Message, meter: Meter) -> None:
        """Keep a message; InputError if it is one too many."""
        meter.take(ROW + len(message.data))
        self._ids.append(message.channel_id)
        self._times.append(message.log_time)
        self._data += message.data
        self._ends.append(len(self._data))

    def of(self, channels: Mapping[int, Any]) -> Iterator[Kept]:
        """Yield the messages of channels by their numbers."""
        start = 0
        for number, ns, stop in zip(self._ids, self._times, self._ends, strict=True):
            if number in channels:
                yield Kept(number, ns, bytes(self._data[start:stop]))
            start = stop

    def of_one(self, channel: int) -> Iterator[tuple[int, bytes]]:
        """Yield time (ns) and data of each message of a channel."""
        for k in np.flatnonzero(np.array(self._ids, dtype=np.uint16) == channel):
            start = self._ends[k - 1] if k else 0
            yield self._times[k], bytes(self._data[start : self._ends[k]])
