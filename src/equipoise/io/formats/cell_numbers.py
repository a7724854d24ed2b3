"""Cells of a text as numbers: what is blank, what says that it is no number, what is neither."""

import math
from collections.abc import Sequence

import numpy as np

from equipoise.io.columns.table import Numbers

NAN = frozenset({"nan", "na", "n/a", "#n/a", "null", "none", "-", "--"})  # words for no number


def numbers_of(cells: Sequence[str], decimal: str) -> Numbers:
    """Return a column of cells as numbers; ``decimal`` is their point."""
    try:
        values = np.array([float(cell) if cell else math.nan for cell in cells])
    except ValueError:
        values = np.array([_number(cell, decimal) for cell in cells])
    empty = np.flatnonzero(~np.isfinite(values))
    words = [cells[row].strip().lower() for row in empty.tolist()]
    nan = np.array([word in NAN for word in words], dtype=bool)
    garbage = np.array([bool(word) and word not in NAN for word in words], dtype=bool)
    values[empty] = np.nan
    return Numbers(values, empty[nan], empty[garbage])


def _number(cell: str, decimal: str) -> float:
    """Return one cell's number, NaN if it is blank or no number."""
    text = cell.strip()
    try:
        return float(text.replace(",", ".") if decimal == "," else text)
    except ValueError:
        return math.nan
