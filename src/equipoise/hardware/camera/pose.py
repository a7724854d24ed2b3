"""The attitude of a board of markers from the corners seen in one picture.

    minimise  S = sum | u_k - project( R X_k + t ) |^2   over R, t (and s)
    C = sigma^2 (J^T J)^-1,   sigma^2 = max( S / (2 n - m), FLOOR^2 ),   J = d project / d (theta, t, s)

R turns board components into camera components; theta is a small turn in board axes, R exp(theta).
The covariance stated is the block of theta.

s: by how much the markers appear to be smaller on each side than they are. A blurred picture, or
ink that runs, moves every corner along the diagonal of its marker by the same length; what is
common to all markers says nothing about the attitude, but would look like noise.

A plane seen from afar fits two attitudes (T. Collins & A. Bartoli, 2014, "Infinitesimal
plane-based pose estimation", IJCV 109, 252-286). Both are refined; the second counts unless it
fits clearly worse, and then the attitude before decides, or nothing is said.

What it cannot see: a lens calibrated wrongly, a board that is not flat or not of the size stated.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from equipoise.hardware.camera.aruco import opencv
from equipoise.hardware.camera.lens import Lens
from equipoise.maths.attitude import exponential, from_matrix, to_matrix
from equipoise.model.arrays import Floats, Matrix3, Quaternion, Vector3

FLOOR = 0.03  # px, chosen: corners are not told better than that, however well they fit
WORSE = 1.5  # chosen: a fit of this times the squares is the wrong one of two
SAME = 0.01  # rad, chosen: attitudes nearer than that are one
NEAR = 0.1  # rad, chosen: a platform turns less from picture to picture
OUTLYING = 4.0  # sd, chosen: of 240 numbers one in a hundred boards has one beyond by chance
LEAST_OUTLYING = 0.3  # px, chosen: nearer than that a corner is never left out
STEPS, SETTLED = 10, 1e-7  # chosen: of Gauss and Newton; rad and m
UNKNOWNS = 7


class Unseen(Enum):
    """Why a picture gives no attitude."""

    NO_BOARD = "the board is not in view"
    AMBIGUOUS = "two attitudes fit alike"


@dataclass(frozen=True, slots=True, eq=False)
class Corners:
    """Corners of markers, four of each: on the board and in the picture."""

    board: Floats  # (n, 3) m
    inward: Floats  # (n, 3) from each towards the middle of its marker, per side that is cut off
    picture: Floats  # (n, 2) px


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """Where the board is."""

    turn: Matrix3  # R, board to camera
    position: Vector3  # m, of the board's origin, camera axes
    covariance: Matrix3  # rad^2, of a small turn in board axes
    rms: float  # px, of what is left of each coordinate
    corners: int  # that were used

    @property
    def attitude(self) -> Quaternion:
        """R as a quaternion, scalar first."""
        return from_matrix(self.turn)


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """One attitude that fits."""

    turn: Matrix3
    position: Vector3
    less: float  # m, s
    left: Floats  # (n, 2) px
    normal: Floats  # J^T J

    @property
    def squares(self) -> float:
        """S, px^2."""
        return float(np.sum(self.left**2))


def pose_of(corners: Corners, lens: Lens, before: Matrix3 | None = None) -> Pose | Unseen:
    """Return where the board is; ``before`` is R of the picture before, if that is not long ago."""
    fits = _fits(corners, lens)
    if not fits:
        return Unseen.NO_BOARD
    best = _chosen(fits, before)
    if best is None:
        return Unseen.AMBIGUOUS
    good = _good(best.left)
    if not good.all() and 2 * np.count_nonzero(good) > UNKNOWNS:
        best = _refined(_kept(corners, good), lens, best)
    return _stated(best)


def _fits(corners: Corners, lens: Lens) -> list[Fit]:
    """Return the attitudes that fit, each once, the best first."""
    cv2 = opencv("camera")
    picture = corners.picture.reshape(-1, 1, 2)
    try:
        _, turns, positions, _ = cv2.solvePnPGeneric(
            corners.board, picture, lens.matrix, lens.coefficients, flags=cv2.SOLVEPNP_IPPE
        )
    except cv2.error:  # corners on one line
        return []
    found: list[Fit] = []
    for vector, position in zip(turns, positions, strict=True):
        turn, where = to_matrix(exponential(np.ravel(vector))), np.ravel(position)
        if not (np.isfinite(turn).all() and np.isfinite(where).all()):
            continue
        fit = _refined(corners, lens, Fit(turn, where, 0.0, corners.picture, np.eye(UNKNOWNS)))
        if fit.position[2] > 0 and all(_between(fit.turn, other.turn) > SAME for other in found):
            found.append(fit)
    return sorted(found, key=lambda fit: fit.squares)


def _chosen(fits: list[Fit], before: Matrix3 | None) -> Fit | None:
    """Return the attitude that is meant; None if nothing tells."""
    best, *others = fits
    if all(other.squares > WORSE * best.squares for other in others):
        return best
    near = [fit for fit in fits if before is not None and _between(fit.turn, before) < NEAR]
    return near[0] if len(near) == 1 else None


def _good(left: Floats) -> NDArray[np.bool_]:
    """Return which corners fit, by the median of all."""
    off = np.linalg.norm(left, axis=1)
    sd = float(np.median(off)) / 1.1774  # the median of a Rayleigh distribution
    return off <= max(OUTLYING * sd, LEAST_OUTLYING)


def _kept(corners: Corners, good: NDArray[np.bool_]) -> Corners:
    return Corners(corners.board[good], corners.inward[good], corners.picture[good])


def _refined(corners: Corners, lens: Lens, start: Fit) -> Fit:
    """Return the least squares near a start, by Gauss and Newton."""
    fit, step = _linear(corners, lens, (start.turn, start.position, start.less))
    for _ in range(STEPS):
        new, following = _linear(corners, lens, _stepped(fit, step))
        if not new.squares < fit.squares:
            break
        small = np.abs(step).max() < SETTLED
        fit, step = new, following
        if small:
            break
    return fit


def _stepped(fit: Fit, step: Floats) -> tuple[Matrix3, Vector3, float]:
    turn = fit.turn @ to_matrix(exponential(step[:3]))
    return turn, fit.position + step[3:6], fit.less + float(step[6])


def _linear(
    corners: Corners, lens: Lens, at: tuple[Matrix3, Vector3, float]
) -> tuple[Fit, Floats]:
    """Return what is left at a pose, and the step that would end it if all were linear."""
    turn, position, less = at
    cv2 = opencv("camera")
    placed = (corners.board + less * corners.inward) @ turn.T  # camera axes, from the board's origin
    seen, slopes = cv2.projectPoints(
        placed, np.zeros(3), position, lens.matrix, lens.coefficients
    )[:2]
    by_place = slopes[:, 3:6].reshape(-1, 2, 3)  # of each pixel by its point, camera axes
    left = corners.picture - seen.reshape(-1, 2)
    # R exp(theta) X moves with theta_k as (R e_k) x (R X).
    by_turn = by_place @ np.cross(turn.T, placed[:, None, :]).swapaxes(1, 2)
    by_less = by_place @ (corners.inward @ turn.T)[:, :, None]
    J = np.concatenate([by_turn, by_place, by_less], axis=2).reshape(-1, UNKNOWNS)
    normal = J.T @ J
    step = np.linalg.lstsq(normal, J.T @ left.ravel(), rcond=None)[0]
    return Fit(turn, position, less, left, normal), step


def _stated(fit: Fit) -> Pose:
    count = fit.left.size
    square = fit.squares / (count - UNKNOWNS)
    covariance = max(square, FLOOR**2) * np.linalg.inv(fit.normal)[:3, :3]
    return Pose(fit.turn, fit.position, covariance, (fit.squares / count) ** 0.5, count // 2)


def _between(one: Matrix3, other: Matrix3) -> float:
    """Return the angle between two turns, rad."""
    return float(np.arccos(np.clip((np.trace(one.T @ other) - 1) / 2, -1.0, 1.0)))
