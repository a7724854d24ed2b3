"""Bags of ROS 1 (one file) and ROS 2 (a folder with metadata.yaml, or its .db3 file alone).

Formats (public: wiki.ros.org/Bags/Format/2.0, rosbag2's design pages), read by rosbags; messages
as in ``ros_messages``, topics as in ``log_topics``. The stamp of a message's header counts; the
time at which the bag took it only if the stamp is zero.
"""

import tempfile
from pathlib import Path
from typing import Any

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.columns.table import Table
from equipoise.io.files.file_content import Content
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.logs.log_sources import Source, chosen
from equipoise.io.logs.log_table import log_map, log_table
from equipoise.io.logs.log_topics import BEST, Topics
from equipoise.io.logs.ros_messages import is_known, samples_of
from equipoise.model.errors import EquipoiseError, InputError

ROS_1, ROS_2 = b"#ROSBAG V2.0", b"SQLite format 3\x00"
FOLDER_MARK = "metadata.yaml"  # of a ROS 2 bag's folder
SUFFIXES = {ROS_1: ".bag", ROS_2: ".db3"}


def read_bag(path: Path, content: Content, options: ReadOptions) -> tuple[Table, ColumnMap]:
    """Return a bag's rows and what they mean; InputError if it is broken or holds none."""
    suffix = next((s for mark, s in SUFFIXES.items() if content.startswith(mark)), "")
    try:
        if path.is_dir() or path.suffix == suffix:
            sources = _sources(path)
        else:  # the library goes by the name's suffix, we by what is in it
            with tempfile.TemporaryDirectory() as folder:
                copy = Path(folder) / f"bag{suffix or path.suffix}"
                copy.write_bytes(content.whole())
                sources = _sources(copy)
    except EquipoiseError:
        raise
    except Exception as error:  # a parser of broken bytes raises anything
        raise InputError(str(path), f"a broken bag ({error})", "a whole bag of ROS") from error
    channels, notes = chosen(sources, str(path), options, BEST)
    return log_table(str(path), channels, None, notes), log_map(channels)


def _sources(path: Path) -> list[Source]:
    """Return every topic, those of known types with their rows."""
    highlevel: Any = log_library("rosbags.highlevel", str(path))
    types: Any = log_library("rosbags.typesys", str(path))
    # Bags of ROS 2 before Iron do not say what their types are; ours have been the same since.
    store = types.get_typestore(types.Stores.ROS2_HUMBLE)
    topics = Topics(meter)
    with highlevel.AnyReader([path], default_typestore=store) as reader:
        for each in reader.connections:
            topics.declare(each.topic, each.msgtype, each.msgcount)
        known = [each for each in reader.connections if is_known(each.msgtype)]
        for connection, logged, raw in reader.messages(connections=known) if known else ():
            kind = connection.msgtype
            topics.add(
                connection.topic, kind, logged, samples_of(kind, reader.deserialize(raw, kind))
            )
    return topics.sources()
