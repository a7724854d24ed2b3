"""Recording files, both ways, ours and other programs'; ``format_registry`` lists the kinds."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.read_options import AS_IT_IS, ReadOptions
from equipoise.io.columns.table import Table
from equipoise.io.columns.text_times import with_times_as_numbers
from equipoise.io.dialects.dialects import detect, dialect_map
from equipoise.io.recording.build_recording import recording_of
from equipoise.io.recording.format_registry import (
    WANTED,
    content_of,
    digest,
    format_of,
    format_to_write,
)
from equipoise.model.errors import InputError, declared, nearest
from equipoise.model.recording import CHANNELS, Recording, Samples
from equipoise.model.testbed import Testbed


def read_recording(path: str | Path, options: ReadOptions = AS_IT_IS) -> Recording:
    """Return what a file holds, with notes on all that was set right.

    InputError says what cannot be used.
    """
    with declared(str(path), WANTED), content_of(Path(path), options.max_memory) as content:
        table, known = format_of(Path(path), content).read(Path(path), content, options)
        recording = recording_from(table, columns_for(table, known, options), options.bad_rows)
        return replace(recording, sha256=digest(Path(path), content))


def read_table(path: str | Path, options: ReadOptions = AS_IT_IS) -> tuple[Table, ColumnMap | None]:
    """Return the table in a file, and what its columns mean where the file itself says so."""
    with declared(str(path), WANTED), content_of(Path(path), options.max_memory) as content:
        return format_of(Path(path), content).read(Path(path), content, options)


def recording_from(table: Table, columns: ColumnMap, bad_rows: float) -> Recording:
    """Return what a table holds by a map of its columns; InputError if it makes no sense."""
    return recording_of(with_times_as_numbers(table, columns), columns, bad_rows)


def write_recording(recording: Recording, path: str | Path) -> None:
    """Write a recording whole or not at all, in the format of the path's suffix."""
    write = format_to_write(Path(path))
    check_finite(recording, str(path))
    write(recording, Path(path))


def check_names(recording: Recording, testbed: Testbed) -> None:
    """Raise InputError if the recording names a mass or device that the testbed does not have."""
    of = f"which testbed {testbed.source or testbed.name} does not have"
    for kind, names, known in (
        ("mass", recording.mass_names, list(testbed.mass_names)),
        ("device", recording.device_names, list(testbed.device_names)),
    ):
        for name in names:
            if name not in known:
                wanted = nearest(name, known) if known else f"no {kind}: the testbed has none"
                raise InputError(f"{recording.source}, header", f"{kind} '{name}', {of}", wanted)


def columns_for(table: Table, known: ColumnMap | None, options: ReadOptions) -> ColumnMap:
    """Return what a table's columns mean: as given, as its format states, or by the header."""
    dialect, body = options.dialect, options.body
    if options.columns is not None and body is not None:
        raise InputError("--body and --columns", "both", "the columns of the body, or its name")
    if options.columns is not None:
        return options.columns
    if known is not None and dialect is not None:
        found = f"dialect '{dialect}' for a self-describing log"
        raise InputError(table.source, found, "no dialect, or a column map (--columns)")
    if known is not None:
        return known
    if dialect is None:
        return detect(table.names, table.source, body)
    return dialect_map(dialect, table.names, table.source, body)


def check_finite(recording: Recording, path: str) -> None:
    """Refuse to write what would come back as a blank cell."""
    for name in CHANNELS:
        channel: Samples | None = getattr(recording, name)
        if channel is not None and not np.isfinite(channel.values).all():
            raise InputError(path, f"{name} values that are not finite", "finite numbers to write")
