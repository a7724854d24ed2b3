"""Numbers that stand for no reading, such as -999 or 1e30.

One is taken for such only on clear evidence: it is a number that programs write so, it recurs to
the last digit, and every other number of its column is smaller by orders of magnitude.
"""

import re
from dataclasses import dataclass

import numpy as np

from equipoise.io.columns.table import no_rows
from equipoise.model.arrays import Bools, Ints, Series1

NINES = re.compile(r"9{3,}(\.9+)?")  # as texts have them
HUGE = 1e30  # no quantity of a bench is so large; 1e30, 1e37 and the largest floats are in use
TWICE = 2  # rows that must have it (chosen)
SMALLER = 100.0  # times, by which all others must be smaller (chosen)
MOSTLY = 0.5  # share of a column's numbers that must be readings (chosen)


@dataclass(frozen=True, slots=True)
class Largest:
    """The number of a column that is largest in size, and what else there is."""

    value: float = 0.0
    count: int = 0  # rows that have it
    others: float = 0.0  # the largest size of all other numbers
    numbers: int = 0  # rows with any

    @property
    def sentinel(self) -> float | None:
        """Return the number if it stands for no reading."""
        others = self.numbers - self.count
        enough = self.count >= TWICE and others > MOSTLY * self.numbers
        smaller = enough and 0 < self.others <= abs(self.value) / SMALLER
        return self.value if smaller and _stands_for_none(abs(self.value)) else None

    def joined(self, after: "Largest") -> "Largest":
        """Return this of a column of which both are parts, one after the other."""
        numbers = self.numbers + after.numbers
        if self.value == after.value:
            others = max(self.others, after.others)
            return Largest(self.value, self.count + after.count, others, numbers)
        first, second = (self, after) if abs(self.value) >= abs(after.value) else (after, self)
        return Largest(first.value, first.count, max(first.others, abs(second.value)), numbers)


def largest_of(values: Series1) -> Largest:
    """Return the number of a column that is largest in size, the first of those."""
    there = np.isfinite(values)
    if not there.any():
        return Largest()
    size = np.where(there, np.abs(values), -1.0)
    value = float(values[int(size.argmax())])
    marked: Bools = values == value
    size[marked] = -1.0
    return Largest(value, int(marked.sum()), max(float(size.max()), 0.0), int(there.sum()))


def sentinel_rows(values: Series1) -> Ints:
    """Return the rows of a column whose number stands for no reading."""
    sentinel = largest_of(values).sentinel
    return no_rows() if sentinel is None else np.flatnonzero(values == sentinel)


def _stands_for_none(number: float) -> bool:
    return number >= HUGE or NINES.fullmatch(f"{number:.9g}".removesuffix(".0")) is not None
