"""How far the borders of markers in a picture are from where a pose has them.

At each point of a border the picture is read along the border's normal, from ink to paper. Where
the border is, that is the middle of the rise of grey:

    o = sum_j m_j ( g_{j+1} - g_j ) / ( g_last - g_first ),    m_j between samples j and j + 1

A blur that is the same to both sides does not move it, unlike a corner, which a blur rounds off.
After C. Harris (1992), "Tracking with rigid models", in Active Vision, MIT Press.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.hardware.camera.aruco import Picture, opencv
from equipoise.hardware.camera.lens import Lens
from equipoise.hardware.camera.tag_board import Borders
from equipoise.model.arrays import Bools, Floats, Matrix3, Vector3

SAMPLES = 13  # of a line across the border, chosen: half a pixel to a pixel apart
REACH = 0.45  # of the ink's width, chosen: a line stays within the border and the paper around it
LEAST, MOST = 1.5, 6.0  # px, chosen: half a line's length
CONTRAST = 15.0  # grey levels, chosen: from ink to paper
INSIDE = 0.7  # of half a line, chosen: a rise nearer to its end may be of something else


@dataclass(frozen=True, slots=True, eq=False)
class Offsets:
    """How far borders are out of place, along their normals, outward; and how that moves."""

    off: Floats  # (n,) px
    # px per rad of turn in board axes, m of position, m of less ink, and error of the board
    slopes: Floats  # (n, 7 + k)
    observed: Bools  # (n,) where a border was found


def offsets(
    picture: Picture, lens: Lens, borders: Borders, turn: Matrix3, position: Vector3
) -> Offsets:
    """Return the offsets at a pose."""
    cv2 = opencv("camera")
    placed, outward = borders.points @ turn.T, borders.outward @ turn.T
    observed, slopes = cv2.projectPoints(
        placed, np.zeros(3), position, lens.matrix, lens.coefficients
    )[:2]
    by_place = slopes[:, 3:6].reshape(-1, 2, 3)  # of each pixel by its point, camera axes
    along = np.einsum("nij,nj->ni", by_place, borders.along @ turn.T)
    normal = along[:, ::-1] * [1.0, -1.0] / np.linalg.norm(along, axis=1, keepdims=True)
    by_point = np.einsum("ni,nij->nj", normal, by_place)
    half = np.clip(REACH * borders.ink * np.sum(by_point * outward, axis=1), LEAST, MOST)
    off, found = _rise(_lines(picture, observed.reshape(-1, 2), normal * half[:, None]))
    # R exp(theta) X moves with theta_k as (R e_k) x (R X); less ink moves a border inward.
    by_turn = np.einsum("nj,nkj->nk", by_point, np.cross(turn.T, placed[:, None, :]))
    by_ink = -np.sum(by_point * outward, axis=1, keepdims=True)
    by_errors = np.matmul((by_point @ turn)[:, None], borders.ways)[:, 0]
    return Offsets(half * off, np.hstack([by_turn, by_point, by_ink, by_errors]), found)


def _lines(picture: Picture, middle: Floats, reach: Floats) -> Floats:
    """Return the grey levels (n, SAMPLES) along lines from middle - reach to middle + reach."""
    cv2 = opencv("camera")
    at = middle[:, None] + np.linspace(-1, 1, SAMPLES)[:, None] * reach[:, None]
    maps = at.astype(np.float32)
    read = cv2.remap(picture, maps, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    return read.astype(float)


def _rise(grey: Floats) -> tuple[Floats, Bools]:
    """Return the middle of each rise, of half a line's length, and whether it is one."""
    between = np.linspace(-1, 1, 2 * SAMPLES - 1)[1::2]
    whole = grey[:, -1] - grey[:, 0]
    clear = whole > CONTRAST
    middle = np.diff(grey, axis=1) @ between / np.where(clear, whole, 1.0)
    return middle, clear & (np.abs(middle) < INSIDE)
