"""Every whole record of an MCAP file, whole, cut or garbled: what it holds, and what is lost.

A channel stands before its messages, so that those which nobody reads, such as pictures, are
counted and not kept. Where the channel is lost, they are kept until the end says what they are.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from equipoise.io.files.file_content import Content
from equipoise.io.files.reading_budget import Meter
from equipoise.io.mcap.kept_messages import Kept, KeptMessages
from equipoise.io.mcap.mcap_records import MAGIC, Message
from equipoise.io.mcap.mcap_walk import Walk

Wanted = Callable[[Any, Any], bool]  # whether messages of a channel, of a schema or none, are kept
RECORD = 500  # bytes of a channel, a schema or metadata as an object, beside its texts (chosen)
PAIR = 200  # bytes of a name and its value, likewise


@dataclass(slots=True)
class Tally:
    """The messages of one channel."""

    wanted: bool | None = None  # None: what it is is not known yet
    count: int = 0
    first: int = 2**64  # ns, by the time of the log
    last: int = 0  # ns

    def add(self, ns: int) -> None:
        """Count a message."""
        self.count += 1
        if ns < self.first:
            self.first = ns
        if ns > self.last:
            self.last = ns


@dataclass(slots=True)
class Salvage:
    """What a file holds, and what of it is lost."""

    meter: Meter
    wanted: Wanted
    channels: dict[int, Any] = field(default_factory=dict[int, Any])
    schemas: dict[int, Any] = field(default_factory=dict[int, Any])
    metadata: list[Any] = field(default_factory=list[Any])
    header: Any = None
    ended: bool = False  # the footer is there
    findable: bool = False  # an index says where its chunks are
    stated: int | None = None  # messages that the file itself says it holds
    indexed: int = 0  # messages that the indexes behind its chunks count
    lost_bytes: int = 0
    lost_places: int = 0
    tallies: dict[int, Tally] = field(default_factory=dict[int, Tally])
    kept: KeptMessages = field(default_factory=KeptMessages)

    @property
    def whole(self) -> bool:
        """Say whether nothing is missing."""
        return self.ended and not self.lost_places and not self.orphans

    @property
    def count(self) -> int:
        """Return how many messages there are whose channel is known."""
        return sum(each.count for each in self._known())

    @property
    def orphans(self) -> int:
        """Return how many messages there are whose channel is lost."""
        return sum(t.count for number, t in self.tallies.items() if number not in self.channels)

    @property
    def first(self) -> int:
        """Return when the first message was logged, ns; 0: there is none."""
        return min((each.first for each in self._known()), default=0)

    @property
    def last(self) -> int:
        """Return when the last message was logged, ns."""
        return max((each.last for each in self._known()), default=0)

    @property
    def lost_messages(self) -> int:
        """Return how many messages are known to be lost; of a cut-off end nothing is known."""
        counted = self.indexed if self.stated is None else self.stated
        return max(counted - self.count, 0) or self.orphans

    @property
    def messages(self) -> Iterator[Kept]:
        """Return the messages that are kept, in file order."""
        return self.kept.of(self.channels)

    def _known(self) -> Iterator[Tally]:
        return (each for number, each in self.tallies.items() if number in self.channels)

    def counted(self, channel: int) -> int:
        """Return how many messages of a channel there are."""
        return self.tallies[channel].count if channel in self.tallies else 0

    def file_away(self, record: Any) -> None:
        """Take in what a record says."""
        match type(record).__name__:
            case "Message":
                self._message(record)
            case "Channel":
                self._named(record, self.channels)
            case "Schema":
                self._named(record, self.schemas)
            case "Metadata":
                self._take(record)
                self.metadata.append(record)
            case _:
                self._count(record)

    def _message(self, message: Message) -> None:
        number = message.channel_id
        tally = self.tallies.get(number)
        if tally is None:
            self.meter.take(RECORD)
            tally = self.tallies[number] = Tally()
        tally.add(message.log_time)
        if tally.wanted is None:
            tally.wanted = self._is_wanted(number)
        if tally.wanted is not False:
            self.kept.add(message, self.meter)

    def _is_wanted(self, number: int) -> bool | None:
        channel = self.channels.get(number)
        schema = None if channel is None else self.schemas.get(channel.schema_id)
        if channel is None or (schema is None and channel.schema_id):
            return None
        return self.wanted(channel, schema)

    def _named(self, record: Any, known: dict[int, Any]) -> None:
        if record.id not in known:
            self._take(record)
            known[record.id] = record

    def _take(self, record: Any) -> None:
        """Count a record that stays."""
        pairs: Mapping[str, str] = getattr(record, "metadata", {})
        texts = sum(PAIR + len(key) + len(value) for key, value in pairs.items())
        self.meter.take(RECORD + texts + len(getattr(record, "data", b"")))

    def _count(self, record: Any) -> None:
        """Take in what a record says of the file itself."""
        match type(record).__name__:
            case "ChunkIndex":
                self.findable = True
            case "MessageIndex":
                self.indexed += record.messages
            case "Statistics":
                self.stated = record.message_count
            case "Header":
                self.header = self.header or record
            case "Footer":
                self.ended = True
            case _:
                pass


def everything(_channel: Any, _schema: Any) -> bool:
    """Keep the messages of every channel."""
    return True


def nothing(_channel: Any, _schema: Any) -> bool:
    """Count messages, and keep none."""
    return False


def salvaged(content: Content, source: str, wanted: Wanted = everything) -> Salvage:
    """Return all that can be read, of messages those that are wanted.

    Broken content is counted. InputError if it takes too much memory or time.
    """
    walk, found = Walk(content, source), Salvage(content.meter, wanted)
    for record in walk.records():
        found.file_away(record)
    found.lost_bytes, found.lost_places = walk.lost_bytes, walk.lost_places
    found.ended = found.ended and content.endswith(MAGIC) and content.startswith(MAGIC)
    return found
