"""Topics of an MCAP file that another program wrote."""

from collections.abc import Callable, Sequence
from typing import Any

from equipoise.io.logs.log_topics import Decoder, Sample, TopicReader, Topics
from equipoise.io.logs.ros.ros_messages import is_known
from equipoise.io.logs.ros.ros_types import ros_decoder
from equipoise.io.logs.unpacking_work import Work
from equipoise.io.mcap.foxglove_messages import ROTATION, Turned, turned, turned_json
from equipoise.io.mcap.mcap_salvage import Salvage

TURNED: dict[str, Callable[[str, bytes], Turned]] = {"protobuf": turned, "json": turned_json}
ROS = ("cdr", "ros1")  # encodings


def is_foreign(channel: Any, schema: Any) -> bool:
    """Say whether messages of another program's channel are read."""
    kind, encoding = _type(schema), channel.message_encoding
    return (kind in ROTATION and encoding in TURNED) or (is_known(kind) and encoding in ROS)


def add_foreign(found: Salvage, source: str, topics: Topics, packed: Work | None = None) -> None:
    """Add every topic of a file, with the rows of known types.

    ``packed``: each message is, and what unpacking them may take.
    """
    readers: dict[int, TopicReader] = {}
    for number, channel in found.channels.items():
        schema = found.schemas.get(channel.schema_id)
        kind = _type(schema)
        topics.declare(channel.topic, kind, found.counted(number))
        if is_foreign(channel, schema):
            decoder = _decoder(kind, channel.message_encoding, source)
            readers[number] = TopicReader(channel.topic, kind, decoder)
    for message in found.messages:
        if message.channel_id in readers:
            topics.read(readers[message.channel_id], message.log_time, message.data, packed)


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
