"""A testbed file's weights and their places, checked and in SI."""

from collections.abc import Sequence

import numpy as np

from equipoise.io.testbed import weights as schema
from equipoise.io.testbed.testbed_schema import TestbedFile
from equipoise.io.toml.unit_vectors import square_axis, unit_vector
from equipoise.model.errors import InputError, nearest
from equipoise.model.weights import Weight, WeightGrid, place_names

MM, GRAM = 1e-3, 1e-3


def weights_of(table: TestbedFile, source: str) -> tuple[Weight, ...]:
    """Return the stock; InputError for two kinds of one name."""
    _check_names(table.weight, f"{source}: weight")
    return tuple(
        Weight(w.name, w.mass_g * GRAM, w.count, w.mass_sd_g * GRAM, w.height_mm * MM)
        for w in table.weight
    )


def grids_of(table: TestbedFile, source: str) -> tuple[WeightGrid, ...]:
    """Return the grids; InputError for two of one name, or a taken place that does not exist."""
    _check_names(table.weight_grid, f"{source}: weight_grid")
    if bool(table.weight) != bool(table.weight_grid):
        has, lacks = ("weight", "weight_grid") if table.weight else ("weight_grid", "weight")
        raise InputError(f"{source}: {has}", f"no [[{lacks}]]", "a stock of weights and a grid")
    return tuple(
        _grid(grid, f"{source}: weight_grid[{i}]") for i, grid in enumerate(table.weight_grid, 1)
    )


def _grid(grid: schema.WeightGrid, where: str) -> WeightGrid:
    letters = unit_vector(grid.letter_axis, f"{where}.letter_axis")
    numbers = square_axis(grid.number_axis, letters, f"{where}.number_axis", "letters' axis")
    built = WeightGrid(
        name=grid.name,
        first=np.array(grid.first_mm, float) * MM,
        letter_axis=letters,
        number_axis=numbers,
        step=grid.step_mm * MM,
        letters=grid.letters,
        numbers=grid.numbers,
        capacity=grid.capacity,
        place_sd=grid.place_sd_mm * MM,
        taken=tuple(grid.taken),
    )
    for name in built.taken:
        if name not in place_names(built):
            wanted = nearest(name, place_names(built))
            raise InputError(f"{where}.taken", f"'{name}', which is no place of it", wanted)
    return built


def _check_names(rows: Sequence[schema.Weight] | Sequence[schema.WeightGrid], where: str) -> None:
    names = [row.name for row in rows]
    for i, name in enumerate(names):
        if name in names[:i]:
            raise InputError(f"{where}[{i + 1}].name", f"a second '{name}'", "a new name")
