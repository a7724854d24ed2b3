"""Topics of an MCAP file that another program wrote."""

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any

from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.logs.log_sources import Source
from equipoise.io.logs.log_topics import OLD_TREE, TREE, Sample, Topics
from equipoise.io.logs.ros_messages import is_known, samples_of
from equipoise.io.mcap.foxglove_messages import ROTATION, Turned, turned, turned_json
from equipoise.io.mcap.mcap_salvage import Salvage

Decoder = Callable[[bytes], Sequence[Sample]]
TURNED: dict[str, Callable[[str, bytes], Turned]] = {"protobuf": turned, "json": turned_json}


def foreign_sources(found: Salvage, source: str) -> list[Source]:
    """Return every topic, with the rows of known types; messages without sense are left out."""
    topics, counts = Topics(), Counter[int](each.channel_id for each in found.messages)
    decoders: dict[int, tuple[str, str, Decoder]] = {}
    for channel in found.channels.values():
        schema = found.schemas.get(channel.schema_id)
        kind = _type(schema.name) if schema is not None else "no type"
        topics.declare(channel.topic, kind, counts[channel.id])
        decoder = _decoder(kind, channel.message_encoding, source)
        if decoder is not None:
            decoders[channel.id] = channel.topic, kind, decoder
    for message in found.messages:
        if message.channel_id in decoders:
            name, kind, decoder = decoders[message.channel_id]
            topics.add(name, kind, message.log_time, _decoded(decoder, message.data))
    return topics.sources()


def _decoded(decoder: Decoder, data: bytes) -> Sequence[Sample]:
    try:
        return decoder(data)
    except Exception:  # a parser of broken bytes raises anything
        return ()


def _type(name: str) -> str:
    """Return a type's name as ROS 2 writes it: sensor_msgs/Imu is sensor_msgs/msg/Imu."""
    package, slash, rest = name.partition("/")
    return name if not slash or "/" in rest else f"{package}/msg/{rest}"


def _decoder(kind: str, encoding: str, source: str) -> Decoder | None:
    """Return how messages of a type are read; None if the type is unknown."""
    if kind in ROTATION and encoding in TURNED:
        return lambda data: _attitude(TURNED[encoding](kind, data))
    if not is_known(kind) or encoding not in ("cdr", "ros1"):
        return None
    store = _types(source, kind, encoding == "cdr")
    deserialise = store.deserialize_cdr if encoding == "cdr" else store.deserialize_ros1
    return lambda data: samples_of(kind, deserialise(data, kind))


def _types(source: str, kind: str, ros2: bool) -> Any:
    """Return the types of a release; the few that are read have been the same in every one."""
    types = log_library("rosbags.typesys", source)
    store = types.get_typestore(types.Stores.ROS2_HUMBLE if ros2 else types.Stores.ROS1_NOETIC)
    if kind in (TREE, OLD_TREE) and kind not in store.types:
        text = "geometry_msgs/msg/TransformStamped[] transforms"
        store.register(types.get_types_from_msg(text, kind))
    return store


def _attitude(turned: Turned) -> Sequence[Sample]:
    return [Sample(turned[0], {"attitude": turned[1]})]
