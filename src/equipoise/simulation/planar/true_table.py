"""What the table of a simulated bench really is: slope, friction, and where P starts."""

from dataclasses import dataclass

import numpy as np

from equipoise.dynamics.planar.friction_map import FrictionMap
from equipoise.dynamics.planar.planar_motion import TableTop
from equipoise.model.arrays import Floats
from equipoise.model.table_top import PlanarTable, TrueTable
from equipoise.model.testbed import Testbed


@dataclass(frozen=True, slots=True, eq=False)
class Floor:
    """A table, and where P starts on it."""

    top: TableTop
    position: Floats  # (2,) m
    velocity: Floats  # (2,) m/s


def own_table(table: PlanarTable) -> TrueTable:
    """Return what a table is that the truth does not mention: level, slippery, P in its middle."""
    return TrueTable(np.zeros(2), np.zeros(4), 0.5 * (table.low + table.high), np.zeros(2))


def true_table(testbed: Testbed) -> Floor:
    """Return the table that a testbed's [truth] gives; friction is bilinear between the corners."""
    table, truth, g = testbed.table, testbed.truth, testbed.gravity
    assert table is not None
    true = own_table(table) if truth is None or truth.table is None else truth.table
    x, y = float(true.slope[0]), float(true.slope[1])
    down = (g * x, g * y, -g * float(np.sqrt(1 - x * x - y * y)))
    (left, near), (width, depth) = table.low, table.high - table.low
    corners = np.ascontiguousarray(true.friction.reshape(2, 2))
    friction = FrictionMap(float(left), float(near), float(width), float(depth), corners)
    mass = testbed.body.mass + table.sled_mass
    return Floor(TableTop(mass, (g * x, g * y), down, friction), true.position, true.velocity)
