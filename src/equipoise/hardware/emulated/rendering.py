"""Pictures of a board of markers, as a camera would take them.

Projection and distortion do not use the estimator's code, so that no error is shared. The board's
print is a texture (``print_texture``); a pixel of the picture is interpolated there:

    pixel -> direction (distortion undone by iteration) -> plane of the board -> texture

Then blur, noise, and what stands before the board.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from equipoise.hardware.camera.aruco import Picture, opencv
from equipoise.hardware.camera.lens import Lens
from equipoise.hardware.emulated.print_texture import Sheet
from equipoise.model.arrays import Floats, Matrix3, Vector3

GROUND, BEFORE = 120.0, 80.0  # grey levels, chosen: a dim laboratory
UNDONE = 12  # chosen: steps that undo a distortion; each leaves less than a third of what is left
POOL = 1 << 21  # chosen: numbers of noise drawn once; each picture takes them from another place


@dataclass(frozen=True, slots=True)
class Appearance:
    """How a picture comes out."""

    blur: float = 0.7  # px, sd: out of focus
    smear: float = 0.0  # px, length: moved while it was taken
    noise: float = 2.0  # grey levels, sd
    covered: float = 0.0  # of the board's width: a disc before it, as a hand or a cable
    finer: int = 1  # samples per pixel and axis


class Renderer:
    """Draws one sheet in the view of one camera."""

    def __init__(self, sheet: Sheet, lens: Lens, appearance: Appearance, seed: int = 0) -> None:
        self._sheet, self._lens, self._measurement = sheet, lens, appearance
        self._rng = np.random.default_rng(seed)
        self._x, self._y = directions(lens, appearance.finer)
        self._noise = (appearance.noise * self._rng.standard_normal(POOL)).astype(np.float32)

    def picture(self, turn: Matrix3, position: Vector3) -> Picture:
        """Return the picture of the board at R (board to camera) and its origin's position (m)."""
        lens = self._lens
        canvas = np.full((lens.height, lens.width), int(GROUND), np.uint8)
        box = self._box(turn, position)
        if box is None:
            return canvas
        left, top, right, bottom = box
        part = self._sharp(turn, position, box)
        self._cover(part)
        part = self._blurred(part)
        start = int(self._rng.integers(POOL - part.size)) if part.size < POOL else 0
        part = part + np.resize(self._noise[start : start + part.size], part.shape)
        canvas[top:bottom, left:right] = np.clip(np.rint(part), 0, 255)
        return canvas

    def _box(self, turn: Matrix3, position: Vector3) -> tuple[int, int, int, int] | None:
        """Return left, top, right, bottom of what is drawn, px; None if nothing is in view."""
        height, width = self._sheet.grey.shape
        edges = np.array([[0, 0], [width, 0], [width, -height], [0, -height]]) / self._sheet.scale
        there = self._sheet.corner + edges
        placed = there @ turn[:, :2].T + position
        if placed[:, 2].min() <= 0:
            return None
        observed = project(placed, self._lens)
        margin = 4 + int(3 * self._measurement.blur + self._measurement.smear)
        low = np.floor(observed.min(axis=0)).astype(int) - margin
        high = np.ceil(observed.max(axis=0)).astype(int) + margin
        left, top = (int(v) for v in np.maximum(low, 0))
        right = min(int(high[0]), self._lens.width)
        bottom = min(int(high[1]), self._lens.height)
        return (left, top, right, bottom) if left < right and top < bottom else None

    def _sharp(
        self, turn: Matrix3, position: Vector3, box: tuple[int, int, int, int]
    ) -> NDArray[np.float32]:
        """Return the part of the picture in a box, without blur and noise."""
        left, top, right, bottom = (self._measurement.finer * edge for edge in box)
        x, y = self._x[top:bottom, left:right], self._y[top:bottom, left:right]
        # R[:, :2] (X, Y) + t is along (x, y, 1): the inverse of [r1 r2 t] gives X and Y.
        back = np.linalg.inv(np.column_stack([turn[:, :2], position]))
        scale, corner = self._sheet.scale, self._sheet.corner
        # Texture: column = (X - left edge) scale - 1/2, row = (top edge - Y) scale - 1/2.
        to_texture = np.array(
            [
                [scale, 0.0, -scale * corner[0] - 0.5],
                [0.0, -scale, scale * corner[1] - 0.5],
                [0.0, 0.0, 1.0],
            ]
        )
        m = (to_texture @ back).astype(np.float32)
        third = 1.0 / (m[2, 0] * x + m[2, 1] * y + m[2, 2])
        column = (m[0, 0] * x + m[0, 1] * y + m[0, 2]) * third
        row = (m[1, 0] * x + m[1, 1] * y + m[1, 2]) * third
        cv2 = opencv("camera")
        return cv2.remap(
            self._sheet.grey, column, row, cv2.INTER_LINEAR,
            borderMode=cv2.BORDER_CONSTANT, borderValue=GROUND,
        )  # fmt: skip

    def _cover(self, part: NDArray[np.float32]) -> None:
        """Put a disc before some of the board."""
        if self._measurement.covered > 0:
            width, height = float(part.shape[1]), float(part.shape[0])
            middle = (int(self._rng.uniform(0, width)), int(self._rng.uniform(0, height)))
            radius = int(0.5 * self._measurement.covered * width)
            opencv("camera").circle(part, middle, radius, BEFORE, -1)

    def _blurred(self, part: NDArray[np.float32]) -> NDArray[np.float32]:
        cv2, appearance = opencv("camera"), self._measurement
        height, width = part.shape
        if appearance.blur > 0:
            part = cv2.GaussianBlur(part, (0, 0), appearance.finer * appearance.blur)
        if appearance.smear > 0:
            part = cv2.filter2D(part, -1, self._way(appearance.finer * appearance.smear))
        if appearance.finer > 1:
            size = (width // appearance.finer, height // appearance.finer)
            part = cv2.resize(part, size, interpolation=cv2.INTER_AREA)
        return part

    def _way(self, length: float) -> NDArray[np.float32]:
        """Return a kernel that smears along a straight line of any direction."""
        half = int(np.ceil(length / 2))
        kernel = np.zeros((2 * half + 1, 2 * half + 1), np.float32)
        angle = self._rng.uniform(0, np.pi)
        for share in np.linspace(-0.5, 0.5, 8 * half + 1):
            at = half + share * length * np.array([np.sin(angle), np.cos(angle)])
            row, column = np.floor(at).astype(int)
            down, right = at - [row, column]
            weights = np.outer([1 - down, down], [1 - right, right])
            window = kernel[row : row + 2, column : column + 2]
            window += weights[: window.shape[0], : window.shape[1]].astype(np.float32)
        return kernel / kernel.sum()


def project(points: Floats, lens: Lens) -> Floats:
    """Return the pixels of points (n, 3) m in camera axes; see ``camera.lens``."""
    x, y = points[:, 0] / points[:, 2], points[:, 1] / points[:, 2]
    bent = bend(x, y, lens)
    return np.column_stack([lens.fx * bent[0] + lens.cx, lens.fy * bent[1] + lens.cy])


def bend(x: Floats, y: Floats, lens: Lens) -> tuple[Floats, Floats]:
    """Return a direction after the distortion."""
    k1, k2, p1, p2, k3 = lens.distortion
    square = x * x + y * y
    radial = 1 + square * (k1 + square * (k2 + square * k3))
    return (
        x * radial + 2 * p1 * x * y + p2 * (square + 2 * x * x),
        y * radial + p1 * (square + 2 * y * y) + 2 * p2 * x * y,
    )


@lru_cache(maxsize=2)
def directions(lens: Lens, finer: int) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return x = X/Z and y = Y/Z of every sample: the distortion undone."""
    u = (np.arange(lens.width * finer) + 0.5) / finer - 0.5
    v = (np.arange(lens.height * finer) + 0.5) / finer - 0.5
    observed = np.meshgrid((u - lens.cx) / lens.fx, (v - lens.cy) / lens.fy)
    x, y = observed
    for _ in range(UNDONE if any(lens.distortion) else 0):
        bent = bend(x, y, lens)
        x, y = x + observed[0] - bent[0], y + observed[1] - bent[1]
    return x.astype(np.float32), y.astype(np.float32)
