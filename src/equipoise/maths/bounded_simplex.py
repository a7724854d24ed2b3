"""The simplex method for three rows and bounded variables (Dantzig 1955), compiled.

    minimise  c x,    A x = b (three rows),    0 <= x <= upper

Whoever calls lays out a table whose three basic columns are unit columns with values within their
bounds; it is changed in place. Columns that are not basic stand at 0, or at their upper bound
(``full``). A programme of some ten columns takes about a microsecond.

The column that wins most per unit enters; after many pivots the first that wins anything does, lest
degenerate tables cycle. Gives up after ``MOST`` pivots where the table is, still within all bounds.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Bools, Floats, Ints

TINY, WON = 1e-9, 1e-15  # -, chosen: a pivot, and a share of the costs, that are rounding
GREEDY, MOST = 40, 120  # pivots, chosen: tables as here take about ten


class Table(NamedTuple):
    """A programme and where it stands."""

    rows: Floats  # (3, n) A in the basis of the basic columns
    basic: Ints  # (3,) column of each row
    value: Floats  # (3,) of the basic columns
    cost: Floats  # (n,)
    upper: Floats  # (n,)
    full: Bools  # (n,) not basic, at its upper bound


@part
def is_basic(at: Table, j: int) -> bool:
    """Say whether a column is basic."""
    return j == at.basic[0] or j == at.basic[1] or j == at.basic[2]


@part
def level_of(at: Table, j: int) -> float:
    """Return x_j."""
    for i in range(3):
        if at.basic[i] == j:
            return at.value[i]
    return at.upper[j] if at.full[j] else 0.0


@part
def entering(at: Table, first: bool) -> int:
    """Return the column that lowers the cost most, or the first that does; -1: none."""
    best, most = -1, 0.0
    a, b, c = at.cost[at.basic[0]], at.cost[at.basic[1]], at.cost[at.basic[2]]
    for j in range(at.cost.shape[0]):
        if at.upper[j] > 0 and not is_basic(at, j):
            won = a * at.rows[0, j] + b * at.rows[1, j] + c * at.rows[2, j] - at.cost[j]
            won = -won if at.full[j] else won
            if won > max(most, WON * (at.cost[j] + a + b + c)):
                best, most = j, np.inf if first else won
    return best


@part
def reach_of(at: Table, j: int, way: float, i: int) -> float:
    """Return how far column j may go before the basic column of row i is at a bound."""
    slope = way * at.rows[i, j]
    if slope > TINY:
        return max(at.value[i] / slope, 0.0)
    if slope < -TINY:
        return max((at.value[i] - at.upper[at.basic[i]]) / slope, 0.0)
    return np.inf


@part
def clear(at: Table, out: int, j: int) -> None:
    """Make column j the unit column of row ``out``."""
    share = 1.0 / at.rows[out, j]
    for c in range(at.cost.shape[0]):
        at.rows[out, c] *= share
    for i in range(3):
        times = 0.0 if i == out else at.rows[i, j]
        for c in range(at.cost.shape[0]):
            at.rows[i, c] -= times * at.rows[out, c]


@part
def pivot(at: Table, j: int) -> None:
    """Let column j change as far as bounds allow; the basic column at its bound first goes out."""
    way, step, out = (-1.0 if at.full[j] else 1.0), at.upper[j], -1
    for i in range(3):
        reach = reach_of(at, j, way, i)
        if reach < step:
            step, out = reach, i
    for i in range(3):
        at.value[i] -= step * way * at.rows[i, j]
    if out < 0:
        at.full[j] = not at.full[j]
        return
    at.full[at.basic[out]] = way * at.rows[out, j] < 0
    at.value[out] = (at.upper[j] if at.full[j] else 0.0) + way * step
    at.basic[out], at.full[j] = j, False
    clear(at, out, j)


@part
def minimise(at: Table) -> None:
    """Bring the table to its optimum, in place."""
    for count in range(MOST):
        j = entering(at, count >= GREEDY)
        if j < 0:
            return
        pivot(at, j)
