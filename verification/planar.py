"""Platforms on a sloping table with a friction map, on MuJoCo's truth: errors and intervals.

The friction of a flight is compared at six places of its path, where the record was; nodes of a map
are no quantities of the table.
"""

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.dynamics.planar.friction_map import hat_functions
from equipoise.estimation.method_contract import Options
from equipoise.estimation.planar import planar_estimate
from equipoise.estimation.planar.planar_layout import LEAN, NODE, SLOPE, node_names
from equipoise.estimation.planar.planar_problem import grid_of
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.estimate import COM, INERTIA, NORMAL_95, Estimate
from equipoise.model.units import UM
from tests.oracle.planar_records import Flight, flight
from verification.chance import share_band
from verification.result import Result, Row, Spread, at_most, between, in_turn

COVER = (0.92, 0.98)
PLACES = 6  # along a path
QUANTITIES = {"slope": SLOPE, "centre of mass": COM, "inertia": INERTIA}

Array = NDArray[np.float64]


class Run(NamedTuple):
    """One flight identified: errors in stated sd, by quantity."""

    off: dict[str, Array]
    slope_sd: float  # rad, the greater of both
    com_sd: float  # relative to the distance
    nodes: int
    usable: bool


def friction_off(record: Flight, found: Estimate) -> Array:
    """Return the errors of the friction at places of the path, in stated sd."""
    rows = record.recording.position
    assert rows is not None
    places = rows.values[np.linspace(0, len(rows) - 1, PLACES).astype(int)]
    side = nodes_of(found)
    table, names = record.testbed.table, node_names(side)
    assert table is not None
    weights = hat_functions(grid_of(table, np.zeros((side, side))), places)
    variance = np.einsum("ni,ij,nj->n", weights, found.covariance_of(names), weights)
    true = np.array([record.floor.friction(float(x), float(y)) for x, y in places])
    return (weights @ found.values(names) - true) / np.sqrt(variance)


def nodes_of(found: Estimate) -> int:
    """Return how many nodes a map has along an axis."""
    count = sum(p.name.startswith(f"{NODE}_x") for p in found.parameters)
    return round(count**0.5)


def identified(seed: int, waves: bool = False) -> Run:
    """Identify one flight."""
    record = flight(seed, waves=waves)
    found = planar_estimate.run(record.recording, record.testbed, Options())
    platform = record.platform
    true = {
        "slope": record.floor.slope,
        "centre of mass": platform.com,
        "inertia": pack_symmetric(platform.inertia_P),
    }
    sd = {name: np.sqrt(np.diag(found.covariance_of(q))) for name, q in QUANTITIES.items()}
    off = {name: (found.values(q) - true[name]) / sd[name] for name, q in QUANTITIES.items()}
    off["friction on the path"] = friction_off(record, found)
    distance = float(np.linalg.norm(platform.com))
    com_sd = float(np.linalg.norm(sd["centre of mass"])) / distance
    assert not any(found.has(name) for name in LEAN)
    return Run(off, float(sd["slope"].max()), com_sd, nodes_of(found), found.outcome.usable)


def cover_rows(title: str, runs: Sequence[Run]) -> list[Row]:
    """Return how many 95 % intervals hold the truth, by quantity.

    Intervals of one flight hold together or not at all, so that chance is that of the flights.
    """
    rows, band = list[Row](), share_band(COVER, 0.95, len(runs))
    for name in runs[0].off:
        inside = np.mean([np.abs(run.off[name]) < NORMAL_95 for run in runs])
        rows.append(between(f"{title}: {name}, intervals that hold", float(inside), band))
    return rows


def rows_of(title: str, runs: Sequence[Run]) -> list[Row]:
    """Return the rows of one kind of friction."""
    unusable = sum(not run.usable for run in runs)
    slope = float(np.median([run.slope_sd for run in runs])) / UM
    com = float(np.median([run.com_sd for run in runs]))
    maps = ", ".join(f"{k} x {k}: {sum(run.nodes == k for run in runs)}"
                     for k in sorted({run.nodes for run in runs}))  # fmt: skip
    return [
        *cover_rows(title, runs),
        at_most(f"{title}: outcomes not usable", unusable, 0, "d"),
        Row(f"{title}: sd of a slope, median (um/m)", f"{slope:.2g}", "", True),
        Row(f"{title}: sd of com over its distance, median", f"{com:.2%}", "", True),
        Row(f"{title}: maps of so many nodes", maps, "", True),
    ]


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Identify a flight for each seed, over bilinear friction and over friction in waves."""
    bilinear = spread(identified, seeds)
    waves = spread(partial(identified, waves=True), seeds)
    claim = (
        f"A platform on a sled over a sloping table, {len(seeds)} flights of MuJoCo (4-40 kg, "
        "60 s, com 1.5-4.5 mm below P, 50 um/m of slope, 0.02-0.2 N s/m of friction; attitude "
        "0.05 deg, position 0.3 mm, gyro 0.02 deg/s, all at 50 Hz): intervals hold as stated."
    )
    notes = (
        "Friction is bilinear between the corners of the table of 4 m, or in waves of 4 m and 6 m "
        "by a half up and down, which no map of the fit has exactly.",
    )
    rows = [*rows_of("bilinear friction", bilinear), *rows_of("friction in waves", waves)]
    return Result("planar", claim, tuple(rows), notes)
