"""Weights and their places as text: the way back from ``weights_build``."""

from equipoise.io.toml.write_toml import Value, number, numbers, table
from equipoise.model.testbed import Testbed
from equipoise.model.weights import Weight, WeightGrid

PER_MM, PER_GRAM = 1e3, 1e3


def text_of_weights(testbed: Testbed) -> str:
    """Return a table for each kind of weight and each grid."""
    tables = (
        *(table("[[weight]]", _weight(weight)) for weight in testbed.weights),
        *(table("[[weight_grid]]", _grid(grid)) for grid in testbed.grids),
    )
    return "\n".join(filter(None, tables))


def _weight(weight: Weight) -> dict[str, Value]:
    return {
        "name": weight.name,
        "mass_g": number(weight.mass, PER_GRAM),
        "count": weight.count,
        "mass_sd_g": number(weight.mass_sd, PER_GRAM),
        "height_mm": number(weight.height, PER_MM),
    }


def _grid(grid: WeightGrid) -> dict[str, Value]:
    return {
        "name": grid.name,
        "first_mm": numbers(grid.first, PER_MM),
        "letter_axis": numbers(grid.letter_axis),
        "number_axis": numbers(grid.number_axis),
        "step_mm": number(grid.step, PER_MM),
        "letters": grid.letters,
        "numbers": grid.numbers,
        "capacity": grid.capacity,
        "place_sd_mm": number(grid.place_sd, PER_MM),
        "taken": list(grid.taken),
    }
