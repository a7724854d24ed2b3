"""Testbeds and recordings, from files and into them."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from equipoise.app.arguments.inputs import part_of, read_options
from equipoise.app.arguments.options import Reading
from equipoise.io.columns.read_options import BAD_ROWS
from equipoise.io.recording import recording_file
from equipoise.io.testbed import testbed_file
from equipoise.io.testbed.presets import read_preset
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed


def read_testbed(path: str | Path) -> Testbed:
    """Return the testbed that a TOML file describes, in SI units.

    Raises
    ------
    InputError
        With file, key, what was found and what was wanted.
    """
    return testbed_file.read_testbed(path)


def preset(name: str) -> Testbed:
    """Return a testbed that ships with the package, such as ``"sputnix"``, in SI units.

    Raises
    ------
    InputError
        For an unknown name, with the nearest known one.
    """
    return read_preset(name)


def read_recording(
    path: str | Path,
    *,
    dialect: str | None = None,
    columns: str | Path | None = None,
    topics: Sequence[str] = (),
    body: str | None = None,
    instance: int | None = None,
    bad_rows: float = BAD_ROWS,
    max_memory_mb: float | None = None,
    start: float | None = None,
    end: float | None = None,
) -> Recording:
    """Return what a file holds: channels in SI units, each at its own times.

    Parameters
    ----------
    path
        CSV, Parquet, MCAP, MAT, or a log of another program.
    dialect
        How to read a table: native, optitrack, vicon, qualisys, phyphox, ros or euler. None: by
        its header.
    columns
        Column map (TOML) for a table of any other kind.
    topics
        Topics of a log to take, where it has several.
    body
        Body of a motion-capture export to take, where it has several.
    instance
        Which of a log's sensors of one kind to take, counted from 0.
    bad_rows
        Share of the rows that may be left out as faulty; with more the file is refused.
    max_memory_mb
        What reading the file may take, in MB. None: 64 times the file, at least 256, at most 2000.
    start
        Leave out what is before this time, s. None: keep it; verbs then leave out what a bench's
        own recording has from before the platform was let go.
    end
        Leave out what is after this time, s.

    Raises
    ------
    InputError
        For what cannot be read, with file, line or column; for ``dialect`` beside ``columns``; for
        times that leave fewer than three rows.
    """
    named = None if columns is None else str(columns)
    reading = Reading(
        None, None, dialect, named, tuple(topics), body, instance, bad_rows, max_memory_mb
    )
    recording = recording_file.read_recording(path, read_options(reading))
    if start is None and end is None:
        return recording
    part = part_of(recording, start, end)
    return part if start is None else replace(part, free_from=None)


def write_recording(recording: Recording, path: str | Path) -> None:
    """Write a recording whole or not at all, in the format of the path's suffix.

    The suffix is .csv, .parquet, .mcap or .mat; columns have their units in their names.

    Raises
    ------
    InputError
        For another suffix, and for values that are not finite.
    """
    recording_file.write_recording(recording, path)
