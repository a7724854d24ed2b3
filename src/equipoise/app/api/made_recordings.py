"""Recordings of arrays and tables in memory, as ``eq.Recording`` makes them (``from_memory``)."""

from pathlib import Path
from typing import Any

from equipoise.app.arguments.checks import share
from equipoise.io.columns.column_map_file import read_column_map
from equipoise.io.recording.frame_recording import recording_from_frame
from equipoise.io.recording.in_memory import Stated, recording_from_arrays
from equipoise.model.recording import Recording


def from_arrays(bad_rows: float, **stated: Any) -> Recording:
    """Return the recording that arrays hold; InputError names the argument that is wrong."""
    return recording_from_arrays(Stated(**stated), share("bad_rows", bad_rows))


def from_pandas(frame: Any, columns: str | Path | None, bad_rows: float, source: str) -> Recording:
    """Return the recording that a DataFrame holds; InputError for columns that are wrong."""
    stated = None if columns is None else read_column_map(columns)
    return recording_from_frame(frame, stated, share("bad_rows", bad_rows), source)
