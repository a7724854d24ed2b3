"""Rows that cannot be used: what is wrong with them, and how many may be left out.

One rule for every kind of file: up to a share of the rows, faulty ones are left out, counted and
named; beyond it the file is refused, and the most frequent fault says why.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from equipoise.model.arrays import Ints
from equipoise.model.errors import InputError

NAMED = 5  # places that a note names (chosen: a line of a terminal)
OFFERED = 0.5  # share of faulty rows up to which leaving them out is offered (chosen)


class RowFault(StrEnum):
    """What is wrong with a row, and how it is said of several."""

    CUT_SHORT = "with fewer cells than the header"
    TOO_WIDE = "with more cells than the header"
    NO_TIME = "without a time"
    BACKWARD = "whose time is out of order"
    STRAY = "of another time"
    REPEATED = "with a duplicate time stamp"
    NOT_A_NUMBER = "with a value that is no number"
    SENTINEL = "with a number that stands for no reading"
    BEYOND = "with a number that no bench has"
    PARTLY_BLANK = "with a blank cell beside numbers"
    NOT_UNIT = "with a quaternion that has not unit length"
    NOT_ROTATION = "with a matrix that is no rotation"


@dataclass(frozen=True, slots=True, eq=False)
class FaultyRows:
    """Rows with one fault, and the first of them as an error reports it."""

    fault: RowFault
    rows: Ints  # of the table
    where: str
    found: str
    wanted: str


def without_faulty(
    source: str, count: int, faulty: Sequence[FaultyRows], share: float, place: Callable[[int], str]
) -> tuple[str, ...]:
    """Return a note on each kind of fault in a table of ``count`` rows.

    ``share`` of the rows may be faulty, whichever the fault; InputError if more are.
    """
    kinds = {each.fault: each for each in sorted(faulty, key=lambda f: len(f.rows))}
    rows = {kind: _rows_of(kind, faulty) for kind in RowFault if kind in kinds}
    bad = _joined(list(rows.values()))
    if len(bad) > share * count:
        worst = max(rows, key=lambda kind: len(rows[kind]))
        raise _refused(source, kinds[worst], len(bad), count, share)
    return tuple(_note(kind, where, place) for kind, where in rows.items())


def _refused(source: str, worst: FaultyRows, bad: int, count: int, share: float) -> InputError:
    """Return the error for too many faulty rows, at the first with the most frequent fault."""
    where = worst.where or source
    found = worst.found if bad == 1 else f"{worst.found} ({bad} of {count} rows are faulty)"
    if bad == 1 or bad > OFFERED * count:
        return InputError(where, found, worst.wanted)
    offered = f"--bad-rows {np.ceil(100 * bad / count) / 100:g} leaves them out"
    return InputError(where, found, f"{worst.wanted}; at most {share:.3g} of the rows; {offered}")


def _rows_of(kind: RowFault, faulty: Sequence[FaultyRows]) -> Ints:
    return _joined([each.rows for each in faulty if each.fault == kind])


def _joined(rows: Sequence[Ints]) -> Ints:
    return np.unique(np.concatenate([np.zeros(0, dtype=np.int64), *rows]))


def _note(kind: RowFault, rows: Ints, place: Callable[[int], str]) -> str:
    named = ", ".join(place(int(row)) for row in rows[:NAMED])
    more = f" and {len(rows) - NAMED} more" if len(rows) > NAMED else ""
    return f"{len(rows)} row{'s' * (len(rows) != 1)} {kind}, {named}{more}; left out."
