"""Topics of an MCAP file that another program wrote."""

from collections.abc import Callable, Sequence
from typing import Any

from equipoise.io.logs.log_sources import Source
from equipoise.io.logs.log_topics import Sample, Topics
from equipoise.io.logs.ros.ros_messages import is_known
from equipoise.io.logs.ros.ros_types import DECODED, Decoder, ros_decoder
from equipoise.io.logs.unpacking_work import Work
from equipoise.io.logs.zstd_frames import unframed
from equipoise.io.mcap.foxglove_messages import ROTATION, Turned, turned, turned_json
from equipoise.io.mcap.mcap_salvage import Salvage

TURNED: dict[str, Callable[[str, bytes], Turned]] = {"protobuf": turned, "json": turned_json}
ROS = ("cdr", "ros1")  # encodings


def is_foreign(channel: Any, schema: Any) -> bool:
    """Say whether messages of another program's channel are read."""
    kind, encoding = _type(schema), channel.message_encoding
    return (kind in ROTATION and encoding in TURNED) or (is_known(kind) and encoding in ROS)


def foreign_sources(found: Salvage, source: str) -> list[Source]:
    """Return every topic, with the rows of known types; messages without sense are left out."""
    topics = Topics(found.meter)
    add_foreign(found, source, topics)
    return topics.sources()


def add_foreign(found: Salvage, source: str, topics: Topics, packed: Work | None = None) -> None:
    """Add every topic of a file, with the rows of known types.

    ``packed``: each message is, and what unpacking them may take.
    """
    decoders: dict[int, tuple[str, str, Decoder]] = {}
    for number, channel in found.channels.items():
        schema = found.schemas.get(channel.schema_id)
        kind = _type(schema)
        topics.declare(channel.topic, kind, found.counted(number))
        if is_foreign(channel, schema):
            decoder = _decoder(kind, channel.message_encoding, source)
            decoders[number] = channel.topic, kind, decoder
    for message in found.messages:
        if message.channel_id in decoders:
            name, kind, decoder = decoders[message.channel_id]
            data = unframed(message.data, packed) if packed else message.data
            found.meter.check(DECODED * len(data))
            topics.add(name, kind, message.log_time, _decoded(decoder, data))


def _decoded(decoder: Decoder, data: bytes) -> Sequence[Sample]:
    try:
        return decoder(data)
    except Exception:  # a parser of broken bytes raises anything
        return ()


def _type(schema: Any) -> str:
    """Return a type's name as ROS 2 writes it: sensor_msgs/Imu is sensor_msgs/msg/Imu."""
    if schema is None:
        return "no type"
    package, slash, rest = schema.name.partition("/")
    return schema.name if not slash or "/" in rest else f"{package}/msg/{rest}"


def _decoder(kind: str, encoding: str, source: str) -> Decoder:
    if kind in ROTATION:
        return lambda data: _attitude(TURNED[encoding](kind, data))
    return ros_decoder(kind, encoding == "cdr", source)


def _attitude(turned: Turned) -> Sequence[Sample]:
    return [Sample(turned[0], {"attitude": turned[1]})]
