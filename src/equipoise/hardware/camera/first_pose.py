"""The poses that fit the corners of markers in a picture: where the refinement begins.

A distant plane fits two poses (T. Collins & A. Bartoli, 2014, "Infinitesimal plane-based
pose estimation", IJCV 109, 252-286). Both are returned, and each is refined to the least squares
of its corners (K. Levenberg, D. Marquardt), as OpenCV has it. Tags at several heights count as in
one plane at first; the refinement has them where they are.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.hardware.camera.aruco import floats, opencv
from equipoise.hardware.camera.lens import Lens
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.model.arrays import Floats, Matrix3, Vector3

SAME = 0.01  # rad, chosen: attitudes nearer than that are one


@dataclass(frozen=True, slots=True, eq=False)
class Corners:
    """Corners of a board's markers or squares, on the board and in one picture."""

    board: Floats  # (n, 3) m
    picture: Floats  # (n, 2) px


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """Where the board may be."""

    turn: Matrix3  # R, board to camera
    position: Vector3  # m, of the board's origin, camera axes
    squares: float  # px^2, mean of what is left of each corner


def places_of(corners: Corners, lens: Lens) -> list[Place]:
    """Return the poses that fit, the best first; none for corners on one line."""
    cv2 = opencv("camera")
    picture = corners.picture.reshape(-1, 1, 2)
    observed = (corners.board, picture, lens.matrix, lens.coefficients)
    flat = (corners.board * [1.0, 1.0, 0.0], *observed[1:])
    try:
        _, turns, positions, _ = cv2.solvePnPGeneric(*flat, flags=cv2.SOLVEPNP_IPPE)
        both = [
            cv2.solvePnPRefineLM(*observed, turn, position)
            for turn, position in zip(turns, positions, strict=True)
        ]
    except cv2.error:
        return []
    found = [
        _place(corners, lens, floats(turn).ravel(), floats(where).ravel()) for turn, where in both
    ]
    best, *others = sorted(found, key=lambda place: place.squares)
    others = [other for other in others if angle_between(other.turn, best.turn) > SAME]
    return [place for place in (best, *others) if _possible(place)]


def angle_between(one: Matrix3, other: Matrix3) -> float:
    """Return the angle between two turns, rad."""
    return float(np.arccos(np.clip((np.trace(one.T @ other) - 1) / 2, -1.0, 1.0)))


def _place(corners: Corners, lens: Lens, vector: Vector3, position: Vector3) -> Place:
    observed = opencv("camera").projectPoints(
        corners.board, vector, position, lens.matrix, lens.coefficients
    )[0]
    left = floats(observed).reshape(-1, 2) - corners.picture
    return Place(to_matrix(exponential(vector)), position, float(np.mean(left**2)))


def _possible(place: Place) -> bool:
    """Say whether a pose is finite and before the camera, its print facing it."""
    reported = np.isfinite(place.turn).all() and np.isfinite(place.position).all()
    return bool(reported and place.position[2] > 0 and place.turn[:, 2] @ place.position < 0)
