"""Weights to be placed by hand and the places for them: their tables, and their records in SI."""

from typing import Annotated

from pydantic import Field

from equipoise.io.toml.key_types import (
    Direction,
    Name,
    NotNegative,
    Positive,
    Triple,
    square_axis,
    unit_vector,
)
from equipoise.io.toml.table_records import RecordTable, check_names, record_of
from equipoise.model import weights as model
from equipoise.model.errors import InputError, nearest

Count = Annotated[int, Field(ge=1)]


class Weight(RecordTable):
    """A kind of weight in the stock; not part of the platform's mass."""

    KIND = model.Weight

    name: Name
    mass_g: Positive
    count: Count = Field(description="how many there are")
    mass_sd_g: NotNegative = Field(
        0.0, description="standard deviation of each; 0: weighed accurately"
    )
    height_mm: NotNegative = Field(0.0, description="height that each adds to a pile")


class WeightGrid(RecordTable):
    """Places on a regular grid: letters along one axis, numbers along the other."""

    name: Name
    first_mm: Triple = Field(description="base of a pile at A1, from P")
    letter_axis: Direction
    number_axis: Triple = Field(
        description="perpendicular to the letters; piles grow along letters x numbers"
    )
    step_mm: Positive
    letters: Annotated[int, Field(ge=1, le=model.LETTERS)]
    numbers: Count
    capacity: Count = Field(1, description="weights in a pile")
    place_sd_mm: NotNegative = Field(
        0.5,
        description=(
            "standard deviation of a pile's position in each direction; default: play in "
            "a drilled hole"
        ),
    )
    taken: list[str] = Field([], description="occupied places, such as C4")

    def record(self, where: str) -> model.WeightGrid:
        """Return the grid, its numbers' axis exactly square to the letters'."""
        letters = unit_vector(self.letter_axis, f"{where}.letter_axis")
        axis = square_axis(self.number_axis, letters, f"{where}.number_axis", "letters' axis")
        grid = record_of(model.WeightGrid, self, where, number_axis=axis)
        known = model.place_names(grid)
        for name in grid.taken:
            if name not in known:
                found = f"'{name}', which is not a place of it"
                raise InputError(f"{where}.taken", found, nearest(name, known))
        return grid


def check_weights(weights: list[Weight], grids: list[WeightGrid], source: str) -> None:
    """Raise InputError for two of one name, or for weights without places and the other way."""
    check_names(weights, f"{source}: weight")
    check_names(grids, f"{source}: weight_grid")
    if bool(weights) != bool(grids):
        has, lacks = ("weight", "weight_grid") if weights else ("weight_grid", "weight")
        raise InputError(f"{source}: {has}", f"no [[{lacks}]]", "a stock of weights and a grid")
