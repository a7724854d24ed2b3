"""Arrays in memory to a Recording, by the rules that a file meets.

Arrays of one time make a table; those that are sampled at other times make one of their own, and
each is set right by itself. Their clocks are one: what is zero for the first is zero for all.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from equipoise.io.columns.axis_permutation import TO_Z_UP, checked_axes
from equipoise.io.columns.column_map import ColumnMap, Columns, Euler, NamedColumn
from equipoise.io.columns.table import Table, finite
from equipoise.io.recording.array_times import Times, times_of
from equipoise.io.recording.build_recording import check_enough, rows_of
from equipoise.io.recording.checked_arrays import checked, where
from equipoise.io.toml.units import factor
from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError, nearest
from equipoise.model.recording import CHANNELS, Recording

ORDERS = ("wxyz", "xyzw")
TURNS = ("body to laboratory", "laboratory to body")
SEQUENCE = re.compile("[XYZ]{3}|[xyz]{3}")
VECTORS = ("momentum", "torque", "field")
TIME = "t"


@dataclass(frozen=True, slots=True, eq=False)
class Stated:
    """What ``Recording.from_arrays`` is given; see there."""

    t: Any
    q: Any
    order: str
    euler: Any
    sequence: str | None
    euler_unit: str
    turns: str
    rate: Any
    rate_unit: str
    rate_t: Any
    masses: Mapping[str, Any] | None
    masses_t: Any
    momentum: Any
    torque: Any
    field: Any
    lab_up: str
    body: tuple[str, str, str]
    source: str


@dataclass(frozen=True, slots=True, eq=False)
class Group:
    """Arrays of one time: the fields of their column map, and the columns that those name."""

    meaning: dict[str, Any]
    columns: dict[str, Floats]


def recording_from_arrays(stated: Stated, bad_rows: float) -> Recording:
    """Return what the arrays hold; InputError names the argument that cannot be used."""
    _check_words(stated)
    times = times_of(stated.t, {"rate_t": stated.rate_t, "masses_t": stated.masses_t})
    groups = {name: _group(stated, times, name) for name in times.seconds}
    found = [
        _rows(stated, group, times, name, bad_rows)
        for name, group in groups.items()
        if group.columns
    ]
    if not found:
        raise InputError("from_arrays", "neither q, euler nor rate", "at least one of them")
    whole = _merged(found)
    check_enough(stated.source, whole)
    return replace(whole, source=stated.source, notes=(*times.notes, *whole.notes))


def _check_words(stated: Stated) -> None:
    """Raise InputError for a word that means nothing, or that lacks."""
    known = {"order": ORDERS, "turns": TURNS, "lab_up": tuple(TO_Z_UP)}
    for name, words in known.items():
        word: str = getattr(stated, name)
        if word not in words:
            raise InputError(where(name), f"'{word}'", nearest(word, words))
    if stated.q is not None and stated.euler is not None:
        raise InputError(where("q and euler"), "both", "one of them")
    if stated.euler is not None and not SEQUENCE.fullmatch(stated.sequence or ""):
        found = "none" if stated.sequence is None else f"'{stated.sequence}'"
        raise InputError(where("sequence"), found, "three letters, such as 'ZYX' or 'xyz'")
    _check_body(stated.body)


def _check_body(body: Sequence[str]) -> None:
    if len(body) != len("xyz") or not {*body} <= {*TO_Z_UP}:
        raise InputError(where("body"), f"{body}", "three axes, such as ('x', '-z', 'y')")
    checked_axes(body, where("body"))


def _group(stated: Stated, times: Times, time: str) -> Group:
    """Return the arrays of one time."""
    count = len(times.seconds[time])
    parts = [
        _attitude(stated, count) if time == TIME else Group({}, {}),
        _rate(stated, time, count) if time == times.of("rate_t") else Group({}, {}),
        _masses(stated, time, count) if time == times.of("masses_t") else Group({}, {}),
        *(_vector(stated, name, count) for name in VECTORS if time == TIME),
    ]
    meaning = {key: value for part in parts for key, value in part.meaning.items()}
    return Group(meaning, {name: c for part in parts for name, c in part.columns.items()})


def _attitude(stated: Stated, count: int) -> Group:
    inverse = {"inverse": stated.turns == TURNS[1]}
    if stated.q is not None:
        columns = _named(checked("q", stated.q, (count, 4), TIME), "q", stated.order)
        return Group({"quaternion": Columns(tuple(f"q_{c}" for c in "wxyz")), **inverse}, columns)
    if stated.euler is None:
        return Group({}, {})
    unit = factor(stated.euler_unit, "angle", where("euler_unit"))
    columns = _named(checked("euler", stated.euler, (count, 3), TIME), "euler", "123")
    return Group({"euler": Euler(Columns(tuple(columns), unit), stated.sequence or ""), **inverse},
                 columns)  # fmt: skip


def _rate(stated: Stated, time: str, count: int) -> Group:
    if stated.rate is None:
        return Group({}, {})
    unit = factor(stated.rate_unit, "rate", where("rate_unit"))
    columns = _named(checked("rate", stated.rate, (count, 3), time), "rate", "xyz")
    return Group({"rate": Columns(tuple(columns), unit)}, columns)


def _masses(stated: Stated, time: str, count: int) -> Group:
    columns = {
        f"masses['{name}']": checked(f"masses['{name}']", values, (count,), time)
        for name, values in (stated.masses or {}).items()
    }
    named = zip(stated.masses or {}, columns, strict=True)
    return Group({"masses": tuple(NamedColumn(name, at, 1.0) for name, at in named)}, columns)


def _vector(stated: Stated, name: str, count: int) -> Group:
    values = getattr(stated, name)
    if values is None:
        return Group({}, {})
    columns = _named(checked(name, values, (count, 3), TIME), name, "xyz")
    return Group({name: Columns(tuple(columns))}, columns)


def _named(values: Floats, name: str, letters: str) -> dict[str, Floats]:
    """Return the columns of an array by their names."""
    return {f"{name}_{letter}": column for letter, column in zip(letters, values.T, strict=True)}


def _rows(stated: Stated, group: Group, times: Times, time: str, bad_rows: float) -> Recording:
    """Return the recording of one table."""
    columns = {time: times.seconds[time], **group.columns}
    source = stated.source if time == TIME else f"{stated.source} ({time})"
    table = Table(
        source,
        tuple(columns),
        len(columns[time]),
        lambda _, name: finite(columns[name]),
        cell=lambda name, row: str(columns[name][row]),
        blank="NaN in all of the row",
    )
    return rows_of(
        table,
        ColumnMap((Columns((time,)),), lab_up=stated.lab_up, body=stated.body, **group.meaning),
        bad_rows,
    )


def _merged(parts: Sequence[Recording]) -> Recording:
    """Return recordings of different channels as one."""
    first, *others = parts
    for other in others:
        names = (*CHANNELS, "attitude_norm", "mass_names")
        more: dict[str, Any] = {n: getattr(other, n) for n in names if getattr(other, n)}
        notes, gaps = (*first.notes, *other.notes), (*first.gaps, *other.gaps)
        first = replace(first, notes=notes, gaps=gaps, **more)
    return first
