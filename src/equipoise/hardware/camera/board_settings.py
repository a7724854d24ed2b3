"""The board of a camera, from its settings: ``layout`` says which keys describe it.

grid        dictionary, columns, rows, marker_mm, gap_mm, first_id: markers in rows; 1 x 1 is one
            marker alone, and gap_mm the white paper around it
aprilgrid   columns, rows, marker_mm, spacing, first_id: as Kalibr prints it; spacing is the gap as
            a share of a tag's side (Kalibr's tagCols, tagRows, tagSize, tagSpacing)
tags        dictionary, place_sd_mm and a table [[tag]] each: id, x_mm, y_mm, z_mm, rotation_deg,
            marker_mm; place_sd_mm is the sd with which their places were measured
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import cast

from equipoise.hardware.camera import aruco
from equipoise.hardware.camera.layouts import KALIBR, april_grid, grid, measured
from equipoise.hardware.camera.number_settings import number, whole
from equipoise.hardware.camera.tag_board import Marker, TagBoard
from equipoise.model.errors import InputError, nearest
from equipoise.model.hardware import Setting, SettingTable
from equipoise.model.units import DEG, MM

DICTIONARY = "4X4_50"
PLACE_SD_MM = 0.2  # chosen: by a calliper, between the edges of prints
TAG_KEYS = ("id", "x_mm", "y_mm", "z_mm", "rotation_deg", "marker_mm")
Settings = Mapping[str, Setting]


def board_of(settings: Settings, where: str) -> TagBoard:
    """Return the board of settings; keys of other things than boards are left alone."""
    layout = settings.get("layout", "grid")
    if not isinstance(layout, str) or layout not in LAYOUTS:
        raise InputError(f"{where}.layout", f"{layout!r}", nearest(str(layout), list(LAYOUTS)))
    keys, make = LAYOUTS[layout]
    for key in settings:
        if key in BOARD_KEYS and key not in keys:
            wanted = "of a board " + ", ".join(keys)
            raise InputError(where, f"key '{key}' with layout = '{layout}'", wanted)
    return make(settings, where)


def _grid(settings: Settings, where: str) -> TagBoard:
    dictionary = _dictionary(settings)
    lattice = _lattice(settings, dictionary, where)
    gap = _length(settings, "gap_mm", where)
    return grid(dictionary, lattice.size, lattice.marker, gap, lattice.first)


def _april_grid(settings: Settings, where: str) -> TagBoard:
    lattice = _lattice(settings, KALIBR, where)
    spacing = number(settings, "spacing", where)
    if not 0 < spacing <= 1:
        wanted = "the gap as a share of a tag's side, above 0, at most 1"
        raise InputError(f"{where}.spacing", f"{spacing:g}", wanted)
    return april_grid(lattice.size, lattice.marker, spacing, lattice.first)


def _tags(settings: Settings, where: str) -> TagBoard:
    tables = settings.get("tag", ())
    if not isinstance(tables, tuple) or not tables or any(isinstance(t, str) for t in tables):
        raise InputError(f"{where}.tag", f"{tables!r}", "a table [[tag]] for each tag")
    tags = [
        _tag(table, f"{where}.tag[{k}]")
        for k, table in enumerate(cast("tuple[SettingTable, ...]", tables), 1)
    ]
    numbers = [tag.number for tag in tags]
    for k, each in enumerate(numbers):
        if each in numbers[:k]:
            raise InputError(f"{where}.tag", f"two tags with id {each}", "each id once")
    dictionary = _dictionary(settings)
    _check_ids(dictionary, min(numbers), max(numbers), where)
    return measured(dictionary, tags, _length(settings, "place_sd_mm", where, PLACE_SD_MM))


def _tag(table: SettingTable, where: str) -> Marker:
    for key in table:
        if key not in TAG_KEYS:
            raise InputError(where, f"unknown key '{key}'", nearest(key, list(TAG_KEYS)))
    x, y = (MM * number(table, key, where) for key in ("x_mm", "y_mm"))
    z = MM * number(table, "z_mm", where, 0.0)
    rotation = DEG * number(table, "rotation_deg", where, 0.0)
    side = _length(table, "marker_mm", where)
    return Marker(whole(table, "id", where), side, x, y, z, rotation)


@dataclass(frozen=True, slots=True)
class Lattice:
    """What grids have in common."""

    size: tuple[int, int]  # columns and rows
    marker: float  # m
    first: int


def _lattice(settings: Settings, dictionary: str, where: str) -> Lattice:
    """Return columns, rows, side and first id, such that the dictionary has the markers."""
    columns, rows = whole(settings, "columns", where), whole(settings, "rows", where)
    if columns < 1 or rows < 1:
        raise InputError(where, f"{columns} columns and {rows} rows", "at least one of each")
    first = whole(settings, "first_id", where, 0)
    _check_ids(dictionary, first, first + columns * rows - 1, where)
    return Lattice((columns, rows), _length(settings, "marker_mm", where), first)


def _length(settings: Settings, key: str, where: str, usual: float | None = None) -> float:
    value = number(settings, key, where, usual)
    if value <= 0:
        raise InputError(f"{where}.{key}", f"{value:g}", "a length greater than zero")
    return MM * value


def _dictionary(settings: Settings) -> str:
    return str(settings.get("dictionary", DICTIONARY))


def _check_ids(dictionary: str, low: int, high: int, where: str) -> None:
    """Raise InputError if a dictionary lacks some of the markers, or there is no such one."""
    there = aruco.count_of(aruco.dictionary(dictionary, where))
    if low < 0 or high >= there:
        found = f"markers {low} to {high} of {dictionary}"
        raise InputError(where, found, f"markers 0 to {there - 1}")


LATTICE = ("columns", "rows", "marker_mm", "first_id")
LAYOUTS: dict[str, tuple[tuple[str, ...], Callable[[Settings, str], TagBoard]]] = {
    "grid": (("layout", "dictionary", *LATTICE, "gap_mm"), _grid),
    "aprilgrid": (("layout", *LATTICE, "spacing"), _april_grid),
    "tags": (("layout", "dictionary", "tag", "place_sd_mm"), _tags),
}
BOARD_KEYS = tuple(dict.fromkeys(key for keys, _ in LAYOUTS.values() for key in keys))
