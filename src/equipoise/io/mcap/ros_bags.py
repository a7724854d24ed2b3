"""Bags of ROS 1 (one file) and ROS 2 (a folder with metadata.yaml, or its .db3 file alone).

Messages are as in ``ros_messages``, topics as in ``log_topics``. The stamp of a message's header
counts; the time at which the bag took it only if the stamp is zero. What a folder may take goes by
the size of all its files.
"""

import tempfile
from collections.abc import Generator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.columns.table import Table
from equipoise.io.files.file_content import Content
from equipoise.io.files.reading_budget import ReadingBudget
from equipoise.io.files.source_file import open_bytes, size_of
from equipoise.io.logs.log_sources import chosen
from equipoise.io.logs.log_table import log_map, log_table
from equipoise.io.logs.log_topics import BEST, Topics
from equipoise.io.logs.ros.bag_metadata import FOLDER_MARK, BagFiles, bag_files
from equipoise.io.logs.ros.ros1_bag import add_ros1
from equipoise.io.logs.ros.ros2_database import add_database
from equipoise.io.logs.unpacking_work import Work
from equipoise.io.logs.zstd_frames import unframe_file
from equipoise.io.mcap.foreign_mcap import add_foreign, is_foreign
from equipoise.io.mcap.mcap_recording import loss_notes
from equipoise.io.mcap.mcap_salvage import salvaged

__all__ = ["FOLDER_MARK", "ROS_1", "ROS_2", "read_bag"]
ROS_1, ROS_2 = b"#ROSBAG V2.0", b"SQLite format 3\x00"
WANTED = "a whole bag of ROS"


def read_bag(path: Path, content: Content, options: ReadOptions) -> tuple[Table, ColumnMap]:
    """Return a bag's rows and what they mean; InputError if it is broken or holds none."""
    topics, notes = Topics(content.meter), list[str]()
    if path.is_dir():
        files = bag_files(content, str(path))
        size = sum(_size(path / name) for name in files.names)
        topics = Topics(ReadingBudget(options.max_memory).of(str(path), size))
        for name in files.names:
            notes += _add_file(path / name, files, topics)
    elif content.startswith(ROS_2):
        with _on_disk(path, content) as file:
            add_database(file, topics)
    else:
        add_ros1(content, topics)
    channels, taken = chosen(topics.sources(), str(path), options, BEST)
    notes = (*notes, *topics.notes, *taken)
    return log_table(topics.meter, channels, None, notes), log_map(channels)


def _size(path: Path) -> int:
    with open_bytes(path, WANTED) as file:
        return size_of(file)


@contextmanager
def _on_disk(path: Path, content: Content) -> Generator[Path]:
    """Lend the path of a file that SQLite can open: its own, unless it was packed in another."""
    if not isinstance(content.file, BytesIO):
        yield path
        return
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "bag.db3"
        with copy.open("wb") as file:
            file.writelines(content.blocks())
        yield copy


def _add_file(path: Path, files: BagFiles, topics: Topics) -> tuple[str, ...]:
    """Add the topics of one file of a folder; return notes on what of it is lost."""
    if files.packed != "file":
        return _add_storage(path, files, topics)
    with tempfile.TemporaryDirectory() as folder, open_bytes(path, WANTED) as file:
        copy = Path(folder) / "bag"
        unframe_file(Content(file, size_of(file), topics.meter), copy)
        return _add_storage(copy, files, topics)


def _add_storage(path: Path, files: BagFiles, topics: Topics) -> tuple[str, ...]:
    with open_bytes(path, WANTED) as file:
        work = Work(topics.meter, size_of(file))
        packed = work if files.packed == "message" else None
        if files.storage == "sqlite3":
            add_database(path, topics, packed)
            return ()
        content = Content(file, size_of(file), topics.meter)
        found = salvaged(content, topics.meter.source, is_foreign)
        add_foreign(found, topics.meter.source, topics, packed)
        return loss_notes(found)
