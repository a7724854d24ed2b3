"""Tables of other programs, known by their headers; one entry for each, in order of trial.

What a program writes, and where that is described, is said where its map is made.
"""

from collections.abc import Callable
from dataclasses import dataclass

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.native_columns import ATTITUDE, RATE, is_native, native_map
from equipoise.io.dialects.body_choice import no_body
from equipoise.io.dialects.euler_dialect import euler_map, is_euler
from equipoise.io.dialects.motion_capture_dialects import (
    is_optitrack,
    is_qualisys,
    is_vicon,
    optitrack_map,
    qualisys_map,
    vicon_map,
)
from equipoise.io.dialects.phyphox_dialect import is_phyphox, phyphox_map
from equipoise.io.dialects.ros_dialect import is_ros, ros_map
from equipoise.model.errors import InputError, nearest

Names = tuple[str, ...]
Map = Callable[[Names, str, str | None], ColumnMap]  # of a header, its file, the body to read


@dataclass(frozen=True, slots=True)
class Dialect:
    """Tables of one program."""

    marks: Callable[[Names], bool]  # whether a header is its
    columns: Map


def dialect_map(name: str, names: Names, source: str, body: str | None = None) -> ColumnMap:
    """Return what a header's columns mean in a dialect; InputError if it is not of that kind."""
    if name not in DIALECTS:
        raise InputError("dialect", f"'{name}'", nearest(name, list(DIALECTS)))
    return DIALECTS[name].columns(names, source, body)


def detect(names: Names, source: str, body: str | None = None) -> ColumnMap:
    """Return the map of the dialect whose mark the header bears."""
    for dialect in DIALECTS.values():
        if dialect.marks(names):
            return dialect.columns(names, source, body)
    if body is not None:
        raise no_body(body, source)
    shown = ", ".join(filter(None, names[:8]))
    wanted = (
        f"columns of a known dialect ({', '.join(DIALECTS)}), or a column map (--columns); "
        f"`equipoise import {source} --write-map map.toml` makes one"
    )
    raise InputError(f"{source}, header", f"columns {shown}", wanted)


def _is_ours(names: Names) -> bool:
    """Say whether a header is ours, and not that of angles beside a time of our name."""
    return is_native(names) and (bool({*ATTITUDE, *RATE} & {*names}) or not is_euler(names))


def _of_one_body(columns: Callable[[Names, str], ColumnMap]) -> Map:
    """Return the map of a dialect whose tables name no bodies."""

    def mapped(names: Names, source: str, body: str | None) -> ColumnMap:
        if body is not None:
            raise no_body(body, source)
        return columns(names, source)

    return mapped


DIALECTS: dict[str, Dialect] = {
    "native": Dialect(_is_ours, _of_one_body(native_map)),
    "optitrack": Dialect(is_optitrack, optitrack_map),
    "vicon": Dialect(is_vicon, vicon_map),
    "qualisys": Dialect(is_qualisys, qualisys_map),
    "phyphox": Dialect(is_phyphox, _of_one_body(phyphox_map)),
    "ros": Dialect(is_ros, _of_one_body(ros_map)),
    "euler": Dialect(is_euler, _of_one_body(euler_map)),
}
