"""The attitude of a board of markers in one picture, and what the picture tells of the board.

The corners (``first_pose``) give one or two poses; then the borders of all markers in the picture
are brought to coincide with its edges (``borders``). It is the likeliest pose, a priori knowledge
of the board's own errors e ~ N(m, P) counted (``board_errors``):

    minimise  sum_k o_k(theta, t, s, e)^2 / sigma^2 + s^2 / INK_SD^2 + (e - m)^T P^-1 (e - m)
    x = (theta, t, s, e) <- x - H^-1 ( J^T o / sigma^2 + s / INK_SD^2 + P^-1 (e - m) )
    H = J^T J / sigma^2 + P^-1,   C = H^-1
    sigma^2 = max( sum o^2 / (n - tr(J^T J C / sigma^2)), FLOOR^2 )

P^-1 stands in the rows of e, 1 / INK_SD^2 in that of s. R turns board components into camera
components; theta is a small turn in board axes, R exp(theta); t is the position of the board's
origin; s is by how much ink is missing on each side of a marker (a printer's, or a camera's that
shows white too wide, and so sought anew in each picture; of one marker alone it looks like
distance, hence INK_SD).

The covariance stated is theta's block of C. A part of it is the same in all pictures of a board, as
e is; it does not average out:

    C_common = C_te C_ee^-1 C_et

Of two poses that both converge, one is discarded if it fits clearly worse; else the previous
picture decides, or the attitude is ambiguous.

What it cannot see: a lens calibrated wrongly, a board that is not flat.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from equipoise.hardware.camera.aruco import Picture
from equipoise.hardware.camera.board_errors import BoardErrors
from equipoise.hardware.camera.borders import Offsets, offsets
from equipoise.hardware.camera.first_pose import SAME, Corners, Place, angle_between, places_of
from equipoise.hardware.camera.lens import Lens
from equipoise.hardware.camera.tag_board import Borders
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.maths.linalg import inverse_spd
from equipoise.model.arrays import Bools, Floats, Matrix3, Vector3
from equipoise.model.reasons.picture_reasons import Unseen
from equipoise.model.reasons.reason import Reason

FLOOR = 0.03  # px, chosen: no border is located better than that, however well all fit
CLEARLY = 4.0  # chosen: corners that fit with this times the squares are of the wrong pose
WORSE = 1.5  # chosen: the same of borders, which are located better
NEAR = 0.1  # rad, chosen: a platform turns less from picture to picture
OUTLYING = 4.0  # sd, chosen: beyond it something else than a border was found
LEAST_SD = 0.05  # px, chosen: borders count as located no better
INK_SD = 1e-3  # m, chosen: what a camera makes of white, about a pixel, and a printer's own 0.1 mm
FIRST_SD = 0.5  # px, chosen: the same at first, when corners alone say where the board is
ROUNDS = 4  # chosen: two to come near, one to leave outliers out, one to be exact
ENOUGH = 24  # points, chosen: borders of three sides; they then determine the 7 unknowns well
OWN, INK = 7, 6  # unknowns of a picture, those of the board follow; s among them


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """How the board is turned."""

    turn: Matrix3  # R, board to camera
    covariance: Matrix3  # rad^2, of a small turn in board axes
    common: Matrix3  # rad^2, the part of it that is the same in all pictures of the board
    rms: float  # px, of what is left of the borders
    board: BoardErrors  # what is known of them with this picture


def poses_of(
    picture: Picture, lens: Lens, corners: Corners, borders: Borders, known: BoardErrors
) -> list[Pose]:
    """Return the poses that fit, the best first."""
    places = places_of(corners, lens)
    likely = [place for place in places if place.squares <= CLEARLY * places[0].squares]
    poses = [pose for place in likely if (pose := refined(picture, lens, borders, place, known))]
    return sorted(poses, key=lambda pose: pose.rms)


def rivals(poses: Sequence[Pose]) -> list[Pose]:
    """Return the poses that fit about as well as the first, which is the best."""
    best, *others = poses
    distinct = [other for other in others if angle_between(other.turn, best.turn) > SAME]
    return [other for other in distinct if other.rms**2 <= WORSE * best.rms**2]


def chosen(poses: Sequence[Pose], before: Matrix3 | None) -> Pose | Reason:
    """Return the pose that is meant; ``before`` is R of the picture before, if that is near."""
    if not poses:
        return Reason(Unseen.NO_FIT)
    alike = rivals(poses)
    if not alike:
        return poses[0]
    if before is None:
        return Reason(Unseen.AMBIGUOUS)
    near = [pose for pose in (poses[0], *alike) if angle_between(pose.turn, before) < NEAR]
    return near[0] if len(near) == 1 else Reason(Unseen.AMBIGUOUS)


@dataclass(frozen=True, slots=True, eq=False)
class Guess:
    """Where the search is."""

    turn: Matrix3
    position: Vector3  # m
    less: float  # m, of ink on each side
    errors: Floats  # (k,) of the board
    sd: float | None = None  # px, of a border's offset; None: not yet known


def refined(
    picture: Picture, lens: Lens, borders: Borders, place: Place, known: BoardErrors
) -> Pose | None:
    """Return the pose at which borders coincide; None if too few are visible."""
    guess, last = Guess(place.turn, place.position, 0.0, known.mean), None
    k = len(known.mean)
    information = np.zeros((OWN + k, OWN + k))
    information[INK, INK], information[OWN:, OWN:] = INK_SD**-2, inverse_spd(known.covariance)
    for _ in range(ROUNDS):
        moved = borders.points + borders.ways @ guess.errors - guess.less * borders.outward
        there = replace(borders, points=moved)
        observed = offsets(picture, lens, there, guess.turn, guess.position)
        try:
            last = _step(observed, guess.sd, information, _back(guess, known))
        except np.linalg.LinAlgError:  # borders that determine no pose
            return None
        if last is None:
            return None
        guess = _after(guess, last)
    return None if last is None else _stated(guess, last)


@dataclass(frozen=True, slots=True, eq=False)
class Step:
    """What brings borders to coincide, and what of them is left."""

    step: Floats  # (7 + k,)
    covariance: Floats  # (7 + k, 7 + k)
    sd: float  # px, of a border's offset
    rms: float  # px, of what is left


def _step(observed: Offsets, sd: float | None, information: Floats, back: Floats) -> Step | None:
    """Return the step; ``back`` is from the guess to what is known a priori."""
    if not observed.observed.any():
        return None
    used, robust = _used(observed, FIRST_SD if sd is None else LEAST_SD)
    if np.count_nonzero(used) < ENOUGH:
        return None
    J, off, sd = observed.slopes[used], observed.off[used], robust if sd is None else sd
    normal = J.T @ J
    whole, by = normal / sd**2 + information, J.T @ off / sd**2 + information @ back
    inverse = inverse_spd(whole)
    step = inverse @ by
    left = off - J @ step
    squares = float(left @ left)
    free = len(off) - float(np.sum(inverse * normal)) / sd**2
    after = max((squares / free) ** 0.5, FLOOR)
    stated = inverse_spd(normal / after**2 + information)
    return Step(step, stated, after, (squares / len(off)) ** 0.5)


def _back(guess: Guess, known: BoardErrors) -> Floats:
    """Return the way from a guess to what is known a priori, zero where nothing is."""
    return np.concatenate([np.zeros(INK), [-guess.less], known.mean - guess.errors])


def _used(observed: Offsets, least: float) -> tuple[Bools, float]:
    """Return which borders were found where most of them are, and the sd of these, px."""
    off = observed.off - np.median(observed.off[observed.observed])
    sd = 1.4826 * float(np.median(np.abs(off[observed.observed])))
    near = np.abs(off) <= OUTLYING * max(sd, least)
    return observed.observed & near, max(sd, FLOOR)


def _after(guess: Guess, last: Step) -> Guess:
    step = last.step
    return Guess(
        guess.turn @ to_matrix(exponential(step[:3])),
        guess.position + step[3:6],
        guess.less + float(step[6]),
        guess.errors + step[OWN:],
        last.sd,
    )


def _stated(guess: Guess, last: Step) -> Pose:
    own, board = last.covariance[:3, :3], last.covariance[OWN:, OWN:]
    both = last.covariance[:3, OWN:]
    common = both @ np.linalg.solve(board, both.T)
    return Pose(guess.turn, own, common, last.rms, BoardErrors(guess.errors, board))
