"""Files that grow by pieces of a recording, the same as if it were written as a whole."""

from collections.abc import Mapping
from pathlib import Path
from typing import Protocol, runtime_checkable

import numpy as np

from equipoise.io.columns.native_columns import native_columns
from equipoise.io.formats.clock_units import nanoseconds
from equipoise.io.formats.csv_table import csv_text
from equipoise.io.formats.parquet_table import arrow_columns, pyarrow_library
from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.io.mcap.mcap_recording import SLICE
from equipoise.model.arrays import Series1
from equipoise.model.recording import CHANNELS, Recording, join, rows_between


@runtime_checkable
class PieceWriter(Protocol):
    """A file that grows."""

    def add(self, piece: Recording) -> None:
        """Write rows behind all those so far."""
        ...

    def close(self) -> None:
        """End the file."""
        ...


def piece_writer(suffix: str, path: Path, like: Recording) -> PieceWriter:
    """Return what writes a file of a suffix, for pieces with the channels that ``like`` has."""
    return {".csv": CsvPieces, ".parquet": ParquetPieces, ".mcap": McapPieces}[suffix](path, like)


WRITTEN = (".csv", ".parquet", ".mcap")


def _columns(piece: Recording, names: tuple[str, ...]) -> Mapping[str, Series1]:
    """Return a piece's native columns, blank where it has no row of a channel."""
    found = native_columns(piece)
    blank = np.full(len(next(iter(found.values()))), np.nan)
    return {name: found.get(name, blank) for name in names}


class CsvPieces:
    """A text table."""

    def __init__(self, path: Path, like: Recording) -> None:
        """Begin the file with its header."""
        self._names = tuple(native_columns(like))
        self._file = path.open("w", encoding="utf-8", newline="")
        self._file.write(",".join(self._names) + "\n")

    def add(self, piece: Recording) -> None:
        """Write rows behind all those so far."""
        _, _, rows = csv_text(_columns(piece, self._names)).partition("\n")
        self._file.write(rows)

    def close(self) -> None:
        """End the file."""
        self._file.close()


class ParquetPieces:
    """A Parquet table, a row group for each piece."""

    def __init__(self, path: Path, like: Recording) -> None:
        """Begin the file."""
        self._names, self._source = tuple(native_columns(like)), str(path)
        arrow = pyarrow_library("pyarrow", self._source)
        parquet = pyarrow_library("pyarrow.parquet", self._source)
        schema = arrow.schema([(name, arrow.float64()) for name in self._names])
        self._writer = parquet.ParquetWriter(path, schema)

    def add(self, piece: Recording) -> None:
        """Write rows behind all those so far."""
        self._writer.write_table(arrow_columns(_columns(piece, self._names), self._source))

    def close(self) -> None:
        """End the file."""
        self._writer.close()


class McapPieces:
    """An MCAP file in slices of time, each of which is a chunk."""

    def __init__(self, path: Path, like: Recording) -> None:
        self._path = path
        self._file: LiveRecording | None = None
        self._first, self._since = 0.0, -np.inf
        self._held: Recording | None = None  # rows of a slice that may have more

    def add(self, piece: Recording) -> None:
        """Write rows behind all those so far."""
        whole = piece if self._held is None else join(self._held, piece)
        times = _times(whole)
        if self._file is None:
            self._first = float(times[0])
            self._file = LiveRecording(self._path, Opening(max(-nanoseconds(self._first), 0)))
        ends = np.flatnonzero(np.diff(np.floor((times - self._first) / SLICE)))
        self._write(self._file, whole, times[ends])
        self._held = rows_between(whole, self._since, np.inf)

    def close(self) -> None:
        """End the file."""
        if self._file is not None and self._held is not None:
            self._write(self._file, self._held, _times(self._held)[-1:])
            self._file.close()

    def _write(self, file: LiveRecording, rows: Recording, ends: Series1) -> None:
        for until in ends:
            file.rows(rows_between(rows, self._since, until))
            file.turn(float(until))
            self._since = float(until)


def _times(recording: Recording) -> Series1:
    channels = [c for name in CHANNELS if (c := getattr(recording, name)) is not None]
    return np.unique(np.concatenate([np.zeros(0), *(channel.t for channel in channels)]))
