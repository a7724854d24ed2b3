"""The recordings of a series as files of one folder: run_01.csv, run_02.csv and so on."""

from collections.abc import Sequence
from pathlib import Path

from equipoise.io.columns.native_columns import native_columns
from equipoise.io.formats.csv_table import csv_text
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording

DIGITS = 2  # of a run's number, at least: names sort as runs follow


def name_of(run: int, runs: int) -> str:
    """Return the name of a run's file without its suffix; the first is number 1."""
    return f"run_{run:0{max(DIGITS, len(str(runs)))}d}"


def recordings_of(recordings: Sequence[Recording]) -> dict[str, str | bytes]:
    """Return the files of recordings by name."""
    count = len(recordings)
    return {
        f"{name_of(k, count)}.csv": csv_text(native_columns(recording))
        for k, recording in enumerate(recordings, 1)
    }


def check_series_folder(option: str, folder: Path) -> None:
    """Raise InputError for a name that is that of one file."""
    if folder.suffix and not folder.is_dir():
        raise InputError(f"{option} {folder}", "the name of a file", "a folder for the series")
