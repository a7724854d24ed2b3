"""Every format of a recording, in one table: how it is known, read and written.

A file is known by its first bytes; by its suffix only where those say nothing, as in a text. One
that is compressed is what is inside it.
"""

from collections.abc import Callable, Generator, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.column_store import Disk
from equipoise.io.columns.native_columns import native_columns
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.columns.table import Table
from equipoise.io.files.atomic_file import whole_file, write_whole
from equipoise.io.files.file_content import Content, opened, sha256_of
from equipoise.io.files.reading_budget import ReadingBudget
from equipoise.io.formats.compressed import KINDS, ZIP, unpacked
from equipoise.io.formats.csv_table import csv_text, table_in
from equipoise.io.formats.mat_table import MAGIC as MAT
from equipoise.io.formats.mat_table import MAGIC_73, mat_bytes, read_mat
from equipoise.io.formats.parquet_table import MAGIC as PARQUET
from equipoise.io.formats.parquet_table import parquet_bytes, read_parquet
from equipoise.io.formats.qualisys_header import with_qualisys_header
from equipoise.io.formats.text_blocks import Text, text_in
from equipoise.io.formats.vicon_header import with_vicon_header
from equipoise.io.formats.xlsx_table import is_workbook, read_xlsx
from equipoise.io.logs.dataflash_log import MAGIC as DATAFLASH
from equipoise.io.logs.dataflash_log import read_dataflash
from equipoise.io.logs.log_sources import refuse_choice
from equipoise.io.logs.mavlink_log import read_tlog
from equipoise.io.logs.tlog_capture import is_tlog
from equipoise.io.logs.ulog_file import MAGIC as ULOG
from equipoise.io.logs.ulog_file import read_ulog
from equipoise.io.logs.vectornav_log import is_vectornav, read_vectornav
from equipoise.io.mcap.mcap_recording import read_mcap, write_mcap
from equipoise.io.mcap.mcap_records import MAGIC as MCAP
from equipoise.io.mcap.ros_bags import FOLDER_MARK, ROS_1, ROS_2, read_bag
from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording

BEGINNING = 4096  # bytes by which a file is known (chosen)
WANTED = (
    "a recording (CSV, Excel, Parquet, MCAP, MAT, a bag of ROS, or a log of a flight controller)"
)
# The map is None where the header says what columns are.
Read = Callable[[Path, Content, ReadOptions], tuple[Table, ColumnMap | None]]
Write = Callable[[Recording, Path], None]
Begins = Callable[[bytes], bool]  # of a file's first BEGINNING bytes


@dataclass(frozen=True, slots=True)
class Format:
    """One kind of file."""

    name: str
    suffixes: tuple[str, ...]
    begins: Begins | None  # whether a file begins as one; None: a text
    read: Read
    write: Write | None  # None: it is read only


@contextmanager
def content_of(path: Path, memory: int | None = None) -> Generator[Content]:
    """Lend a file's bytes; of a bag that is a folder those of the file that marks it.

    ``memory``: bytes that reading may take; None: as the file's size has it.
    """
    with opened(
        path / FOLDER_MARK if is_bag_folder(path) else path, WANTED, ReadingBudget(memory)
    ) as it:
        yield it


def digest(path: Path, content: Content) -> str:
    """Return the SHA-256 of what was read, in hex; of a folder that of its files, by name."""
    if not is_bag_folder(path):
        return content.sha256()
    parts = sorted(each for each in path.iterdir() if each.is_file())
    return sha256_of(block for each in parts for block in _blocks(each))


def _blocks(path: Path) -> Iterator[bytes]:
    with opened(path, WANTED) as content:
        yield from content.blocks()


def is_bag_folder(path: Path) -> bool:
    """Say whether a path is the folder of a bag of ROS 2."""
    return (path / FOLDER_MARK).is_file()


def format_of(path: Path, content: Content) -> Format:
    """Return the format of a file: by its first bytes, then by its suffix; else it is a text."""
    return BAG if path.is_dir() else _format(path.suffix.lower(), content)


def _format(suffix: str, content: Content) -> Format:
    beginning = content[:BEGINNING]
    if beginning.startswith(tuple(KINDS)) and not is_workbook(content):
        return COMPRESSED
    marked = [each for each in FORMATS if each.begins is not None and each.begins(beginning)]
    named = [each for each in FORMATS if suffix in each.suffixes]
    return next(iter((*marked, *named)), FORMATS[0])


def format_to_write(path: Path) -> Write:
    """Return how a file of a suffix is written; InputError lists those that are."""
    suffix = path.suffix.lower()
    for each in FORMATS:
        if suffix in each.suffixes and each.write is not None:
            return each.write
    written = [each.suffixes[0] for each in FORMATS if each.write is not None]
    wanted = f"a file name ending in {', '.join(written[:-1])} or {written[-1]}"
    raise InputError(str(path), f"suffix '{suffix}'", wanted)


def _with(*marks: bytes) -> Begins:
    """Return whether a file begins with one of some bytes."""
    return lambda content: content.startswith(marks)


def _read_text(path: Path, content: Content, options: ReadOptions) -> tuple[Table, None]:
    text = _text(path, content, options)
    return table_in(text, str(path), options.layout, content.meter), None


def table_on_disk(
    path: Path,
    content: Content,
    options: ReadOptions,
    disk: Disk,
    on_progress: Callable[[float], None],
) -> Table:
    """Return the table in a text; its numbers are kept on a disk."""
    text = _text(path, content, options).watched(on_progress)
    return table_in(text, str(path), options.layout, content.meter, disk.store)


def _text(path: Path, content: Content, options: ReadOptions) -> Text:
    refuse_choice(options, str(path), "a table")
    text, source, layout = text_in(content, path, WANTED), str(path), options.layout
    if path.suffix.lower() == ".toml":
        wanted = f"{WANTED}; a testbed is given as --testbed {path}"
        raise InputError(source, "a TOML file, as a testbed is", wanted)
    if layout.skip_rows is None and layout.header:  # else a person has said where rows begin
        return with_vicon_header(with_qualisys_header(text, source), source)
    return text


def _read_inside(
    path: Path, content: Content, options: ReadOptions
) -> tuple[Table, ColumnMap | None]:
    """Return the table in the file that a compressed one holds."""
    suffixes = tuple(suffix for each in FORMATS for suffix in each.suffixes)
    name, data = unpacked(content, path, suffixes)
    inside = content.inner(data)
    kind = _format(Path(name).suffix.lower(), inside)
    if kind is COMPRESSED:
        found = f"a compressed file in a compressed file ('{name}')"
        raise InputError(str(path), found, "one that is compressed once: unpack it")
    return kind.read(path, inside, options)


def _read_workbook(path: Path, content: Content, options: ReadOptions) -> tuple[Table, None]:
    if not is_workbook(content):  # some programs write a text under such a name
        return _read_text(path, content, options)
    return read_xlsx(content, str(path), options.layout), None


def _table(read: Callable[[Content, str], Table]) -> Read:
    """Return how a table is read whose columns its header explains."""

    def reading(path: Path, content: Content, options: ReadOptions) -> tuple[Table, None]:
        refuse_choice(options, str(path), "a table")
        return read(content, str(path)), None

    return reading


def _log(read: Callable[[Content, str, ReadOptions], tuple[Table, ColumnMap]]) -> Read:
    """Return how a log is read, which says itself what its columns are."""
    return lambda path, content, options: read(content, str(path), options)


def _columns(made: Callable[[Mapping[str, Series1], str], str | bytes]) -> Write:
    """Return how a file of the native columns is written."""
    return lambda recording, path: write_whole(path, made(native_columns(recording), str(path)))


def _write_mcap(recording: Recording, path: Path) -> None:
    with whole_file(path) as temporary:
        write_mcap(recording, temporary)


COMPRESSED = Format("compressed", (), None, _read_inside, None)
BAG = Format("bag", (".bag", ".db3"), _with(ROS_1, ROS_2), read_bag, None)
FORMATS = (
    Format("csv", (".csv", ".txt", ".tsv"), None, _read_text, _columns(lambda c, _: csv_text(c))),
    Format("xlsx", (".xlsx", ".xlsm"), _with(ZIP), _read_workbook, None),
    Format("parquet", (".parquet",), _with(PARQUET), _table(read_parquet), _columns(parquet_bytes)),
    Format("mcap", (".mcap",), _with(MCAP), _log(read_mcap), _write_mcap),
    Format(
        "mat",
        (".mat",),
        _with(MAT, MAGIC_73),
        _table(read_mat),
        _columns(lambda c, _: mat_bytes(c)),
    ),
    BAG,
    Format("ulog", (".ulg", ".ulog"), _with(ULOG), _log(read_ulog), None),
    Format("dataflash", (".bin",), _with(DATAFLASH), _log(read_dataflash), None),
    Format("tlog", (".tlog",), is_tlog, _log(read_tlog), None),
    Format("vectornav", (), is_vectornav, _log(read_vectornav), None),
)
