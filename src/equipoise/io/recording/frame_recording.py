"""A pandas DataFrame in memory to a Recording, by the rules that a file meets.

Nothing here imports pandas: who has a DataFrame has loaded it.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from equipoise.io.columns.column_map import ColumnMap, Columns
from equipoise.io.columns.dated_times import DATED, seconds_since, start_note, zero_of
from equipoise.io.columns.native_columns import TIME
from equipoise.io.columns.shown_columns import is_shown, shown_map
from equipoise.io.columns.table import Numbers, Table, finite
from equipoise.io.columns.text_times import with_times_as_numbers
from equipoise.io.dialects.dialects import detect
from equipoise.io.recording.build_recording import recording_of
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording

PARTS = ("columns", "index", "iloc")  # what a DataFrame has
CLOCKS = "f" + DATED  # kinds of numpy's types that an index of times has; whole numbers may count


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """Named columns: Series, and the index where it has a name or is the time."""

    names: tuple[str, ...]
    columns: tuple[Any, ...]
    source: str

    def column(self, name: str) -> Any:
        """Return a column; InputError if several have its name."""
        if self.names.count(name) > 1:
            raise InputError(f"{self.source}, header", f"two columns '{name}'", "one")
        return self.columns[self.names.index(name)]

    def with_time(self, name: str, index: Any) -> "Frame":
        """Return the columns with the index as the time, under this name."""
        others = [(n, c) for n, c in zip(self.names, self.columns, strict=True) if c is not index]
        names = tuple(n for n, _ in others)
        return Frame((name, *names), (index, *(c for _, c in others)), self.source)


def recording_from_frame(
    frame: Any, columns: ColumnMap | None, bad_rows: float, source: str
) -> Recording:
    """Return what a DataFrame holds; InputError if it is too little or makes no sense."""
    if not all(hasattr(frame, part) for part in PARTS):
        raise InputError("from_pandas: frame", f"a {type(frame).__name__}", "a pandas DataFrame")
    if not len(frame):
        raise InputError(source, "no rows", "rows of numbers")
    own = _own(frame, source)
    if columns is None:
        known, used = _detected(own, frame.index)
    else:
        known, used = columns, _as_stated(own, frame.index, columns)
    table, known = _dated(_table(used, len(frame)), known, used)
    return recording_of(with_times_as_numbers(table, known), known, bad_rows)


def _own(frame: Any, source: str) -> Frame:
    """Return the columns, and the index first where it has a name of its own."""
    names = tuple(map(str, frame.columns))
    own = Frame(names, tuple(frame.iloc[:, i] for i in range(len(names))), source)
    name = frame.index.name
    return own if name is None or str(name) in names else own.with_time(str(name), frame.index)


def _detected(own: Frame, index: Any) -> tuple[ColumnMap, Frame]:
    """Return what the columns mean by their names; the index is the time where none of them is."""
    try:
        return _known(own), own
    except InputError:
        if TIME in own.names or not _is_clock(index):
            raise
        timed = own.with_time(TIME, index)
        known = _known(timed)
        if known.quaternion is None and known.euler is None and known.rate is None:
            raise
        return known, timed


def _known(frame: Frame) -> ColumnMap:
    return shown_map(frame.names) if is_shown(frame.names) else detect(frame.names, frame.source)


def _as_stated(own: Frame, index: Any, columns: ColumnMap) -> Frame:
    """Return the columns with the index as the time that a map names, where no column is it."""
    name = columns.time[0].names[0]
    is_missing = name not in own.names and _is_clock(index)
    return own.with_time(name, index) if is_missing else own


def _is_clock(index: Any) -> bool:
    return index.dtype.kind in CLOCKS


def _table(frame: Frame, count: int) -> Table:
    return Table(
        frame.source,
        frame.names,
        count,
        lambda _, name: _numbers(frame, name),
        cell=lambda name, row: str(np.asarray(frame.column(name), dtype=object)[row]),
        blank="NaN",
    )


def _numbers(frame: Frame, name: str) -> Numbers:
    """Return a column; NaN and None say that there is no reading."""
    column = frame.column(name)
    if column.dtype.kind in DATED:
        dates = _dates(column)
        values = seconds_since(dates, zero_of(dates))
        return finite(values, np.isnan(values))
    try:
        values = np.asarray(column.to_numpy(dtype=np.float64, na_value=np.nan))
    except (TypeError, ValueError) as error:
        where = f"{frame.source}, column '{name}'"
        raise InputError(where, f"values of type {column.dtype}", "numbers") from error
    return finite(values, np.isnan(values))


def _dates(column: Any) -> NDArray[Any]:
    """Return dates in UTC, or spans, to the nanosecond."""
    kind = "datetime64[ns]" if column.dtype.kind == "M" else "timedelta64[ns]"
    return np.asarray(column.to_numpy(kind))


def _dated(table: Table, columns: ColumnMap, frame: Frame) -> tuple[Table, ColumnMap]:
    """Return table and map where dates are the time: in seconds, whatever unit was stated."""
    name = columns.time[0].names[0]
    if name not in frame.names or frame.column(name).dtype.kind not in DATED:
        return table, columns
    notes = start_note(zero_of(_dates(frame.column(name))))
    return replace(table, notes=notes), replace(columns, time=(Columns((name,)),), time_format=None)
