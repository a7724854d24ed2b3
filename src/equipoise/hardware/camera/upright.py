"""From the camera's axes to the laboratory's, by which way is up in the picture.

    z = up,   x = the picture's right made level,   y = z x x

all in camera axes (X right, Y down, Z along the sight). Heading is of no matter to a balance; it
is counted from the picture's right. A camera that is rolled on its side so far that its right is
up counts from its picture's top.
"""

import numpy as np

from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.errors import InputError

DOWN = (0.0, 0.0, -1.0)  # up, of a camera that points straight down
LENGTH = 0.01  # chosen: of a direction written to two digits
STEEP = 0.9  # chosen: of the right's part along up, beyond which the picture's top is taken


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
