"""A camera that observes a board of markers on the platform.

Settings: see ``hardware.camera.eye``. The sensor's axes are the board's (X to the right and Y up
as it is printed, Z out of the print); its laboratory has Z up, by ``up_x, up_y, up_z``.

Over ``http:`` it receives pictures in a stream (MJPEG); the head X-Timestamp of a part, as
mjpg-streamer and cameras with an ESP32 send it, is the time at which the picture was taken. Over
``camera:`` each datagram is a picture.
"""

from collections.abc import Sequence

from equipoise.hardware.camera.aruco import Picture, decoded
from equipoise.hardware.camera.eye import eye_of
from equipoise.hardware.camera.pose import Pose
from equipoise.hardware.camera.raw_picture import unpacked
from equipoise.hardware.camera.sight import Sight, other_size
from equipoise.hardware.transport.conversation import SensorDriver
from equipoise.hardware.transport.finite_numbers import finite
from equipoise.hardware.transport.mjpeg_stream import Part, Parts
from equipoise.hardware.transport.requests import ONCE
from equipoise.maths.attitude import from_matrix
from equipoise.model.hardware import SensorUnit
from equipoise.model.reading import Reading

BEGIN, END = b"\xff\xd8", b"\xff\xd9"  # of a JPEG picture
STAMP = "x-timestamp"
STREAM = "the stream of pictures"


class Camera(SensorDriver):
    """The conversation with a camera."""

    def __init__(self, unit: SensorUnit) -> None:
        self._where = f"hardware.sensor {unit.name}: settings"
        self._eye = eye_of(unit.settings, self._where)
        head = request(unit.port.address)
        super().__init__({STREAM: head} if head else {}, again=ONCE)
        self._parts, self._sight = Parts(), self._anew()

    def opened(self) -> None:
        """Restart."""
        super().opened()
        self._parts.cleared()
        self._sight = self._anew()

    def feed(self, data: bytes) -> Sequence[Reading]:
        """Return the rows of the pictures that are whole with these bytes."""
        if not self._spoken:
            return self._raw(data)
        lost = self._parts.lost
        parts = self._parts.cut(data)
        if parts:
            self.requests.confirmed(STREAM)
        readings = [r for part in parts for r in self._part(part)]
        self.count(corrupt=self._parts.lost - lost)
        return readings

    def _anew(self) -> Sight:
        return Sight(self._eye.board, self._eye.lens, self._where)

    def _raw(self, data: bytes) -> list[Reading]:
        picture = unpacked(data)
        if picture is None:
            return self.counted([])
        return self._observed(picture.grey, picture.t, picture.number)

    def _part(self, part: Part) -> list[Reading]:
        body = part.body.rstrip(b"\r\n\0")  # some cameras fill up behind the picture
        whole = body.startswith(BEGIN) and body.endswith(END)
        picture = decoded(body) if whole else None
        if picture is None:
            return self.counted([])
        return self._observed(picture, finite(part.head.get(STAMP, "")), None)

    def _observed(self, picture: Picture, stamp: float | None, number: int | None) -> list[Reading]:
        other = other_size(picture, self._eye.lens)
        pose = self._sight.observe(picture) if other is None else other
        if not isinstance(pose, Pose):
            return self.without_row(pose)
        attitude = from_matrix(self._eye.to_laboratory @ pose.turn)
        return self.counted([Reading("attitude", tuple(map(float, attitude)), stamp, number)])


def request(address: str) -> bytes:
    """Return the request for a stream; nothing for a camera of this computer."""
    if not address.startswith("http:"):
        return b""
    host, _, path = address.removeprefix("http://").partition("/")
    return f"GET /{path} HTTP/1.1\r\nHost: {host}\r\nAccept: */*\r\n\r\n".encode()
