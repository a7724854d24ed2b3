"""What metadata.yaml says of the files of a ROS 2 bag (public: rosbag2's design pages)."""

from dataclasses import dataclass
from pathlib import PurePath
from typing import Any

from equipoise.io.files.broken_bytes import as_broken
from equipoise.io.files.file_content import Content
from equipoise.io.formats.optional_libraries import log_library
from equipoise.model.errors import InputError

FOLDER_MARK = "metadata.yaml"
LARGEST = 4_000_000  # bytes (chosen: of a thousand topics)
DEEPEST = 20  # lists and tables within each other (chosen: rosbag2 has eight)
MOST_FILES = 10_000  # chosen: of a minute each, a week
STORAGES = ("sqlite3", "mcap")
PACKED = ("", "none", "file", "message")
WANTED = "a bag as rosbag2 writes it"


@dataclass(frozen=True, slots=True)
class BagFiles:
    """The files of a bag."""

    names: tuple[str, ...]
    storage: str  # of STORAGES
    packed: str  # 'file', 'message', or what means neither


def bag_files(content: Content, source: str) -> BagFiles:
    """Return what is listed; InputError if it is more than any bag has, or broken."""
    where = f"{source}/{FOLDER_MARK}"
    if len(content) > LARGEST:
        raise InputError(where, f"{len(content)} bytes", f"{LARGEST} at most")
    text = content.whole()
    with as_broken(where, "list of files", WANTED):
        _check_shape(text, where)
        reader: Any = log_library("ruamel.yaml", source).YAML(typ="safe")
        said: Any = reader.load(text)["rosbag2_bagfile_information"]
        names = tuple(dict.fromkeys(PurePath(each).name for each in said["relative_file_paths"]))
        packed = str(said.get("compression_mode") or "").lower()
        found = BagFiles(names, str(said["storage_identifier"]), packed)
        form: Any = said.get("compression_format")
    _check(found, form, where)
    return found


def _check_shape(text: bytes, where: str) -> None:
    """Raise InputError at what makes much of little: depth, and references to other places."""
    deep = 0
    for event in log_library("ruamel.yaml", where).YAML(typ="safe").parse(text):
        kind = type(event).__name__
        deep += kind in ("MappingStartEvent", "SequenceStartEvent")
        deep -= kind in ("MappingEndEvent", "SequenceEndEvent")
        if deep > DEEPEST or kind == "AliasEvent":
            found = "references (*name)" if deep <= DEEPEST else f"more than {DEEPEST} levels"
            raise InputError(where, found, WANTED)


def _check(found: BagFiles, form: Any, where: str) -> None:
    if found.storage not in STORAGES:
        raise InputError(where, f"storage '{found.storage[:20]}'", f"one of {', '.join(STORAGES)}")
    if found.packed not in PACKED or (found.packed in PACKED[2:] and form != "zstd"):
        raise InputError(where, f"compression '{found.packed[:20]}'", "files or messages by zstd")
    if len(found.names) > MOST_FILES:
        raise InputError(where, f"{len(found.names)} files", f"{MOST_FILES} at most")
