"""Where masses stood still in a recording, and how far a wrong stop would be felt.

A mass that is told to stop at d stops at d + error, with one error for each stop. Between stops
the error passes over with the travel. At home the error is zero by definition: home is where the
mass properties are stated.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Floats, Ints, Series1
from equipoise.model.recording import Samples
from equipoise.model.testbed import SlidingMass

STILL = 0.05  # of the mass's speed, chosen: slower than this is standing still


@dataclass(frozen=True, slots=True, eq=False)
class StopErrors:
    """One unknown displacement for each stop away from the first home."""

    felt: Samples | None  # (n, e), 0 to 1, straight between rows
    owner: Ints  # (e,) index of the mass
    sd: Floats  # (e,) m
    names: tuple[str, ...]


def travels(t: Series1, d: Series1, speed: float) -> list[tuple[int, int]]:
    """Return first and last row of every travel of one mass."""
    moving = np.abs(np.diff(d)) > STILL * speed * np.diff(t)
    edges = np.diff(np.concatenate([[0], moving.astype(int), [0]]))
    first, last = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return [(int(a), int(b)) for a, b in zip(first, last, strict=True)]


def felt(t: Series1, arrival: tuple[int, int], departure: tuple[int, int]) -> Floats:
    """Return how far the error of one stop is felt at each row: up, on, down."""
    before, after = t[list(arrival)], t[list(departure)]
    knots = [before[0], before[1], after[0], after[1]]
    levels = [float(arrival[1] == arrival[0]), 1.0, 1.0, float(departure[1] == departure[0])]
    return np.interp(t, knots, levels)


def stops_of(t: Series1, d: Series1, mass: SlidingMass) -> list[Floats]:
    """Return how each stop of one mass is felt, home excepted."""
    ways = travels(t, d, mass.speed)
    bounds = [(0, 0), *ways, (len(d) - 1, len(d) - 1)]
    stands = [felt(t, bounds[k], bounds[k + 1]) for k in range(len(bounds) - 1)]
    return stands if abs(d[0]) > mass.accuracy else stands[1:]


def stop_errors(track: Samples | None, masses: tuple[SlidingMass, ...]) -> StopErrors:
    """Return the unknown displacements of a recording whose masses stop with their accuracy."""
    columns: list[Floats] = []
    owner: list[int] = []
    names: list[str] = []
    for i, mass in enumerate(masses):
        if track is None or mass.accuracy <= 0:
            continue
        stands = stops_of(track.t, track.values[:, i], mass)
        columns += stands
        owner += [i] * len(stands)
        names += [f"error_{mass.name}_{k + 1}" for k in range(len(stands))]
    table = Samples(track.t, np.column_stack(columns)) if track is not None and columns else None
    sd = np.array([masses[i].accuracy for i in owner])
    return StopErrors(table, np.array(owner, dtype=np.int64), sd, tuple(names))
