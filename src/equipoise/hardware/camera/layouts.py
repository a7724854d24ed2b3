"""Layouts of markers: a grid, one marker alone, Kalibr's AprilGrid, tags at measured places.

Each makes a ``TagBoard``. The origin of a grid is its middle; tags at measured places have the
origin from which they were measured.

AprilGrid (J. Maye, P. Furgale, R. Siegwart 2013, "Self-supervised calibration for robotic systems",
IEEE IV, 473-480, as the tool Kalibr prints it): tags 36h11 with a black border of two cells, that
count from the lower left, row by row upward; black squares as wide as the gap at all their corners.
Kalibr prints the tags upside down, as OpenCV has them.
"""

import math
from collections.abc import Sequence

from equipoise.hardware.camera import aruco
from equipoise.hardware.camera.tag_board import Marker, Square, TagBoard

KALIBR, THICK = "APRILTAG_36H11", 2  # its dictionary, and cells of black border


def grid(
    dictionary: str, size: tuple[int, int], marker: float, gap: float, first: int = 0
) -> TagBoard:
    """Return columns and rows of markers that count from the upper left, row by row.

    One marker alone is a grid of 1 x 1.
    """
    columns, rows = size
    places = _places(columns, rows, marker + gap)
    markers = tuple(
        Marker(first + row * columns + column, marker, x, -y) for column, row, x, y in places
    )
    return TagBoard(dictionary, markers, gap)


def april_grid(size: tuple[int, int], marker: float, spacing: float, first: int = 0) -> TagBoard:
    """Return Kalibr's AprilGrid; ``spacing`` is the gap as a share of a tag's side."""
    columns, rows = size
    gap = spacing * marker
    pitch = marker + gap
    markers = tuple(
        Marker(first + row * columns + column, marker, x, y, rotation=math.pi)
        for column, row, x, y in _places(columns, rows, pitch)
    )
    squares = tuple(Square(gap, x, y) for _, _, x, y in _places(columns + 1, rows + 1, pitch))
    return TagBoard(KALIBR, markers, gap, THICK, squares)


def measured(dictionary: str, tags: Sequence[Marker], place_sd: float) -> TagBoard:
    """Return tags that were glued and then measured; a cell of white paper is around each."""
    cells = aruco.cells(aruco.dictionary(dictionary, "board"))
    paper = min(tag.side for tag in tags) / cells
    return TagBoard(dictionary, tuple(tags), paper, place_sd=place_sd)


def _places(columns: int, rows: int, pitch: float) -> list[tuple[int, int, float, float]]:
    """Return column, row, x and y (m) of each place of a grid about its middle, row by row."""
    return [
        (column, row, pitch * (column - (columns - 1) / 2), pitch * (row - (rows - 1) / 2))
        for row in range(rows)
        for column in range(columns)
    ]
