"""A board: square markers at known places. Every layout makes this record (``layouts``).

Its frame: X to the right and Y up as it is printed or glued, Z out of the print towards the viewer.
The corners of a marker go round as its picture is read: upper left, upper right, lower right, lower
left.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.hardware.camera import aruco
from equipoise.model.arrays import Floats, Matrix3, Vector3

POINTS, MARGIN = 8, 0.12  # on each side of a marker, chosen: and off its corners, which blur rounds
LEAST = 2  # markers of a board with more than one, chosen: one alone is too often ambiguous
AROUND = np.array([[-0.5, 0.5, 0.0], [0.5, 0.5, 0.0], [0.5, -0.5, 0.0], [-0.5, -0.5, 0.0]])


@dataclass(frozen=True, slots=True)
class Marker:
    """One marker on a board."""

    number: int  # its id
    side: float  # m, with its black border
    x: float  # m, of its middle
    y: float  # m
    z: float = 0.0  # m
    rotation: float = 0.0  # rad, of its picture, from X towards Y

    @property
    def middle(self) -> Vector3:
        """Where it is, m."""
        return np.array([self.x, self.y, self.z])

    @property
    def axes(self) -> Matrix3:
        """Its right, its up and its normal, by columns, board axes."""
        c, s = np.cos(self.rotation), np.sin(self.rotation)
        return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])

    @property
    def corners(self) -> Floats:
        """Its corners (4, 3), m."""
        return self.middle + self.side * AROUND @ self.axes.T


@dataclass(frozen=True, slots=True)
class Square:
    """A black square that is no marker, as between the tags of an AprilGrid."""

    side: float  # m
    x: float  # m, of its middle
    y: float  # m


@dataclass(frozen=True, slots=True)
class TagBoard:
    """What is printed, or glued."""

    dictionary: str
    markers: tuple[Marker, ...]
    paper: float  # m, of white around each marker, at least
    border: int = 1  # cells, width of a marker's black border
    squares: tuple[Square, ...] = ()
    place_sd: float = 0.0  # m, of each marker's place as measured; 0: all printed on one sheet

    @property
    def ids(self) -> frozenset[int]:
        """The markers' ids."""
        return frozenset(marker.number for marker in self.markers)

    @property
    def wanted(self) -> int:
        """How many markers a picture has to show."""
        return min(LEAST, len(self.markers))

    @property
    def margin(self) -> float:
        """How much paper a print has around the markers, m; squares stand outside of them."""
        return self.paper * (2 if self.squares else 1)

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Left, bottom, right and top of all markers, m."""
        corners = np.concatenate([marker.corners for marker in self.markers])
        (left, bottom), (right, top) = corners[:, :2].min(axis=0), corners[:, :2].max(axis=0)
        return float(left), float(bottom), float(right), float(top)

    def marker(self, number: int) -> Marker:
        """Return the marker with an id."""
        return next(marker for marker in self.markers if marker.number == number)

    def ink(self, marker: Marker) -> float:
        """Return how wide a marker's black border is, or the paper around it if that is less, m."""
        cells = aruco.cells(aruco.dictionary(self.dictionary, "board"), self.border)
        return min(self.border * marker.side / cells, self.paper)


@dataclass(frozen=True, slots=True, eq=False)
class Borders:
    """Points on the borders of markers, board axes: paper is outside, ink inside."""

    points: Floats  # (..., 3) m
    along: Floats  # (..., 3) unit, along the border
    outward: Floats  # (..., 3) unit, from ink to paper
    ink: Floats  # (...) m, how wide the ink is within a border, or the paper if that is less
    ways: Floats  # (..., 3, k) how points move with each error of the board, see ``board_errors``


def borders_of(marker: Marker) -> tuple[Floats, Floats, Floats]:
    """Return points on a marker's border, directions along it, and outward, each (n, 3)."""
    corners = marker.corners[:, None]
    way = np.roll(corners, -1, axis=0) - corners
    along = (way / marker.side).repeat(POINTS, axis=1).reshape(-1, 3)
    shares = (np.arange(POINTS) + 0.5) / POINTS
    points = corners + (MARGIN + (1 - 2 * MARGIN) * shares[:, None]) * way
    return points.reshape(-1, 3), along, along[:, [1, 0, 2]] * [-1.0, 1.0, 0.0]
