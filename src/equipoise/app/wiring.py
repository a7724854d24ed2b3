"""From what a person types to objects: a testbed, a recording, moves."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np

from equipoise.io.column_map import ColumnMap
from equipoise.io.column_map_file import read_column_map
from equipoise.io.frame_check import check_frame
from equipoise.io.presets import preset_names, read_preset
from equipoise.io.recording_file import read_recording
from equipoise.io.testbed_file import read_testbed
from equipoise.model.errors import InputError, nearest
from equipoise.model.recording import Recording, Samples, window
from equipoise.model.testbed import Testbed

MOVE = re.compile(r"\s*(?P<time>[^:\s]+)\s*:\s*(?P<goals>\S+=\S+(?:[\s,]+\S+=\S+)*)\s*")
WANTED_MOVE = "'seconds: mass=mm mass=mm', such as '60: x1=-10 z1=-50'"
FEWEST = 3  # rows of a sensor that a window must leave, as when a file is read


def testbed_of(name: str) -> Testbed:
    """Return the testbed of a file, or of a preset when there is no such file."""
    if not Path(name).exists() and name in preset_names():
        return read_preset(name)
    if not Path(name).exists() and Path(name).name == name and not Path(name).suffix:
        wanted = f"a testbed file, or a preset ({nearest(name, list(preset_names()))})"
        raise InputError("testbed", f"'{name}', which is no file", wanted)
    return read_testbed(name)


def recording_of(file: str, dialect: str | None, columns: str | None) -> Recording:
    """Return a recording as it is."""
    return read_recording(file, _columns(dialect, columns))


def fitting_recording_of(
    file: str, dialect: str | None, columns: str | None, testbed: Testbed
) -> Recording:
    """Return a recording that fits a testbed: masses are the testbed's, gravity points down."""
    recording = read_recording(file, _columns(dialect, columns), testbed)
    check_frame(recording, testbed)
    return with_masses_of(recording, testbed)


def with_masses_of(recording: Recording, testbed: Testbed) -> Recording:
    """Return the recording with a column for every mass of the testbed, in its order.

    A mass that was not recorded is taken to have stayed at home.
    """
    rows, names = recording.masses, tuple(mass.name for mass in testbed.masses)
    if rows is None or recording.mass_names == names:
        return recording
    values = np.zeros((len(rows), len(names)))
    for column, name in zip(rows.values.T, recording.mass_names, strict=True):
        values[:, names.index(name)] = column
    return replace(recording, mass_names=names, masses=Samples(rows.t, values))


def _columns(dialect: str | None, columns: str | None) -> str | ColumnMap | None:
    if dialect is not None and columns is not None:
        raise InputError("--dialect and --columns", "both", "one of them")
    return dialect if columns is None else read_column_map(columns)


def part_of(recording: Recording, start: float | None, end: float | None) -> Recording:
    """Return the part between two times (s); None stands for the end that there is."""
    first, last = recording.span
    part = window(recording, first if start is None else start, last if end is None else end)
    if max(len(c) for c in (part.attitude, part.rate, ()) if c is not None) < FEWEST:
        found = f"fewer than {FEWEST} rows between --from-s and --to-s"
        raise InputError(recording.source, found, f"times within {first:g} to {last:g} s")
    return part


def move_of(text: str, testbed: Testbed) -> tuple[float, dict[str, float]]:
    """Return time (s) and displacements from home (m) of a move such as '60: x1=-10 z1=-50'."""
    read = MOVE.fullmatch(text)
    if read is None:
        raise InputError("--move", f"'{text}'", WANTED_MOVE)
    pairs = [goal.split("=", 1) for goal in re.split(r"[\s,]+", read["goals"])]
    known = [mass.name for mass in testbed.masses]
    for name, _ in pairs:
        if name not in known:
            wanted = nearest(name, known) if known else "no move: the testbed has no masses"
            raise InputError(f"--move '{text}'", f"mass '{name}'", wanted)
    return _number(read["time"], text), {n: _number(mm, text) * 1e-3 for n, mm in pairs}


def _number(word: str, text: str) -> float:
    try:
        return float(word)
    except ValueError as error:
        raise InputError(f"--move '{text}'", f"'{word}'", "a number") from error
