"""The [attitude] of a column map file, of any kind of rotation, to the columns that hold it."""

from typing import Annotated, Any, Literal

from pydantic import Field

from equipoise.io.columns.column_map import Columns, Euler
from equipoise.io.toml.key_types import Table
from equipoise.io.toml.units import factor
from equipoise.model.errors import InputError

VECTOR = "rotation vector"
# By kind: how many columns it has, the keys it needs, and those it may have.
KINDS: dict[str, tuple[int, tuple[str, ...], tuple[str, ...]]] = {
    "a quaternion": (4, ("order",), ()),
    "angles": (3, ("unit", "sequence"), ("signs", "compass")),
    "a rotation vector": (3, ("kind", "unit"), ()),
    "a matrix": (9, (), ()),
}
NEEDED = {
    "order": "order = 'wxyz' or 'xyzw'",
    "unit": "unit = 'deg' or 'rad'",
    "sequence": "sequence such as 'ZYX', or kind = 'rotation vector'",
}


class AttitudeTable(Table):
    """A quaternion in four columns, angles or a rotation vector in three, a matrix in nine."""

    columns: Annotated[list[str], Field(min_length=3, max_length=9)]
    order: Literal["wxyz", "xyzw"] | None = None
    unit: str | None = None
    kind: Literal["rotation vector"] | None = None
    sequence: Annotated[str, Field(pattern=r"^([XYZ]{3}|[xyz]{3})$")] | None = Field(
        None, description="three letters of X, Y, Z, or of x, y, z about fixed axes"
    )
    signs: Annotated[list[Literal[1, -1]], Field(min_length=3, max_length=3)] = Field([1, 1, 1])
    compass: bool = False
    turns: Literal["body to laboratory", "laboratory to body"] = "body to laboratory"


def attitude_columns(table: AttitudeTable | None, where: str) -> dict[str, Any]:
    """Return the field of a column map that an attitude fills; InputError names key and wanted."""
    if table is None:
        return {}
    names = tuple(table.columns)
    kind = _kind(table, where)
    _check_keys(table, kind, where)
    if kind == "a matrix":
        return {"matrix": Columns(names)}
    if kind == "a quaternion":
        order = table.order or ""
        return {"quaternion": Columns(tuple(names[order.index(letter)] for letter in "wxyz"))}
    unit = factor(table.unit or "", "angle", where)
    if kind == "a rotation vector":
        return {"rotation_vector": Columns(names, unit)}
    signed = tuple(unit * sign for sign in _signs(table, where))
    return {"euler": Euler(Columns(names, signed), table.sequence or "")}


def _kind(table: AttitudeTable, where: str) -> str:
    """Return the kind of rotation: by the number of columns, and by what three are said to be."""
    count = len(table.columns)
    if count == 3:
        return "a rotation vector" if table.kind == VECTOR else "angles"
    kind = next((kind for kind, (columns, *_) in KINDS.items() if columns == count), None)
    if kind is None:
        wanted = "four (a quaternion), three (angles, a rotation vector) or nine (a matrix)"
        raise InputError(f"{where}.columns", f"{count} columns", wanted)
    return kind


def _check_keys(table: AttitudeTable, kind: str, where: str) -> None:
    """Raise InputError for a key that lacks, or that means nothing for a kind of rotation."""
    count, needed, allowed = KINDS[kind]
    stated = table.model_fields_set - {"columns", "turns"}
    missing = [key for key in needed if key not in stated]
    if missing:
        number = {3: "three", 4: "four"}[count]
        found = f"{number} columns but no {' and no '.join(map(repr, missing))}"
        raise InputError(where, found, ", ".join(NEEDED[key] for key in missing))
    surplus = sorted(stated - {*needed, *allowed})
    if surplus:
        keys = ", ".join(["columns", *needed, *allowed, "turns"])
        raise InputError(f"{where}.{surplus[0]}", f"'{surplus[0]}' of {kind}", f"only {keys}")


def _signs(table: AttitudeTable, where: str) -> list[int]:
    """Return the signs of three angles; a compass counts its heading clockwise."""
    sequence = table.sequence or ""
    heading = 0 if sequence.isupper() else 2  # the turn about the laboratory's own axis
    if not table.compass:
        return [*table.signs]
    if sequence[heading] not in "zZ":
        wanted = "a sequence that begins with Z, or ends with z: ZYX, ZXY, xyz, yxz"
        raise InputError(f"{where}.compass", f"a compass with the sequence {sequence}", wanted)
    return [-sign if i == heading else sign for i, sign in enumerate(table.signs)]
