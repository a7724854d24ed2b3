"""The tables of a testbed file that tell of weights to be placed by hand, and of their places.

A unit is part of its key. Nothing is converted here; ``weights_build`` does that once.
"""

from typing import Annotated

from pydantic import Field

from equipoise.io.toml.key_types import Name, NotNegative, Positive, Table, Triple
from equipoise.model.weights import LETTERS

Count = Annotated[int, Field(ge=1)]


class Weight(Table):
    """A kind of weight in the stock; not part of the platform's mass."""

    name: Name
    mass_g: Positive
    count: Count = Field(description="how many there are")
    mass_sd_g: NotNegative = Field(0.0, description="one sd of each; 0: weighed well enough")
    height_mm: NotNegative = Field(0.0, description="by which each makes a pile higher")


class WeightGrid(Table):
    """Places on a regular grid: letters along one axis, numbers along the other."""

    name: Name
    first_mm: Triple = Field(description="foot of a pile at A1, from P")
    letter_axis: Triple
    number_axis: Triple = Field(
        description="at right angles to the letters; piles grow along letters x numbers"
    )
    step_mm: Positive
    letters: Annotated[int, Field(ge=1, le=LETTERS)]
    numbers: Count
    capacity: Count = Field(1, description="weights in a pile")
    place_sd_mm: NotNegative = Field(
        0.5, description="one sd of where a pile stands, each way, chosen: play in a drilled hole"
    )
    taken: list[str] = Field([], description="places that are not free, such as C4")
