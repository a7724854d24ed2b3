"""Weights on their places: their contribution to mass, first moment and inertia, and its sd.

A weight of mass m whose middle is at x (on a pile of others, half its height above them) adds

    m,    mu = m x,    J_P = m (|x|^2 E - x x^T)

and c alike of height h on each other from a height l on, along u from the foot f at x = f + z u,

    sum z = c l + h c^2 / 2,    sum z^2 = c l^2 + l h c^2 + h^2 (c^3 / 3 - c / 12)

Weights that are handled have an uncertain mass, piles an uncertain place; with a, b the grid's
axes:

    cov(mu) = sum over weights handled  sd_m^2 x x^T
            + sum over piles changed    (change of mass)^2 sd^2 (a a^T + b b^T)

The weights' own size is left out (a cylinder of 1 g and 6 mm radius: 2e-8 kg m^2), and so is what
their errors do to the inertia (sd_m |x|^2: 4e-7 kg m^2 for 10 mg at 0.2 m).
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Floats, Ints, Matrix3, Vector3
from equipoise.model.mass_properties import inertia_from_second_moments
from equipoise.model.testbed import Testbed
from equipoise.model.weights import Place, Weight, places_of, rack_of


class Load(NamedTuple):
    """The mass properties that a loading adds, about P."""

    mass: float  # kg
    first_moment: Vector3  # kg m
    inertia_P: Matrix3  # kg m^2


def stages(place: Place, weights: tuple[Weight, ...], counts: Ints) -> Iterator[tuple[int, Floats]]:
    """Yield the kind and the middle (m) of every weight in a pile, from the foot up."""
    height = 0.0
    for kind, (weight, count) in enumerate(zip(weights, counts, strict=True)):
        for _ in range(int(count)):
            yield kind, place.foot + (height + weight.height / 2) * place.up
            height += weight.height


def load_of(testbed: Testbed, loading: Ints) -> Load:
    """Return the mass properties of a loading."""
    rack, (c, low, h) = rack_of(testbed.grids), heights(testbed, loading)
    m, foot, up = np.array([w.mass for w in testbed.weights]), rack.foot, rack.up
    first = (c * low + h * c**2 / 2) @ m
    second = (c * low**2 + low * h * c**2 + h**2 * (c**3 / 3 - c / 12)) @ m
    cross = (first[:, None] * foot).T @ up
    spread = (foot * (c @ m)[:, None]).T @ foot + cross + cross.T + (up * second[:, None]).T @ up
    moment = (c @ m) @ foot + first @ up
    return Load(float((c @ m).sum()), moment, inertia_from_second_moments(spread))


def heights(testbed: Testbed, loading: Ints) -> tuple[Floats, Floats, Floats]:
    """Return counts, the height (m) at which each kind begins in its pile, and that of each."""
    h, counts = np.array([w.height for w in testbed.weights]), loading.astype(float)
    return counts, np.cumsum(counts * h, axis=1) - counts * h, h


def handling_covariance(testbed: Testbed, before: Ints, after: Ints) -> Matrix3:
    """Return the covariance of the change of the first moment, (kg m)^2."""
    total = np.zeros((3, 3))
    masses = np.array([weight.mass for weight in testbed.weights])
    sds = np.array([weight.mass_sd for weight in testbed.weights])
    places, changes = places_of(testbed.grids), after - before
    for p in np.flatnonzero(changes.any(axis=1)):
        change, grid, x = changes[p], places[p].grid, places[p].foot
        plane = np.outer(grid.letter_axis, grid.letter_axis)
        plane = plane + np.outer(grid.number_axis, grid.number_axis)
        total += float(np.abs(change) @ sds**2) * np.outer(x, x)
        total += float(change @ masses * grid.place_sd) ** 2 * plane
    return total


def refusal(testbed: Testbed, loading: Ints) -> str:
    """Return why a loading cannot be, or nothing."""
    if np.any(loading < 0):
        return "fewer than no weights at a place"
    for weight, count in zip(testbed.weights, loading.sum(axis=0), strict=True):
        if count > weight.count:
            return f"{count} x {weight.name}, of which there are {weight.count}"
    capacity, counts = rack_of(testbed.grids).capacity, loading.sum(axis=1)
    for p in np.flatnonzero(counts > capacity):
        name = places_of(testbed.grids)[p].name
        return f"{counts[p]} weights at {name}, which holds {capacity[p]}"
    return ""
