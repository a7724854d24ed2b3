"""Which variables of a MAT file make a table: those with the most common number of rows.

A vector is a column of its name; a matrix of n rows is columns ``name(1)``, ``name(2)`` and so on,
also where it lies on its side. Scalars, square matrices (an inertia, a turn) and what has another
number of rows are left out, with a note.
"""

from collections import Counter
from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from equipoise.model.arrays import Series1

Array = NDArray[np.float64]  # of any shape
DEEPEST = 3  # structures within structures that are opened (chosen)
WIDEST = 64  # columns of a matrix that is a table (chosen)
LYING = 16  # rows, at most, of a matrix with more columns that is turned upright (chosen)
LISTED = 12  # variables that a note names (chosen)


def table_columns(variables: Mapping[str, Array]) -> tuple[dict[str, Series1], tuple[str, ...]]:
    """Return the columns of a table, all of one length, and notes; none if nothing fits."""
    upright = {name: _upright(values) for name, values in variables.items()}
    counts: Counter[int] = Counter()
    for matrix in upright.values():
        if matrix is not None:
            counts[len(matrix)] += matrix.shape[1]
    rows = max(counts, key=lambda count: (counts[count], count), default=0)
    columns: dict[str, Series1] = {}
    left: list[str] = []
    for name, matrix in upright.items():
        if matrix is None or len(matrix) != rows:
            left.append(name)
        else:
            columns.update(_named(name, matrix))
    note = f"Left out of the table of {rows} rows: {listed(variables, left)}."
    return columns, (note,) if left else ()


def listed(variables: Mapping[str, Array], names: Iterable[str]) -> str:
    """Return names of variables with their sizes, such as 'J' (3 x 3)."""
    texts = [f"'{name}' ({' x '.join(map(str, variables[name].shape))})" for name in names]
    more = f" and {len(texts) - LISTED} more" if len(texts) > LISTED else ""
    return ", ".join(texts[:LISTED]) + more


def _upright(values: Array) -> Array | None:
    """Return a matrix with a row for each reading; None if it is none."""
    if values.ndim != 2 or values.shape[0] == values.shape[1] or not values.size:
        return None
    rows, columns = values.shape
    turned = values.T if rows == 1 or rows <= LYING < columns else values
    return turned if turned.shape[1] <= WIDEST else None


def _named(name: str, matrix: Array) -> dict[str, Series1]:
    if matrix.shape[1] == 1:
        return {name: matrix[:, 0]}
    return {f"{name}({k})": column for k, column in enumerate(matrix.T, 1)}
