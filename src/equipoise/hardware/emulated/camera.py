"""An emulated camera over a board of markers: draws its view and serves it as MJPEG.

The board's origin stands before the camera, at ``DISTANCE`` along the sight, and turns there.
"""

from collections.abc import Sequence

import numpy as np

from equipoise.hardware.camera.aruco import Picture, encoded
from equipoise.hardware.camera.eye import Eye, eye_of
from equipoise.hardware.emulated.print_texture import sheet_of
from equipoise.hardware.emulated.rendering import Appearance, Renderer
from equipoise.hardware.links.frame_transform import as_sensed
from equipoise.maths.attitude import to_matrix
from equipoise.model.hardware import SensorUnit
from equipoise.model.recording import Recording

DISTANCE = 0.7  # m, chosen: about that of the camera of Ivanov et al. (2021)
HELLO = (
    b"HTTP/1.0 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=picture\r\n"
    b"Cache-Control: no-cache\r\n\r\n"
)
BAD_REQUEST = b"HTTP/1.0 400 Bad Request\r\n\r\n"
QUALITY = 90  # of JPEG, chosen: what cameras do


class EmulatedCamera:
    """Draws each row of attitude once somebody has asked for the stream."""

    def __init__(self, unit: SensorUnit) -> None:
        self._unit = unit
        self._eye = eye_of(unit.settings, f"hardware.sensor {unit.name}: settings")
        self._renderer: Renderer | None = None
        self._rest = b""

    def take(self, data: bytes, t: float) -> bytes:
        """Return the head of the stream to who asks for it."""
        *requests, self._rest = (self._rest + data).split(b"\r\n\r\n")
        if not requests:
            return b""
        if not requests[-1].startswith(b"GET "):
            return BAD_REQUEST
        self._renderer = renderer_of(self._eye, Appearance())
        return HELLO

    def messages(self, rows: Recording) -> Sequence[bytes]:
        """Return the pictures, each a part of the stream."""
        if self._renderer is None or rows.attitude is None:
            return []
        boards = to_matrix(as_sensed(self._unit, "attitude", rows.attitude.values))
        turns = self._eye.to_laboratory.T @ boards
        position = np.array([0.0, 0.0, DISTANCE])
        pairs = zip(rows.attitude.t, turns, strict=True)
        return [part(self._renderer.picture(turn, position), float(t)) for t, turn in pairs]


def renderer_of(eye: Eye, appearance: Appearance, seed: int = 0) -> Renderer:
    """Return what draws the pictures, as fine as they show the board."""
    scale = appearance.finer * eye.lens.fx / DISTANCE  # pixels per m
    return Renderer(sheet_of(eye.board, scale), eye.lens, appearance, seed)


def part(picture: Picture, t: float) -> bytes:
    """Return a picture taken at t (s) as a part of the stream."""
    data = encoded(picture, QUALITY)
    head = f"--picture\r\nContent-Type: image/jpeg\r\nContent-Length: {len(data)}\r\n"
    return head.encode() + b"X-Timestamp: %.6f\r\n\r\n" % t + data + b"\r\n"
