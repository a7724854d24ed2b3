"""Which reading of an unknown table its numbers support, as a column map that reads it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import degrees
from pathlib import Path
from typing import Any

import numpy as np

from equipoise.app.arguments.inputs import fitted
from equipoise.app.arguments.map_keys import reading_keys, signed, unit_keys
from equipoise.assessment.hypotheses.inertial_unit import InertialUnit, inertial_unit
from equipoise.assessment.hypotheses.number_table import NumberTable
from equipoise.assessment.hypotheses.ranking import Ranked, TableReading, ranked
from equipoise.io.columns.column_map import ColumnMap, Columns
from equipoise.io.columns.column_map_file import MapFile, column_map_of
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.columns.sentinels import sentinel_rows
from equipoise.io.columns.table import Numbers, Table
from equipoise.io.columns.text_times import FORMATS, with_times_as_numbers
from equipoise.io.dialects.dialects import detect
from equipoise.io.recording.channels import read_time
from equipoise.io.recording.recording_file import read_table, recording_from
from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.attitude_direction import direction_of

AND = " and "  # between the names of columns whose sum is the time
MOSTLY = 0.5  # share of a column's rows that must be numbers for it to be one of numbers (chosen)


@dataclass(frozen=True, slots=True, eq=False)
class Imported:
    """A table and its readings."""

    source: str
    table: Table
    known: ColumnMap | None  # what a log, or a header of a known kind, says of the columns
    ranked: Ranked
    formats: Mapping[str, str]  # of columns that hold times as text
    unit: InertialUnit | None = None  # of a table without an attitude

    @property
    def by_header(self) -> TableReading | None:
        """Return the reading that the header means, if the numbers do not speak against it."""
        known = self.known
        return next((r for r in self.ranked.alike if known and _agrees(r, known)), None)

    def chosen(self, number: int | None) -> TableReading | InertialUnit | None:
        """Return the reading of a number (from 1), else the one to take; None: it is open."""
        if self.unit is not None and number is None:
            return self.unit
        alike = self.ranked.alike
        if number is not None:
            if not 1 <= number <= len(alike):
                raise InputError("--choose", str(number), f"1 to {len(alike)}, or nothing")
            return alike[number - 1]
        return alike[0] if self.ranked.decided else self.by_header

    def left_aside(self, columns: ColumnMap) -> tuple[str, ...]:
        """Return the columns of the table that a map does not take."""
        if columns.native:
            return ()  # whose notes name them
        parts = {part for name in columns.names for part in name.split(AND)}
        return tuple(name for name in self.table.names if name and name not in parts)

    def map_keys(self, reading: TableReading | InertialUnit, up: str) -> dict[str, Any]:
        """Return a reading as a column map file has it; the platform's axis ``up`` stands.

        InputError where the time is the sum of columns, which no such file says.
        """
        if reading.clock.column.count(AND):
            found = f"a time in several columns ({reading.clock.column})"
            raise InputError("--write-map", found, "--out, which writes the recording itself")
        return self._keys(reading, up)

    def _keys(self, reading: TableReading | InertialUnit, up: str) -> dict[str, Any]:
        if isinstance(reading, InertialUnit):
            return unit_keys(reading, up, self.formats)
        return reading_keys(reading, up, self.formats)

    def columns(self, reading: TableReading | InertialUnit, up: str) -> ColumnMap:
        """Return a reading as a column map."""
        known, header = self.known, self.by_header
        header = header if reading is header else None
        if known is not None and header is not None and _stands(header, known, up):
            return known  # which knows of masses and devices too
        return column_map_of(MapFile.model_validate(self._keys(reading, up)), self.source)


def imported(file: str | Path, options: ReadOptions) -> Imported:
    """Return the readings of a file's table; InputError if it has no number."""
    table, known = read_table(file, options)
    if known is not None:
        return Imported(str(file), table, known, Ranked((), None, decided=False), {})
    by_header = _by_header(table, options)
    if by_header is not None and len(by_header.time) > 1:
        table, by_header = _with_one_clock(table, by_header)
    numbers, formats = _numbers(table)
    if not numbers.names:
        raise InputError(str(file), "no column of numbers", "a table of a clock and of attitudes")
    found = ranked(numbers)
    unit = None if found.alike or by_header is not None else inertial_unit(numbers)
    return Imported(str(file), table, by_header, found, formats, unit)


def map_to_start_from(names: Sequence[str]) -> str:
    """Return a column map in which a person fills in what no number showed."""
    listed = ", ".join(f"'{name}'" for name in names if name)
    return (
        f"# The columns of the table: {listed}\n"
        "# Put their names for the question marks; leave out what is not there.\n\n"
        '[time]\ncolumn = "?"\nunit = "s"\n\n'
        '[attitude]\ncolumns = ["?", "?", "?", "?"]\norder = "wxyz"\n'
        'turns = "body to laboratory"\n\n'
        '[rate]\ncolumns = ["?", "?", "?"]\nunit = "rad/s"\n'
    )


def _by_header(table: Table, options: ReadOptions) -> ColumnMap | None:
    """Return what a header of a known kind says of the columns."""
    try:
        return detect(table.names, table.source, options.body)
    except InputError:
        if options.body is not None:
            raise
        return None


def by_motion(found: Imported, testbed: Testbed, bad_rows: float) -> TableReading | None:
    """Return which of readings that differ in the attitude's direction is a platform's motion.

    None where the motion does not decide, or the readings differ in more.
    """
    alike = found.ranked.alike
    if len(alike) != 2 or any(reading.gyro is not None for reading in alike):
        return None
    columns = found.columns(alike[0], axis_up(testbed))
    recording = fitted(recording_from(found.table, columns, bad_rows), testbed)
    direction = direction_of(recording, testbed)
    return alike[int(direction.is_reversed)] if direction.is_sure else None


def check_vertical(reading: TableReading | InertialUnit, source: str) -> None:
    """Raise InputError where an accelerometer shows that no axis of the laboratory points up."""
    if isinstance(reading, InertialUnit):
        return
    vertical = reading.vertical
    if vertical is None or not vertical.is_off:
        return
    named = ", ".join(f"'{name}'" for name in vertical.columns)
    found = (
        f"a vertical that is {degrees(vertical.tilt):.0f} deg from {reading.frame.lab_up} of the "
        f"laboratory, by the accelerometer {named}"
    )
    wanted = (
        "attitudes in a laboratory with one vertical axis: level its axes (the ground "
        "plane of a motion capture) and record again"
    )
    raise InputError(source, found, wanted)


def _with_one_clock(table: Table, columns: ColumnMap) -> tuple[Table, ColumnMap]:
    """Return a table whose time, the sum of several columns, is one column more, in s."""
    time = Numbers(read_time(table, columns))
    parts = [name for part in columns.time for name in part.names]
    clock = AND.join(parts)

    def column(_: Table, name: str) -> Numbers:
        return time if name == clock else table.numbers(name)

    def cell(name: str, row: int) -> str:
        return "" if name == clock else table.found(name, row).strip("'")

    whole = replace(table, names=(*table.names, clock), column=column, cell=cell)
    return whole, replace(columns, time=(Columns((clock,)),))


def axis_up(testbed: Testbed | None) -> str:
    """Return the body axis that points up, or is nearest to it: z unless a testbed says so."""
    if testbed is None:
        return "z"
    main = int(np.argmax(np.abs(testbed.up)))
    return ("-" if testbed.up[main] < 0 else "") + "xyz"[main]


def _agrees(reading: TableReading, known: ColumnMap) -> bool:
    """Say whether a header means what a reading says."""
    attitude, gyro = reading.attitude, reading.gyro
    if known.time[0].names != (reading.clock.column,) or known.inverse != attitude.inverse:
        return False
    if gyro is not None and (known.rate is None or known.rate.names != gyro.columns):
        return False
    if gyro is not None and gyro.signs != (1, 1, 1):
        return False
    if known.quaternion is not None:
        return known.quaternion.names == attitude.ordered
    return known.euler is not None and set(known.euler.columns.names) == set(attitude.columns)


def _stands(reading: TableReading, known: ColumnMap, up: str) -> bool:
    """Say whether the platform's axis ``up`` stands upright by a header, as by a reading."""
    standing = signed(known.body["xyz".index(up[-1])], -1 if up.startswith("-") else 1)
    return any(frame.is_up(known.lab_up, standing) for frame in reading.frames)


def _numbers(table: Table) -> tuple[NumberTable, dict[str, str]]:
    """Return the columns that hold numbers or times, and how times of text are written."""
    found: dict[str, Series1] = {}
    formats: dict[str, str] = {}
    for name in table.names:
        if not name or table.names.count(name) > 1:
            continue
        numbers = table.numbers(name)
        if len(numbers.garbage) <= (1 - MOSTLY) * len(table):
            found[name] = _readings(numbers.values)
        elif (written := _time_format(table, name)) is not None:
            formats[name], found[name] = written
    values = np.stack(list(found.values()), axis=1) if found else np.zeros((len(table), 0))
    return NumberTable(tuple(found), values, _units(table, tuple(found))), formats


def _readings(values: Series1) -> Series1:
    """Return a column without the numbers that stand for no reading."""
    known = values.copy()
    known[sentinel_rows(values)] = np.nan
    return known


def _units(table: Table, names: tuple[str, ...]) -> tuple[str, ...]:
    units = dict(zip(table.names, table.units, strict=False))
    return tuple(units.get(name, "") for name in names)


def _time_format(table: Table, name: str) -> tuple[str, Series1] | None:
    """Return how a column writes times as text, and the times (s); None if it does not."""
    for written in FORMATS:
        trial = ColumnMap((Columns((name,)),), time_format=written)
        try:
            return written, with_times_as_numbers(table, trial).numbers(name).values
        except InputError:
            continue
    return None
