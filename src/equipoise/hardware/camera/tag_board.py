"""A board of square markers in rows and columns.

Its frame: origin in the middle of the board, X to the right and Y up as it is printed, Z out of
the print towards the viewer. Markers count from the upper left, row by row; the corners of
one go round as its picture is read: upper left, upper right, lower right, lower left.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.hardware.camera import aruco
from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError
from equipoise.model.units import MM

POINTS, MARGIN = 8, 0.12  # on each side of a marker, chosen: and off its corners, which blur rounds
LEAST = 2  # markers, chosen: the pose of a single one is too often ambiguous


@dataclass(frozen=True, slots=True)
class TagBoard:
    """What is printed."""

    dictionary: str
    columns: int
    rows: int
    marker: float  # m, side of a marker with its black border
    gap: float  # m, between neighbours
    first: int = 0  # id of the upper left marker

    @property
    def size(self) -> tuple[float, float]:
        """Width and height over all markers, m."""
        pitch = self.marker + self.gap
        return self.columns * pitch - self.gap, self.rows * pitch - self.gap

    @property
    def ids(self) -> range:
        """The markers' ids."""
        return range(self.first, self.first + self.columns * self.rows)

    @property
    def ink(self) -> float:
        """How wide the black border of a marker is, or the paper around it if that is less, m."""
        cells = aruco.cells(aruco.dictionary(self.dictionary, "board"))
        return min(self.marker / cells, self.gap)

    def corners(self, number: int) -> Floats:
        """Return the corners (4, 3) of a marker, m, board axes."""
        row, column = divmod(number - self.first, self.columns)
        pitch, (width, height) = self.marker + self.gap, self.size
        left, top = column * pitch - width / 2, height / 2 - row * pitch
        right, bottom = left + self.marker, top - self.marker
        return np.array(
            [[left, top, 0.0], [right, top, 0.0], [right, bottom, 0.0], [left, bottom, 0.0]]
        )

    def borders(self, number: int) -> "Borders":
        """Return points on the border of a marker."""
        corners = self.corners(number)[:, None]
        way = np.roll(corners, -1, axis=0) - corners
        along = (way / self.marker).repeat(POINTS, axis=1).reshape(-1, 3)
        shares = (np.arange(POINTS) + 0.5) / POINTS
        points = corners + (MARGIN + (1 - 2 * MARGIN) * shares[:, None]) * way
        outward = along[:, [1, 0, 2]] * [-1.0, 1.0, 0.0]
        return Borders(points.reshape(-1, 3), along, outward, self.ink)


@dataclass(frozen=True, slots=True, eq=False)
class Borders:
    """Points on the borders of markers, board axes: paper is outside, ink inside."""

    points: Floats  # (n, 3) m
    along: Floats  # (n, 3) unit, along the border
    outward: Floats  # (n, 3) unit, from ink to paper
    ink: float  # m, how wide the ink is within a border, or the paper around it if that is less


def checked_board(board: TagBoard, where: str) -> TagBoard:
    """Return a board; InputError if its dictionary has too few markers, or it is none."""
    count = board.columns * board.rows
    if board.columns < 1 or board.rows < 1 or count < LEAST:
        wanted = f"at least {LEAST} markers"
        raise InputError(where, f"{board.columns} columns and {board.rows} rows", wanted)
    if board.marker <= 0 or board.gap <= 0:
        found = f"marker_mm {board.marker / MM:g} and gap_mm {board.gap / MM:g}"
        raise InputError(where, found, "lengths greater than zero")
    there = aruco.count_of(aruco.dictionary(board.dictionary, where))
    if board.first < 0 or board.ids.stop > there:
        found = f"markers {board.first} to {board.ids.stop - 1} of {board.dictionary}"
        raise InputError(where, found, f"markers 0 to {there - 1}")
    return board


def board_print(board: TagBoard, dpi: int) -> aruco.Picture:
    """Return the board at its true size, a gap of paper around it."""
    pitch = board.marker + board.gap
    width, height = (
        aruco.dots(count * pitch + board.gap, dpi) for count in (board.columns, board.rows)
    )
    side, paper = aruco.dots(board.marker, dpi), np.full((height, width), 255, np.uint8)
    markers = aruco.dictionary(board.dictionary, "print-board")
    for number in board.ids:
        row, column = divmod(number - board.first, board.columns)
        left, top = (aruco.dots(board.gap + pitch * k, dpi) for k in (column, row))
        paper[top : top + side, left : left + side] = aruco.drawn(markers, number, side)
    return paper
