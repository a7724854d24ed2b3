"""Friction and slope of a table as a picture shows them, from an estimate: c(x, y) and its sd.

    c = phi(x, y)^T c_nodes,     sd^2 = phi^T P phi

P has the wide priors of what the record does not show, so that c is uncertain there. A place counts
as determined where the sd is below half of the mean friction along the path.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.dynamics.planar.friction_map import hat_functions
from equipoise.estimation.planar.planar_layout import FRICTION_MEAN, NODE, SLOPE, node_names
from equipoise.estimation.planar.planar_problem import grid_of
from equipoise.model.arrays import Bools, Floats, Series, Series1
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

ALONG = 81  # places along each side of the table, chosen
MOST = 300  # places of a path, chosen: a line to the eye
DETERMINED = 0.5  # of the mean friction, chosen: as for nodes


@dataclass(frozen=True, slots=True, eq=False)
class FrictionField:
    """A table from above, laboratory axes."""

    x: Series1  # m
    y: Series1  # m
    friction: Floats  # (x, y) N s/m
    sd: Floats  # (x, y) N s/m
    determined: Bools  # (x, y)
    slope: Floats  # (2,) rad, downhill
    slope_sd: Floats  # (2,) rad
    path: Series  # (n, 2) m, as measured
    along_path: Series1  # (n,) N s/m, there


def friction_field(
    recording: Recording, testbed: Testbed, estimate: Estimate
) -> FrictionField | None:
    """Return the table of an estimate; None where the estimate has no friction map."""
    table, rows = testbed.table, recording.position
    if table is None or rows is None or not estimate.has(FRICTION_MEAN):
        return None
    nodes = sum(p.name.startswith(f"{NODE}_x") for p in estimate.parameters)
    side = round(nodes**0.5)
    names = node_names(side)
    x: Series1 = np.linspace(float(table.low[0]), float(table.high[0]), ALONG)
    y: Series1 = np.linspace(float(table.low[1]), float(table.high[1]), ALONG)
    places: Series = np.column_stack([np.repeat(x, ALONG), np.tile(y, ALONG)])
    grid = grid_of(table, np.zeros((side, side)))
    weights, path = hat_functions(grid, places), rows.values[:: max(len(rows) // MOST, 1)]
    covariance = estimate.covariance_of(names)
    variance = np.einsum("ni,ij,nj->n", weights, covariance, weights)
    sd: Floats = np.sqrt(np.maximum(variance, 0.0)).reshape(ALONG, ALONG)
    mean = abs(float(estimate.values((FRICTION_MEAN,))[0]))
    return FrictionField(
        x,
        y,
        (weights @ estimate.values(names)).reshape(ALONG, ALONG),
        sd,
        sd < DETERMINED * mean,
        estimate.values(SLOPE),
        np.sqrt(np.diag(estimate.covariance_of(SLOPE))),
        path,
        hat_functions(grid, path) @ estimate.values(names),
    )
