"""Numbers of runs as a logbook's index keeps them: of each run its values and sd in one cell.

A cell holds doubles, value and sd in turn. Their names and units, which many runs share, are a
form, kept once. So the numbers of many runs come into arrays without a step for each number.
"""

import json
import struct
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Bools, Floats
from equipoise.model.estimate import Parameter

NAN = float("nan")  # what a version of old kept as null
Form = Sequence[tuple[str, str, bool]]  # name, unit, whether it is observable


def form_of(numbers: Iterable[tuple[str, str, bool]]) -> str:
    """Return the text of a form."""
    return json.dumps([[name, unit, bool(observable)] for name, unit, observable in numbers])


def packed(numbers: Iterable[Parameter]) -> bytes:
    """Return the cell of a run."""
    doubles = [x for p in numbers for x in (p.value, p.sd)]
    return struct.pack(f"<{len(doubles)}d", *doubles)


def unpacked(form: str, cell: bytes) -> tuple[Parameter, ...]:
    """Return the numbers of a run."""
    pairs = struct.iter_unpack("<2d", cell)
    return tuple(
        Parameter(name, unit, value, sd, observable)
        for (name, unit, observable), (value, sd) in zip(json.loads(form), pairs, strict=True)
    )


class Numbers(NamedTuple):
    """Numbers of many runs: a row for each run, a column for each name; NaN: it has none."""

    value: Floats
    sd: Floats
    observable: Bools
    there: Bools  # the run has this number


def arrays(rows: Sequence[tuple[str | None, bytes | None]], names: Sequence[str]) -> Numbers:
    """Return the numbers of these names from forms and cells of runs; None: the run has none."""
    shape = (len(rows), len(names))
    found = Numbers(np.full(shape, NAN), np.full(shape, NAN), np.zeros(shape, bool),
                    np.zeros(shape, bool))  # fmt: skip
    by_form: dict[str, list[int]] = {}
    for k, (form, _) in enumerate(rows):
        if form is not None:
            by_form.setdefault(form, []).append(k)
    for form, places in by_form.items():
        cells = b"".join(rows[k][1] or b"" for k in places)
        _fill(found, np.array(places), names, [tuple(each) for each in json.loads(form)], cells)
    return found


def _fill(
    found: Numbers, places: np.ndarray, names: Sequence[str], form: Form, cells: bytes
) -> None:
    """Write the numbers of runs that share a form."""
    numbers = np.frombuffer(cells, "<f8").reshape(len(places), len(form), 2)
    for i, (name, _, observable) in enumerate(form):
        if name in names:
            column = (places, names.index(name))
            found.value[column], found.sd[column] = numbers[:, i, 0], numbers[:, i, 1]
            found.observable[column], found.there[column] = observable, True


class PackedOfOld:
    """Aggregate of SQLite: the cell of a run from its values and sd, null for NaN."""

    def __init__(self) -> None:
        self._doubles: list[float] = []

    def step(self, value: float | None, sd: float | None) -> None:
        """Take in one number."""
        self._doubles += (NAN if x is None else x for x in (value, sd))

    def finalize(self) -> bytes:
        """Return the cell."""
        return struct.pack(f"<{len(self._doubles)}d", *self._doubles)


class FormOfOld:
    """Aggregate of SQLite: the form of a run from names, units, and whether it observed them."""

    def __init__(self) -> None:
        self._named: list[tuple[str, str, bool]] = []

    def step(self, name: str, unit: str, observable: int) -> None:
        """Take in one name."""
        self._named.append((name, unit, bool(observable)))

    def finalize(self) -> str:
        """Return the form's text."""
        return form_of(self._named)
