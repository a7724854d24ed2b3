"""Columns that seem to say what drove a platform, by their names, and that no map reads.

A name is cut into words at its signs, digits and capitals ('RW1 speed', 'cmdTorqueX'). Words that
the attitude, the gyro or the clock bear too, such as the platform's name, say nothing. What is
commanded of a device whose reports are read is accounted for by these.

Cannot know a column whose name means nothing, nor one that is misnamed.
"""

import re
from collections.abc import Mapping

import numpy as np

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.table import Table
from equipoise.model.errors import InputError
from equipoise.model.unread_input import InputKind, UnreadInput

WORD = re.compile("[A-Z]+(?=[A-Z][a-z])|[A-Z]?[a-z]+|[A-Z]+")
Kind = InputKind
# Parts of words, and words, in order of trial: a magnetorquer is no torque.
MARKS: Mapping[InputKind, re.Pattern[str]] = {
    Kind.GIMBAL: re.compile(".*gimbal.*|cmgs?"),
    Kind.WHEEL: re.compile(".*wheel.*|rws?|rpm|tacho"),
    Kind.CAGE: re.compile(".*helmholtz.*|cages?"),
    Kind.DIPOLE: re.compile(".*dipole.*|.*torquer.*|mt[qb]s?|coils?"),
    Kind.JET: re.compile(".*thrust.*|jets?|valves?|nozzles?|rcs"),
    Kind.MASS: re.compile(".*slider.*|mass|masses|stages?|steppers?"),
    Kind.MOMENTUM: re.compile(".*momentum.*"),
    Kind.TORQUE: re.compile(".*torques?|tau"),
    Kind.COMMAND: re.compile("cmds?|command.*|setpoints?|pwm|duty|throttle|motors?|esc|dac|servos?"
                             "|actuators?"),
}  # fmt: skip
ORDERED = re.compile(f"{MARKS[Kind.COMMAND].pattern}|currents?|voltages?|torques?")
BESIDE = frozenset(["temp", "temperature", "time", "timestamp", "stamp", "id", "error", "status"])
READ_BY = {
    "momentum": (Kind.MOMENTUM, Kind.WHEEL, Kind.GIMBAL),
    "torque": (Kind.TORQUE, Kind.DIPOLE, Kind.JET),
    "masses": (Kind.MASS,),
}


def words_of(name: str) -> frozenset[str]:
    """Return the words of a column's name, in small letters."""
    return frozenset(word.lower() for word in WORD.findall(name))


def kind_of(words: frozenset[str]) -> InputKind | None:
    """Return what words say of an input; None: nothing."""
    return next((k for k, mark in MARKS.items() if any(map(mark.fullmatch, words))), None)


def unread_inputs(table: Table, columns: ColumnMap) -> tuple[UnreadInput, ...]:
    """Return the columns of inputs that a map does not read and that change."""
    names, common = columns.names, _sensor_words(columns)
    read = _read_kinds(columns)
    found = [
        _changing(table, name, kind)
        for name in dict.fromkeys(table.names)
        if name and name not in names and not BESIDE & words_of(name)
        for words in (words_of(name) - common,)
        if (kind := kind_of(words)) is not None and not _is_accounted_for(kind, words, read)
    ]
    return tuple(each for each in found if each is not None)


def _is_accounted_for(kind: InputKind, words: frozenset[str], read: frozenset[InputKind]) -> bool:
    """Say whether a column is a command to what has its own reports."""
    if kind is Kind.COMMAND:
        return bool(read)
    return kind in read and any(map(ORDERED.fullmatch, words))


def _changing(table: Table, name: str, kind: InputKind) -> UnreadInput | None:
    try:
        values = table.numbers(name).values
    except InputError:  # of words
        return None
    if not np.isfinite(values).any():
        return None
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    return UnreadInput(name, kind, low, high) if high > low else None


def _sensor_words(columns: ColumnMap) -> frozenset[str]:
    named = [words_of(name) for each in columns.sensed for name in each.names]
    return frozenset[str]().union(*named)


def _read_kinds(columns: ColumnMap) -> frozenset[InputKind]:
    devices = [InputKind(each.name.partition(":")[0]) for each in columns.devices]
    inputs = [kind for name, kinds in READ_BY.items() if getattr(columns, name) for kind in kinds]
    return frozenset([*devices, *inputs])
