"""The viscous friction of air pads on a table, as a map: bilinear between nodes of a grid.

    F = -c(x, y) v,      c(x, y) = sum_k c_k phi_k(x, y)

c_k are the coefficients (N s/m) at the nodes and phi_k their hat functions. Beyond the grid the map
goes on as at its edge. A film of air shears and has no dry friction: a pad that scrapes has, and
that is not in this model.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.kernels.compiled import kernel, part
from equipoise.model.arrays import Floats, Series


class FrictionMap(NamedTuple):
    """A grid of nodes on the table, laboratory axes."""

    low_x: float  # m, of the first node
    low_y: float  # m
    step_x: float  # m, from node to node
    step_y: float  # m
    values: Floats  # (nx, ny) N s/m


class Hat(NamedTuple):
    """The four nodes around a place, and their weights."""

    i: int
    j: int
    share_x: float
    share_y: float


@part
def cell_of(place: float, low: float, step: float, nodes: int) -> tuple[int, float]:
    """Return the cell that a coordinate lies in and the share of the cell behind it."""
    if nodes == 1:
        return 0, 0.0
    scaled = min(max((place - low) / step, 0.0), nodes - 1.0)
    cell = min(int(scaled), nodes - 2)
    return cell, scaled - cell


@part
def hat_at(grid: FrictionMap, x: float, y: float) -> Hat:
    """Return the nodes around a place (m) and their weights."""
    i, share_x = cell_of(x, grid.low_x, grid.step_x, grid.values.shape[0])
    j, share_y = cell_of(y, grid.low_y, grid.step_y, grid.values.shape[1])
    return Hat(i, j, share_x, share_y)


@part
def friction_at(grid: FrictionMap, x: float, y: float) -> float:
    """Return c(x, y), N s/m."""
    hat, c = hat_at(grid, x, y), grid.values
    right = min(hat.i + 1, c.shape[0] - 1)
    above = min(hat.j + 1, c.shape[1] - 1)
    low = (1.0 - hat.share_x) * c[hat.i, hat.j] + hat.share_x * c[right, hat.j]
    high = (1.0 - hat.share_x) * c[hat.i, above] + hat.share_x * c[right, above]
    return (1.0 - hat.share_y) * low + hat.share_y * high


@kernel
def _write_weights(grid: FrictionMap, places: Series, out: Floats) -> None:
    nx, ny = grid.values.shape
    for row in range(places.shape[0]):
        hat = hat_at(grid, places[row, 0], places[row, 1])
        right, above = min(hat.i + 1, nx - 1), min(hat.j + 1, ny - 1)
        out[row, hat.i * ny + hat.j] += (1.0 - hat.share_x) * (1.0 - hat.share_y)
        out[row, right * ny + hat.j] += hat.share_x * (1.0 - hat.share_y)
        out[row, hat.i * ny + above] += (1.0 - hat.share_x) * hat.share_y
        out[row, right * ny + above] += hat.share_x * hat.share_y


def hat_functions(grid: FrictionMap, places: Series) -> Floats:
    """Return phi_k at places (n, 2) m: (n, nx ny), the nodes in the order of ``values.ravel()``."""
    out = np.zeros((len(places), grid.values.size))
    _write_weights(grid, places, out)
    return out
