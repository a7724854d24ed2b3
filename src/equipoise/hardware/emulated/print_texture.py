"""The print of a board as a texture: grey levels, each an average of the print over its pixel.

A marker along the board's axes is averaged exactly. One that is turned is sampled ``FINE`` times
along each axis of a pixel.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equipoise.hardware.camera import aruco
from equipoise.hardware.camera.tag_board import Marker, TagBoard
from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError

BLACK, WHITE = 35.0, 215.0  # grey levels, chosen: a dim laboratory
FINE = 8  # chosen: edges come within 1/16 pixel, and their average far better
RIGHT_ANGLE = 1e-9  # rad, chosen: nearer to one counts as one


@dataclass(frozen=True, slots=True, eq=False)
class Sheet:
    """A print: the texture of a plane, on the board's axes."""

    grey: NDArray[np.float32]
    scale: float  # pixels per m
    corner: Floats  # X, Y of the upper left corner, m


def sheet_of(board: TagBoard, scale: float) -> Sheet:
    """Return the print of a flat board, ``scale`` pixels per m, with paper around it."""
    if any(marker.z != 0 for marker in board.markers):
        raise InputError("emulated camera", "tags at several heights", "z_mm = 0: it draws a sheet")
    left, bottom, right, top = board.extent
    margin = board.margin
    corner = np.array([left - margin, top + margin])
    shape = [int(np.ceil(scale * (size + 2 * margin))) for size in (top - bottom, right - left)]
    ink = np.zeros(shape)
    markers = aruco.dictionary(board.dictionary, "camera")
    cells = aruco.cells(markers, board.border)
    for each in board.markers:
        bits = aruco.drawn(markers, each.number, cells, board.border) < 128
        _print(ink, bits, each, corner, scale)
    for square in board.squares:
        place = Marker(0, square.side, square.x, square.y)
        _print(ink, np.ones((1, 1), bool), place, corner, scale)
    return Sheet((WHITE - (WHITE - BLACK) * ink).astype(np.float32), scale, corner)


def _print(
    ink: Floats, bits: NDArray[np.bool_], place: Marker, corner: Floats, scale: float
) -> None:
    """Add black cells (rows from the top) at a place."""
    quarters = place.rotation / (np.pi / 2)
    if abs(quarters - round(quarters)) > RIGHT_ANGLE:
        _print_turned(ink, bits, place, corner, scale)
        return
    cells, (down, across) = len(bits), ink.shape
    left, top = place.x - place.side / 2 - corner[0], corner[1] - place.y - place.side / 2
    by_column = shares(left, place.side / cells, cells, across, scale)
    by_row = shares(top, place.side / cells, cells, down, scale)
    ink += by_row.T @ np.rot90(bits, round(quarters)) @ by_column


def _print_turned(
    ink: Floats, bits: NDArray[np.bool_], place: Marker, corner: Floats, scale: float
) -> None:
    middle = scale * np.array([place.x - corner[0], corner[1] - place.y])
    reach = scale * place.side * np.sqrt(0.5) + 1
    low = np.maximum(np.floor(middle - reach), 0).astype(int)
    high = np.minimum(np.ceil(middle + reach), ink.shape[::-1]).astype(int)
    right = (np.arange(FINE * int(low[0]), FINE * int(high[0])) + 0.5) / FINE - middle[0]
    down = ((np.arange(FINE * int(low[1]), FINE * int(high[1])) + 0.5) / FINE - middle[1])[:, None]
    c, s = np.cos(place.rotation), np.sin(place.rotation)  # of the picture, seen with Y up
    cell = scale * place.side / len(bits)
    column = np.floor((c * right - s * down) / cell + len(bits) / 2).astype(int)
    row = np.floor((s * right + c * down) / cell + len(bits) / 2).astype(int)
    inside = (column >= 0) & (column < len(bits)) & (row >= 0) & (row < len(bits))
    last = len(bits) - 1
    black = inside & bits[np.clip(row, 0, last), np.clip(column, 0, last)]
    size = (int(high[1] - low[1]), FINE, int(high[0] - low[0]), FINE)
    ink[low[1] : high[1], low[0] : high[0]] += black.reshape(size).mean(axis=(1, 3))


def shares(start: float, cell: float, cells: int, pixels: int, scale: float) -> Floats:
    """Return by how much each cell (rows) covers each pixel (columns); lengths in m."""
    edges = scale * (start + cell * np.arange(cells + 1))
    pixel = np.arange(pixels)
    low = np.maximum(edges[:-1, None], pixel[None, :])
    high = np.minimum(edges[1:, None], pixel[None, :] + 1)
    return np.maximum(high - low, 0.0)
