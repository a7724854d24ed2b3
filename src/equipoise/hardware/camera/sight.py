"""From picture to attitude: markers found, matched with the board, and its pose.

The search begins where the board was in the previous picture: a part of a picture takes a part of
the time. If markers are missing there, the whole picture is searched.

The board's own errors (``board_errors``) are the same in every picture. What one picture tells of
them is known a priori in the next, if one attitude alone fitted, and if the board is turned by
``NEW`` or more from the last picture that taught: two pictures alike share their errors.
"""

from collections import Counter

import numpy as np

from equipoise.hardware.camera import aruco
from equipoise.hardware.camera.aruco import Picture
from equipoise.hardware.camera.board_errors import borders_on, prior_of, worn
from equipoise.hardware.camera.first_pose import Corners, angle_between
from equipoise.hardware.camera.lens import Lens
from equipoise.hardware.camera.pose import Pose, chosen, poses_of, rivals
from equipoise.hardware.camera.tag_board import Borders, TagBoard
from equipoise.model.arrays import Floats, Matrix3
from equipoise.model.reasons.picture_reasons import Unseen
from equipoise.model.reasons.reason import Reason

AROUND = 0.15  # of the board's extent, chosen: what it may move from picture to picture
MOST_LOST = 0.2  # of the markers, chosen: when more are gone, all of the picture is searched
NEW = 0.035  # rad, chosen: 2 deg, some pixels at the edge of a board


Region = tuple[slice, slice]  # rows and columns of a picture, px


class Sight:
    """Evaluates one picture after the other."""

    def __init__(self, board: TagBoard, lens: Lens, where: str) -> None:
        self._board, self._lens = board, lens
        markers = aruco.dictionary(board.dictionary, where)
        self._seeker = aruco.seeker_of(markers, board.border, bool(board.squares))
        self._rows, self._borders = borders_on(board)
        self._corners = np.array([marker.corners for marker in board.markers])
        self._prior = self._known = prior_of(board)
        self._taught: Matrix3 | None = None  # R of the last picture that taught
        self._before: Pose | None = None
        self._region: Region | None = None
        self._count = 0  # of markers found in the previous picture

    def observe(self, picture: Picture) -> Pose | Reason:
        """Return the board's pose in a picture, or why there is none."""
        markers, others = self._markers(picture)
        self._count = len(markers)
        if len(markers) < self._board.wanted:
            self._before = self._region = None
            return _too_few(len(markers), others, self._board.wanted)
        self._region = _around(np.concatenate(list(markers.values())), picture)
        turn = None if self._before is None else self._before.turn
        corners, borders = self._matched(markers)
        poses = poses_of(picture, self._lens, corners, borders, self._known)
        pose = chosen(poses, turn)
        self._before = pose if isinstance(pose, Pose) else None
        if poses and not rivals(poses):
            self._learn(poses[0])
        return pose

    def _learn(self, pose: Pose) -> None:
        """Know the board better by a picture of it."""
        if self._taught is None or angle_between(self._taught, pose.turn) > NEW:
            self._known, self._taught = worn(pose.board, self._prior), pose.turn

    def _markers(self, picture: Picture) -> tuple[dict[int, Floats], int]:
        """Return the corners of the board's markers by id, px, and how many others there are."""
        if self._region is not None:
            found, others = self._within(picture, self._region)
            if len(found) >= (1 - MOST_LOST) * self._count:
                return found, others
        height, width = picture.shape[:2]
        return self._within(picture, (slice(0, height), slice(0, width)))

    def _within(self, picture: Picture, region: Region) -> tuple[dict[int, Floats], int]:
        offset = np.array([region[1].start, region[0].start])
        pairs = aruco.found(self._seeker, np.ascontiguousarray(picture[region]))
        times = Counter(number for number, _ in pairs)
        found = {
            number: corners + offset
            for number, corners in pairs
            if number in self._rows and times[number] == 1
        }
        return found, sum(count for number, count in times.items() if number not in self._rows)

    def _matched(self, markers: dict[int, Floats]) -> tuple[Corners, Borders]:
        """Return the corners and borders of the markers that were found."""
        rows, all_ = [self._rows[number] for number in markers], self._borders
        borders = Borders(
            all_.points[rows].reshape(-1, 3),
            all_.along[rows].reshape(-1, 3),
            all_.outward[rows].reshape(-1, 3),
            all_.ink[rows].ravel(),
            all_.ways[rows].reshape(-1, 3, all_.ways.shape[-1]),
        )
        own = self._corners[rows].reshape(-1, 3)
        return Corners(own, np.concatenate(list(markers.values()))), borders


def other_size(picture: Picture, lens: Lens) -> Reason | None:
    """Return why a picture is of no use if it has another size than the lens is known for."""
    height, width = picture.shape[:2]
    if (width, height) == (lens.width, lens.height):
        return None
    wanted = {"lens_width": lens.width, "lens_height": lens.height}
    return Reason(Unseen.OTHER_SIZE, numbers={"width": width, "height": height} | wanted)


def _too_few(count: int, others: int, wanted: int) -> Reason:
    """Return why there is no attitude; a board of more than one marker wants two."""
    numbers = {"found": count, "others": others, "wanted": wanted}
    if count:
        return Reason(Unseen.ONE_MARKER, numbers=numbers)
    return Reason(Unseen.OTHER_MARKERS if others else Unseen.NO_MARKER, numbers=numbers)


def _around(corners: Floats, picture: Picture) -> Region:
    """Return the region around corners, and something more on each side."""
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = AROUND * float((high - low).max())
    height, width = picture.shape[:2]
    left, top = np.maximum(low - margin, 0).astype(int)
    right, bottom = np.minimum(high + margin + 1, [width, height]).astype(int)
    return slice(int(top), int(bottom)), slice(int(left), int(right))
