"""Kinds of keys and tables that our TOML files are made of; directions as people write them."""

import math
from dataclasses import dataclass
from typing import Annotated, Any, cast, get_args

import numpy as np
from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    field_validator,
)
from pydantic_core import PydanticCustomError

from equipoise.io.toml.plausible import implausible
from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError
from equipoise.model.visible_text import is_all_visible


@dataclass(frozen=True, slots=True)
class Holds:
    """What a key gives, where it is not the attribute of the key's name without its unit."""

    attribute: str  # of the record; dotted within a record of it; ``ITSELF``: a table of its own
    unit: float | None = None  # in SI; None: the unit at the end of the key


@dataclass(frozen=True, slots=True)
class UnitVector:
    """Marks a key whose three numbers are made a unit vector."""


def _tensor(value: Any) -> Any:
    """Return three moments as a tensor without products, and rows of numbers as they are."""
    rows = cast("list[Any]", value) if isinstance(value, list) else []
    if len(rows) == 3 and all(type(row) is list and len(row) == 3 for row in rows):
        return rows
    if len(rows) != 3 or not all(type(moment) in (int, float) for moment in rows):
        raise PydanticCustomError("no_tensor", TENSOR)
    return [[row if i == j else 0.0 for j in range(3)] for i, row in enumerate(rows)]


def _visible(text: str) -> str:
    """Return a text as it is, if each of its characters is seen, and none turns the others."""
    if not is_all_visible(text):
        raise PydanticCustomError("unseen", VISIBLE)
    return text


ITSELF = "."
VISIBLE = "text in one line, without control, direction or other invisible characters"
TENSOR = "three moments [xx, yy, zz], or three rows [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]"
Triple = Annotated[list[float], Field(min_length=3, max_length=3)]
Pair = Annotated[list[float], Field(min_length=2, max_length=2)]
Five = Annotated[list[float], Field(min_length=5, max_length=5)]
Square = Annotated[list[Triple], Field(min_length=3, max_length=3)]
Inertia = Annotated[Square, BeforeValidator(_tensor, json_schema_input_type=Triple | Square)]
Direction = Annotated[list[float], Field(min_length=3, max_length=3), UnitVector()]
Positive = Annotated[float, Field(gt=0)]
NotNegative = Annotated[float, Field(ge=0)]
SdTriple = Annotated[list[Positive], Field(min_length=3, max_length=3)]
Visible = Annotated[str, Field(min_length=1), AfterValidator(_visible)]
# A mass's or device's name becomes part of a column's name, so it is kept to what any
# table program takes.
Name = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]*$")]


class Table(BaseModel):
    """One table of the file: an unknown key is an error, and a number must be a finite number."""

    model_config = ConfigDict(
        strict=True, extra="forbid", frozen=True, allow_inf_nan=False, defer_build=True
    )

    @field_validator("*")
    @classmethod
    def _plausible(cls, value: Any, info: Any) -> Any:
        wanted = implausible(str(info.field_name), value)
        if wanted is not None:
            raise PydanticCustomError("implausible", "{wanted}", {"wanted": wanted})
        return value


def table_in(annotation: Any) -> type[Table] | None:
    """Return the table inside ``list[table]``, ``table | None`` or the table itself."""
    if isinstance(annotation, type) and issubclass(annotation, Table):
        return annotation
    return next(filter(None, map(table_in, get_args(annotation))), None)


AXIS_FLOOR = 1e-6  # chosen: a shorter axis has no direction one could mean
RIGHT_ANGLE = 0.1  # deg, by which a right angle may be off (chosen: axes written to 3 digits)


def unit_vector(axis: list[float], where: str) -> Vector3:
    """Return a direction as a unit vector; zero length is an error."""
    length = math.hypot(*axis)
    if length < AXIS_FLOOR:
        raise InputError(where, f"an axis of length {length:g}", "a direction such as [1, 0, 0]")
    return np.array(axis, float) / length


def square_axis(axis: list[float], to: Vector3, where: str, named: str) -> Vector3:
    """Return an axis, made exactly square to one that is ``named``; it must be nearly so."""
    unit = unit_vector(axis, where)
    square = unit - (unit @ to) * to
    angle = math.degrees(math.atan2(float(np.linalg.norm(square)), float(unit @ to)))
    if abs(angle - 90) > RIGHT_ANGLE:
        wanted = f"a right angle, within {RIGHT_ANGLE:g} deg"
        raise InputError(where, f"an axis at {angle:.4g} deg to the {named}", wanted)
    return square / np.linalg.norm(square)
