"""Weights that a person puts on a platform by hand, and the places for them.

A place is a hole, a pin or a magnet on a regular grid; weights on it make a pile, which grows along
``letters x numbers`` of its grid. In a pile the kinds lie in the order of the stock, the first at
the foot. A loading is a table of counts: a row a place (``places_of``), a column a kind.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Floats, Ints, Vector3

LETTERS = 26  # A to Z


@dataclass(frozen=True, slots=True, eq=False)
class Weight:
    """A kind of weight, of which there are ``count``."""

    name: str
    mass: float  # kg
    count: int
    mass_sd: float  # kg, one sd of each
    height: float  # m, by which each makes a pile higher; 0: as good as flat


@dataclass(frozen=True, slots=True, eq=False)
class WeightGrid:
    """Places in rows and columns: letters along one axis, numbers along the other, from A1."""

    name: str
    first: Vector3  # m, from P: the foot of a pile at A1
    letter_axis: Vector3  # unit vectors, body
    number_axis: Vector3
    step: float  # m
    letters: int
    numbers: int
    capacity: int  # weights in a pile
    place_sd: float  # m, one sd of where a pile stands, along each of the two axes
    taken: tuple[str, ...] = ()  # names without the grid's, such as C4: not free


class Place(NamedTuple):
    """One place of a grid."""

    name: str  # such as deck:C4
    foot: Vector3  # m, from P
    up: Vector3  # unit vector, in which its pile grows
    grid: WeightGrid


def place_names(grid: WeightGrid) -> list[str]:
    """Return A1, A2, ... B1, ... of a grid, the taken ones among them."""
    columns = [chr(ord("A") + i) for i in range(grid.letters)]
    return [f"{letter}{j + 1}" for letter in columns for j in range(grid.numbers)]


@lru_cache(maxsize=8)
def places_of(grids: tuple[WeightGrid, ...]) -> tuple[Place, ...]:
    """Return every free place, grid by grid."""
    found: list[Place] = []
    for grid in grids:
        up = np.cross(grid.letter_axis, grid.number_axis)
        for k, name in enumerate(place_names(grid)):
            i, j = divmod(k, grid.numbers)
            foot = grid.first + grid.step * (i * grid.letter_axis + j * grid.number_axis)
            if name not in grid.taken:
                found.append(Place(f"{grid.name}:{name}", foot, up, grid))
    return tuple(found)


class Rack(NamedTuple):
    """The same as arrays, a row a place."""

    foot: Floats  # (p, 3) m
    up: Floats  # (p, 3)
    capacity: Ints  # (p,)


@lru_cache(maxsize=8)
def rack_of(grids: tuple[WeightGrid, ...]) -> Rack:
    """Return every free place, grid by grid, as arrays."""
    places = places_of(grids)
    foot, up = (np.array([place[k] for place in places]).reshape(-1, 3) for k in (1, 2))
    return Rack(foot, up, np.array([p.grid.capacity for p in places], dtype=np.int64))


def unloaded(grids: tuple[WeightGrid, ...], weights: tuple[Weight, ...]) -> Ints:
    """Return the loading with nothing on any place."""
    return np.zeros((len(places_of(grids)), len(weights)), dtype=np.int64)
