"""From picture to attitude: markers found, matched with the board, and its pose.

The search begins where the board was in the previous picture: a part of a picture takes a part of
the time. If markers are missing there, the whole picture is searched.
"""

import numpy as np

from equipoise.hardware.camera import aruco
from equipoise.hardware.camera.aruco import Picture
from equipoise.hardware.camera.first_pose import Corners
from equipoise.hardware.camera.lens import Lens
from equipoise.hardware.camera.pose import Pose, Unseen, chosen, poses_of
from equipoise.hardware.camera.tag_board import LEAST, Borders, TagBoard
from equipoise.model.arrays import Floats

AROUND = 0.15  # of the board's extent, chosen: what it may move from picture to picture
MOST_LOST = 0.2  # of the markers, chosen: when more are gone, all of the picture is searched


Region = tuple[slice, slice]  # rows and columns of a picture, px


class Sight:
    """Evaluates one picture after the other."""

    def __init__(self, board: TagBoard, lens: Lens, where: str) -> None:
        self._board, self._lens = board, lens
        self._seeker = aruco.detector(aruco.dictionary(board.dictionary, where))
        self._borders = {number: board.borders(number) for number in board.ids}
        self._before: Pose | None = None
        self._region: Region | None = None
        self._count = 0  # of markers found in the previous picture

    def observe(self, picture: Picture) -> Pose | Unseen:
        """Return the board's pose in a picture."""
        markers = self._markers(picture)
        self._count = len(markers)
        if len(markers) < LEAST:
            self._before = self._region = None
            return Unseen.NO_BOARD
        self._region = _around(np.concatenate(list(markers.values())), picture)
        turn = None if self._before is None else self._before.turn
        corners, borders = self._matched(markers)
        pose = chosen(poses_of(picture, self._lens, corners, borders), turn)
        self._before = pose if isinstance(pose, Pose) else None
        return pose

    def _markers(self, picture: Picture) -> dict[int, Floats]:
        """Return the corners of the board's markers by id, px."""
        if self._region is not None:
            found = self._within(picture, self._region)
            if len(found) >= (1 - MOST_LOST) * self._count:
                return found
        height, width = picture.shape[:2]
        return self._within(picture, (slice(0, height), slice(0, width)))

    def _within(self, picture: Picture, region: Region) -> dict[int, Floats]:
        offset = np.array([region[1].start, region[0].start])
        pairs = aruco.found(self._seeker, np.ascontiguousarray(picture[region]))
        ids = [number for number, _ in pairs]
        return {
            number: corners + offset
            for number, corners in pairs
            if number in self._board.ids and ids.count(number) == 1
        }

    def _matched(self, markers: dict[int, Floats]) -> tuple[Corners, Borders]:
        """Return the corners and borders of the markers that were found."""
        own = np.concatenate([self._board.corners(number) for number in markers])
        each = [self._borders[number] for number in markers]
        borders = Borders(
            np.concatenate([b.points for b in each]),
            np.concatenate([b.along for b in each]),
            np.concatenate([b.outward for b in each]),
            self._board.ink,
        )
        return Corners(own, np.concatenate(list(markers.values()))), borders


def _around(corners: Floats, picture: Picture) -> Region:
    """Return the region around corners, and something more on each side."""
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = AROUND * float((high - low).max())
    height, width = picture.shape[:2]
    left, top = np.maximum(low - margin, 0).astype(int)
    right, bottom = np.minimum(high + margin + 1, [width, height]).astype(int)
    return slice(int(top), int(bottom)), slice(int(left), int(right))
