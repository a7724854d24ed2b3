"""Recording files, both ways: CSV and Parquet, ours and other programs'."""

import hashlib
from dataclasses import replace
from pathlib import Path

import numpy as np

from equipoise.io.column_map import ColumnMap, Layout
from equipoise.io.csv_table import cut
from equipoise.io.dialects import detect, dialect_map
from equipoise.io.parquet_table import MAGIC, parquet_bytes, read_parquet
from equipoise.io.recording_columns import native_columns
from equipoise.io.recording_reading import recording_of
from equipoise.io.recording_text import csv_text
from equipoise.io.source_file import read_bytes, text_of
from equipoise.io.table import Table
from equipoise.io.whole_file import write_whole
from equipoise.model.errors import InputError, nearest
from equipoise.model.recording import CHANNELS, Recording, Samples
from equipoise.model.testbed import Testbed

WANTED = "a recording (a table as CSV or Parquet)"
TEXTS = (".csv", ".txt")
PARQUET = ".parquet"


def read_recording(
    path: str | Path, dialect: str | ColumnMap | None = None, testbed: Testbed | None = None
) -> Recording:
    """Return what a file holds, with notes on all that was set right.

    ``dialect`` is a dialect's name or a column map; None goes by the header. With a ``testbed``
    the recording may name no mass or device that it does not have. InputError says what cannot be
    used.
    """
    content = read_bytes(path, WANTED)
    layout = dialect.layout if isinstance(dialect, ColumnMap) else Layout()
    table = _table(content, str(path), layout)
    recording = recording_of(table, _columns(table, dialect))
    if testbed is not None:
        check_names(recording, testbed)
    return replace(recording, sha256=hashlib.sha256(content).hexdigest())


def write_recording(recording: Recording, path: str | Path) -> None:
    """Write a recording whole or not at all, as CSV or Parquet by the path's suffix."""
    suffix = Path(path).suffix.lower()
    if suffix not in (*TEXTS, PARQUET):
        raise InputError(str(path), f"suffix '{suffix}'", "a file name ending in .csv or .parquet")
    _check_finite(recording, str(path))
    columns = native_columns(recording)
    if suffix == PARQUET:
        write_whole(path, parquet_bytes(columns, str(path)))
    else:
        write_whole(path, csv_text(columns))


def check_names(recording: Recording, testbed: Testbed) -> None:
    """Raise InputError if the recording names a mass or device that the testbed does not have."""
    of = f" (of testbed {testbed.source or testbed.name})"
    for kind, names, known in (
        ("mass", recording.mass_names, list(testbed.mass_names)),
        ("device", recording.device_names, list(testbed.device_names)),
    ):
        for name in names:
            if name not in known:
                none = f"no {kind}: the testbed has none"
                wanted = nearest(name, known) if known else none
                raise InputError(f"{recording.source}, header", f"{kind} '{name}'", wanted + of)


def _table(content: bytes, source: str, layout: Layout) -> Table:
    if content.startswith(MAGIC):
        return read_parquet(content, source)
    return cut(text_of(content, source, WANTED), source, layout)


def _columns(table: Table, dialect: str | ColumnMap | None) -> ColumnMap:
    if isinstance(dialect, ColumnMap):
        return dialect
    if dialect is None:
        return detect(table.names, table.source)
    return dialect_map(dialect, table.names, table.source)


def _check_finite(recording: Recording, path: str) -> None:
    """Refuse to write what would come back as a blank cell."""
    for name in CHANNELS:
        channel: Samples | None = getattr(recording, name)
        if channel is not None and not np.isfinite(channel.values).all():
            raise InputError(path, f"{name} values that are not finite", "finite numbers to write")
