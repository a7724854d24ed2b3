"""Numbers that stand for no reading, such as -999 or 1e30.

One is taken for such only on clear evidence: it is a number that programs write so, it recurs to
the last digit, and every other number of its column is smaller by orders of magnitude.
"""

import re

import numpy as np

from equipoise.io.columns.table import no_rows
from equipoise.model.arrays import Bools, Ints, Series1

NINES = re.compile(r"9{3,}(\.9+)?")  # as texts have them
HUGE = 1e30  # no quantity of a bench is so large; 1e30, 1e37 and the largest floats are in use
TWICE = 2  # rows that must have it (chosen)
SMALLER = 100.0  # times, by which all others must be smaller (chosen)
MOSTLY = 0.5  # share of a column's numbers that must be readings (chosen)


def sentinel_rows(values: Series1) -> Ints:
    """Return the rows of a column whose number stands for no reading."""
    there = np.isfinite(values)
    if not there.any():
        return no_rows()
    size = np.where(there, np.abs(values), 0.0)
    largest = float(size.max())
    if not _stands_for_none(largest):
        return no_rows()
    marked: Bools = values == values[int(size.argmax())]
    others = size[there & ~marked]
    enough = marked.sum() >= TWICE and len(others) > MOSTLY * there.sum()
    smaller = enough and 0 < float(others.max()) <= largest / SMALLER
    return np.flatnonzero(marked) if smaller else no_rows()


def _stands_for_none(number: float) -> bool:
    return number >= HUGE or NINES.fullmatch(f"{number:.9g}".removesuffix(".0")) is not None
