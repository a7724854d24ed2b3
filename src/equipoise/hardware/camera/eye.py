"""Board, lens and mounting of a camera, from its settings.

layout and the keys of the board: see ``board_settings``
fx_px, fy_px, cx_px, cy_px, width_px, height_px, k1, k2, p1, p2, k3    the lens
up_x, up_y, up_z      which way is up, in the camera's axes: X to the right in the picture,
Y down, Z along the sight; without them it points straight down

From the camera's axes to the laboratory's, by which way is up in the picture:

    z = up,   x = the picture's right made level,   y = z x x

all in camera axes. Heading is of no matter to a balance; it is counted from the picture's right. A
camera that is rolled on its side so far that its right is up counts from its picture's top.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from equipoise.hardware.camera.board_settings import BOARD_KEYS, board_of
from equipoise.hardware.camera.lens import Lens
from equipoise.hardware.camera.number_settings import number, whole
from equipoise.hardware.camera.tag_board import TagBoard
from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.errors import InputError, nearest
from equipoise.model.hardware import Setting

LENS = ("fx_px", "fy_px", "cx_px", "cy_px", "width_px", "height_px")
BENT = ("k1", "k2", "p1", "p2", "k3")
UP = ("up_x", "up_y", "up_z")
KEYS = ("rms_px", *BOARD_KEYS, *LENS, *BENT, *UP)
DOWN = (0.0, 0.0, -1.0)  # up, of a camera that points straight down
LENGTH = 0.01  # chosen: of a direction written to two digits
STEEP = 0.9  # chosen: of the right's part along up, beyond which the picture's top is taken


@dataclass(frozen=True, slots=True, eq=False)
class Eye:
    """Board, lens, and the camera's turn to the laboratory."""

    board: TagBoard
    lens: Lens
    to_laboratory: Matrix3


def eye_of(settings: Mapping[str, Setting], where: str) -> Eye:
    """Return an eye from settings; InputError names what is missing, unknown or impossible."""
    for key in settings:
        if key not in KEYS:
            raise InputError(where, f"unknown key '{key}'", nearest(key, list(KEYS)))
    up = np.array(
        [number(settings, key, where, usual) for key, usual in zip(UP, DOWN, strict=True)]
    )
    turn = camera_to_laboratory(checked_up(up, where))
    return Eye(board_of(settings, where), lens_of(settings, where), turn)


def lens_of(settings: Mapping[str, Setting], where: str) -> Lens:
    """Return the lens of settings."""
    fx, fy, cx, cy = (number(settings, key, where) for key in LENS[:4])
    width, height = (whole(settings, key, where) for key in LENS[4:])
    if min(fx, fy, width, height) <= 0:
        raise InputError(where, "a lens of no length or width", "numbers above 0")
    bent = tuple(number(settings, key, where, 0.0) for key in BENT)
    return Lens(fx, fy, cx, cy, width, height, bent)


def settings_of_lens(lens: Lens) -> dict[str, float]:
    """Return a lens as settings: the way back from ``lens_of``."""
    plain = (lens.fx, lens.fy, lens.cx, lens.cy, lens.width, lens.height)
    reported = {} if lens.rms is None else {"rms_px": lens.rms}
    pairs = zip((*LENS, *BENT), (*plain, *lens.distortion), strict=True)
    return {key: value for key, value in pairs} | reported


def camera_to_laboratory(up: Vector3) -> Matrix3:
    """Return L, camera to laboratory: its rows are the laboratory's axes in camera axes."""
    z = up / np.linalg.norm(up)
    right = np.array([1.0, 0.0, 0.0]) if abs(z[0]) < STEEP else np.array([0.0, -1.0, 0.0])
    x = right - (right @ z) * z
    x /= np.linalg.norm(x)
    return np.array([x, np.cross(z, x), z])


def level_up(turns: Floats) -> Vector3:
    """Return up in camera axes from pictures (n, 3, 3) of a board that lies level, face up."""
    mean = turns[:, :, 2].mean(axis=0)
    return mean / np.linalg.norm(mean)


def checked_up(up: Vector3, where: str) -> Vector3:
    """Return a direction of unit length."""
    length = float(np.linalg.norm(up))
    if not abs(length - 1) < LENGTH:
        found = f"up_x, up_y, up_z of length {length:.3g}"
        raise InputError(where, found, "a direction of length 1 in camera axes")
    return up / length
