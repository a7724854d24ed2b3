"""Cells of a text as numbers: what is blank, what says that it is no number, what is neither."""

import math
import re
from collections.abc import Sequence

import numpy as np

from equipoise.io.columns.table import Numbers
from equipoise.model.arrays import Series1

FORTRAN = re.compile(r"([+-]?(?:\d+(?:\.\d*)?|\.\d+))[dD]([+-]?\d+)")  # 1.0D+00
NAN = frozenset({"nan", "na", "n/a", "#n/a", "null", "none", "-", "--"})  # words for no number


def numbers_of(cells: Sequence[str], decimal: str) -> Numbers:
    """Return a column of cells as numbers; ``decimal`` is their point."""
    values = _values(cells, decimal)
    empty = np.flatnonzero(~np.isfinite(values))
    if not len(empty):
        return Numbers(values)
    words = [cells[row] for row in empty.tolist()]
    plain = {word: word.strip().lower() for word in set(words)}  # a column repeats its words
    nan = np.array([plain[word] in NAN for word in words], dtype=bool)
    garbage = np.array([plain[word] != "" for word in words], dtype=bool) & ~nan
    values[empty] = np.nan
    return Numbers(values, empty[nan], empty[garbage])


def _values(cells: Sequence[str], decimal: str) -> Series1:
    try:
        if "" in cells:
            return np.array([float(cell) if cell else math.nan for cell in cells])
        return np.fromiter(map(float, cells), np.float64, len(cells))
    except ValueError:
        found = {cell: _number(cell, decimal) for cell in set(cells)}
        return np.array([found[cell] for cell in cells])


def _number(cell: str, decimal: str) -> float:
    """Return one cell's number, NaN if it is blank or no number."""
    number = number_in(cell, decimal)
    return math.nan if number is None else number


def number_in(cell: str, decimal: str) -> float | None:
    """Return the number that a cell holds, also as Fortran prints it (1.0D+00); else None."""
    text = cell.replace(",", ".") if decimal == "," else cell
    try:
        return float(text)
    except ValueError:
        fortran = FORTRAN.fullmatch(text.strip())
        return float(f"{fortran[1]}e{fortran[2]}") if fortran else None
