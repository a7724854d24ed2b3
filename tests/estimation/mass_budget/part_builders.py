"""Parts and swings with every sd stated, for tests that change a few."""

from dataclasses import replace

import numpy as np

from equipoise.model.mass_budget import Oscillation, Part, PartsList

EXACT = Part(
    "exact", "point", 1.0, 0.0, np.zeros(3), 0.0, np.eye(3), 0.0, np.zeros(0), 0.0,
    np.zeros((3, 3)), 0.0,
)  # fmt: skip
SWING = Oscillation(
    "swing", np.array([1.0, 0.0, 0.0]), 0.0, np.zeros(3), 1.0, 1e-4, 0.0, 0.0, 0.0, None, 0.0,
    0.0, 0.0, 0.0, 0.0, np.zeros(3), 0.0, 9.81,
)  # fmt: skip


def part(shape, mass, size=(), centre=(0.0, 0.0, 0.0), **more):
    known = {"shape": shape, "mass": mass, "size": np.array(size, float), "name": shape}
    return replace(EXACT, centre=np.array(centre, float), **(known | more))


def swing(axis, **more):
    return replace(SWING, axis=np.array(axis, float) / np.linalg.norm(axis), **more)


def parts_list(*parts, swings=()):
    return PartsList("test", tuple(parts), tuple(swings))
