"""What a lens does: from a direction to a pixel.

    u = fx x' + cx,   v = fy y' + cy
    x' = x c + 2 p1 x y + p2 (r^2 + 2 x^2),   y' = y c + p1 (r^2 + 2 y^2) + 2 p2 x y
    c = 1 + k1 r^2 + k2 r^4 + k3 r^6,   x = X / Z,   y = Y / Z,   r^2 = x^2 + y^2

in the camera's axes: X to the right in the picture, Y down, Z along the sight. OpenCV, "Camera
Calibration and 3D Reconstruction", has the same model and order (k1, k2, p1, p2, k3).
"""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Floats, Matrix3


@dataclass(frozen=True, slots=True)
class Lens:
    """Numbers of one camera with its lens, at one size of picture."""

    fx: float  # px
    fy: float  # px
    cx: float  # px
    cy: float  # px
    width: int  # px
    height: int  # px
    distortion: tuple[float, ...] = (0.0,) * 5  # k1, k2, p1, p2, k3
    rms: float | None = None  # px, residual of its calibration; None: not stated

    @property
    def matrix(self) -> Matrix3:
        """The camera matrix."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])

    @property
    def coefficients(self) -> Floats:
        """The distortion."""
        return np.array(self.distortion)
