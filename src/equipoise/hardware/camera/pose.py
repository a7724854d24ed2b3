"""The attitude of a board of markers in one picture.

The corners (``first_pose``) give one or two poses; then the borders of all markers in the picture
are brought to coincide with its edges (``borders``):

    minimise  S = sum_k o_k(theta, t, s)^2,   theta, t, s <- theta, t, s - (J^T J)^-1 J^T o
    C = sigma^2 (J^T J)^-1,   sigma^2 = max( S / (n - 7), FLOOR^2 )

R turns board components into camera components; theta is a small turn in board axes, R exp(theta);
t is the position of the board's origin; s is by how much ink is missing on each side of a marker
(a printer's, or a camera's that shows white too wide). The covariance stated is theta's block.

Of two poses that both converge, one is discarded if it fits clearly worse; else the previous
picture decides, or the attitude is ambiguous.

What it cannot see: a lens calibrated wrongly, a board that is not flat or not of the size stated.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from equipoise.hardware.camera.aruco import Picture, floats
from equipoise.hardware.camera.borders import Offsets, offsets
from equipoise.hardware.camera.first_pose import SAME, Corners, Place, angle_between, places_of
from equipoise.hardware.camera.lens import Lens
from equipoise.hardware.camera.tag_board import Borders
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.model.arrays import Bools, Floats, Matrix3

FLOOR = 0.03  # px, chosen: no border is located better than that, however well all fit
CLEARLY = 4.0  # chosen: corners that fit with this times the squares are of the wrong pose
WORSE = 1.5  # chosen: the same of borders, which are located better
NEAR = 0.1  # rad, chosen: a platform turns less from picture to picture
OUTLYING = 4.0  # sd, chosen: beyond it something else than a border was found
LEAST_SD = 0.05  # px, chosen: borders count as located no better
ROUNDS = 4  # chosen: two to come near, one to leave outliers out, one to be exact
ENOUGH = 24  # points, chosen: borders of three sides; they then determine the 7 unknowns well
UNKNOWNS = 7


class Unseen(Enum):
    """Why a picture gives no attitude."""

    NO_BOARD = "the board is not in view"
    AMBIGUOUS = "two attitudes fit alike"


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """How the board is turned."""

    turn: Matrix3  # R, board to camera
    covariance: Matrix3  # rad^2, of a small turn in board axes
    rms: float  # px, of what is left of the borders


def poses_of(picture: Picture, lens: Lens, corners: Corners, borders: Borders) -> list[Pose]:
    """Return the poses that fit, the best first."""
    places = places_of(corners, lens)
    likely = [place for place in places if place.squares <= CLEARLY * places[0].squares]
    poses = [pose for place in likely if (pose := refined(picture, lens, borders, place))]
    return sorted(poses, key=lambda pose: pose.rms)


def chosen(poses: Sequence[Pose], before: Matrix3 | None) -> Pose | Unseen:
    """Return the pose that is meant; ``before`` is R of the picture before, if that is near."""
    if not poses:
        return Unseen.NO_BOARD
    best, *others = poses
    others = [other for other in others if angle_between(other.turn, best.turn) > SAME]
    if all(other.rms**2 > WORSE * best.rms**2 for other in others):
        return best
    if before is None:
        return Unseen.AMBIGUOUS
    near = [pose for pose in (best, *others) if angle_between(pose.turn, before) < NEAR]
    return near[0] if len(near) == 1 else Unseen.AMBIGUOUS


def refined(picture: Picture, lens: Lens, borders: Borders, place: Place) -> Pose | None:
    """Return the pose at which borders coincide; None if too few are visible."""
    turn, position, last = place.turn, place.position, None
    for _ in range(ROUNDS):
        last = _step(offsets(picture, lens, borders, turn, position))
        if last is None:
            return None
        turn = turn @ to_matrix(exponential(last.step[:3]))
        position = position + last.step[3:6]
        borders = replace(borders, points=borders.points - last.step[6] * borders.outward)
    return None if last is None else _stated(turn, last)


@dataclass(frozen=True, slots=True, eq=False)
class Step:
    """What brings borders to coincide, and what of them is left."""

    step: Floats  # (7,)
    slopes: Floats  # (n, 7) J
    left: Floats  # (n,) px


def _step(observed: Offsets) -> Step | None:
    used = _used(observed)
    if np.count_nonzero(used) < ENOUGH:
        return None
    J, off = observed.slopes[used], observed.off[used]
    step = floats(np.linalg.lstsq(J, off, rcond=None)[0])
    return Step(step, J, off - J @ step)


def _used(observed: Offsets) -> Bools:
    """Return which borders were found where most of them are."""
    if not observed.observed.any():
        return observed.observed
    off = observed.off - np.median(observed.off[observed.observed])
    sd = 1.4826 * float(np.median(np.abs(off[observed.observed])))
    return observed.observed & (np.abs(off) <= OUTLYING * max(sd, LEAST_SD))


def _stated(turn: Matrix3, last: Step) -> Pose:
    squares, count = float(last.left @ last.left), len(last.left)
    square = max(squares / (count - UNKNOWNS), FLOOR**2)
    whole = square * floats(np.linalg.inv(last.slopes.T @ last.slopes))
    return Pose(turn, whole[:3, :3], (squares / count) ** 0.5)
