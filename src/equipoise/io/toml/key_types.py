"""Kinds of keys and tables that our TOML files are made of."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Triple = Annotated[list[float], Field(min_length=3, max_length=3)]
Pair = Annotated[list[float], Field(min_length=2, max_length=2)]
Five = Annotated[list[float], Field(min_length=5, max_length=5)]
Square = Annotated[list[Triple], Field(min_length=3, max_length=3)]
Positive = Annotated[float, Field(gt=0)]
NotNegative = Annotated[float, Field(ge=0)]
SdTriple = Annotated[list[Positive], Field(min_length=3, max_length=3)]
# A mass's or device's name becomes part of a column's name, so it is kept to what any
# table program takes.
Name = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]*$")]


class Table(BaseModel):
    """One table of the file: an unknown key is an error, and a number must be a finite number."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True, allow_inf_nan=False)
