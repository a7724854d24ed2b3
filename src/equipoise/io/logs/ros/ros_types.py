"""Messages of ROS by the types that come with rosbags, never by those that a file declares.

The few that are read have been the same in every release.
"""

import functools
from collections.abc import Sequence
from typing import Any

from equipoise.io.files.broken_bytes import as_value_error
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.logs.log_topics import OLD_TREE, TREE, Decoder, Sample
from equipoise.io.logs.ros.ros_messages import samples_of

BROKEN = "bag", "a whole bag of ROS"


def ros_decoder(kind: str, ros2: bool, source: str) -> Decoder:
    """Return how messages of a type are read: CDR of ROS 2, or what ROS 1 writes."""
    store = _store(log_library("rosbags.typesys", source), ros2)
    deserialise = store.deserialize_cdr if ros2 else store.deserialize_ros1

    def decode(data: bytes) -> Sequence[Sample]:
        with as_value_error():
            message = deserialise(data, kind)
        return samples_of(kind, message)

    return decode


def digest_of(kind: str, source: str) -> str:
    """Return the digest of a type of ROS 1, as bags state it."""
    return _store(log_library("rosbags.typesys", source), False).generate_msgdef(kind)[1]


@functools.cache
def _store(types: Any, ros2: bool) -> Any:
    store = types.get_typestore(types.Stores.ROS2_HUMBLE if ros2 else types.Stores.ROS1_NOETIC)
    for kind in (TREE, OLD_TREE):
        if kind not in store.types:
            text = "geometry_msgs/msg/TransformStamped[] transforms"
            store.register(types.get_types_from_msg(text, kind))
    return store
