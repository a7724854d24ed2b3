"""Topics of an MCAP file that another program wrote."""

from collections.abc import Callable
from typing import Any

from equipoise.io.formats.log_topics import Topic, Values
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.formats.ros_messages import DECODERS, stamp_of
from equipoise.io.mcap.foxglove_messages import ROTATION, Turned, turned, turned_json
from equipoise.io.mcap.mcap_salvage import Salvage

Decoder = Callable[[bytes], tuple[int, Values]]
TURNED: dict[str, Callable[[str, bytes], Turned]] = {"protobuf": turned, "json": turned_json}


def foreign_topics(found: Salvage, source: str) -> list[Topic]:
    """Return the topics of known types; messages that make no sense are left out."""
    topics: dict[int, tuple[Topic, Decoder]] = {}
    for channel in found.channels.values():
        schema = found.schemas.get(channel.schema_id)
        kind = _type(schema.name) if schema is not None else ""
        decoder = _decoder(kind, channel.message_encoding, source)
        if decoder is not None:
            topics[channel.id] = Topic(channel.topic, kind), decoder
    for message in found.messages:
        if message.channel_id in topics:
            topic, decoder = topics[message.channel_id]
            _take(topic, decoder, message)
    return [topic for topic, _ in topics.values()]


def _take(topic: Topic, decoder: Decoder, message: Any) -> None:
    try:
        ns, values = decoder(message.data)
    except Exception:  # a parser of broken bytes raises anything
        return
    topic.add(ns or message.log_time, values)


def _type(name: str) -> str:
    """Return a type's name as ROS 2 writes it: sensor_msgs/Imu is sensor_msgs/msg/Imu."""
    package, slash, rest = name.partition("/")
    return name if not slash or "/" in rest else f"{package}/msg/{rest}"


def _decoder(kind: str, encoding: str, source: str) -> Decoder | None:
    """Return how messages of a type are read; None if the type is unknown."""
    if kind in ROTATION and encoding in TURNED:
        return lambda data: _attitude(TURNED[encoding](kind, data))
    if kind not in DECODERS or encoding not in ("cdr", "ros1"):
        return None
    types = log_library("rosbags.typesys", source)
    ros2 = encoding == "cdr"
    # The few types that are read have been the same in every release.
    store = types.get_typestore(types.Stores.ROS2_HUMBLE if ros2 else types.Stores.ROS1_NOETIC)
    deserialise = store.deserialize_cdr if ros2 else store.deserialize_ros1

    def decode(data: bytes) -> tuple[int, Values]:
        message = deserialise(data, kind)
        return stamp_of(message), DECODERS[kind](message)

    return decode


def _attitude(turned: Turned) -> tuple[int, Values]:
    return turned[0], {"attitude": turned[1]}
