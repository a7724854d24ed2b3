"""A camera of this computer as a port: each picture is one datagram, the newest only.

    camera:0              the first camera, at the size that it has by itself
    camera:0@1280x960     asked for pictures of that size

A thread of its own opens the camera and reads it, so that nobody waits for a picture. A picture
that comes before the last one was taken away replaces it; numbers show how many were lost so.
"""

import threading
import time
from typing import Any

from equipoise.hardware.camera.aruco import opencv
from equipoise.hardware.camera.raw_picture import RawPicture, packed
from equipoise.hardware.transport.port import PortLost
from equipoise.model.errors import InputError

LEAVE = 2.0  # s, chosen: for the thread to end when the port is closed


class CapturePort:
    """The newest picture of a camera, or of a video file in its place."""

    def __init__(self, address: str, source: int | str, size: tuple[int, int] | None) -> None:
        self._address, self._cv2 = address, opencv(address)
        logging = self._cv2.utils.logging  # we report a missing camera ourselves, once
        logging.setLogLevel(logging.LOG_LEVEL_ERROR)
        self._newest: RawPicture | None = None
        self._why, self._ended = "", threading.Event()
        arguments = (source, size)
        self._thread = threading.Thread(target=self._run, args=arguments, daemon=True)
        self._thread.start()

    def receive(self) -> list[bytes]:
        """Return the newest picture, if there is one since the last call."""
        newest, self._newest = self._newest, None
        if newest is not None:
            return [packed(newest)]
        if self._why:
            raise PortLost(self._address, self._why)
        return []

    def send(self, data: bytes) -> None:
        """Say nothing: a camera listens to nobody."""

    def close(self) -> None:
        """Leave the camera to others."""
        self._ended.set()
        self._thread.join(LEAVE)

    def _run(self, source: int | str, size: tuple[int, int] | None) -> None:
        camera = self._cv2.VideoCapture(source)
        try:
            if not camera.isOpened():
                self._why = "it does not open: is it there, and does no other program hold it?"
                return
            if size is not None:
                camera.set(self._cv2.CAP_PROP_FRAME_WIDTH, size[0])
                camera.set(self._cv2.CAP_PROP_FRAME_HEIGHT, size[1])
            self._read(camera)
        finally:
            camera.release()

    def _read(self, camera: Any) -> None:
        number = 0
        while not self._ended.is_set():
            good, picture = camera.read()
            if not good:
                self._why = "the camera gives no more pictures"
                return
            grey = self._cv2.cvtColor(picture, self._cv2.COLOR_BGR2GRAY)
            self._newest = RawPicture(grey, number, time.monotonic())
            number += 1


def camera_at(address: str) -> tuple[int, tuple[int, int] | None]:
    """Return a camera's number and the size asked for, px, of an address without its scheme."""
    number, at, size = address.partition("@")
    sides = size.split("x")
    if not number.isdecimal() or (at and not (len(sides) == 2 and all(map(str.isdecimal, sides)))):
        raise InputError(f"port camera:{address}", f"'{address}'", "camera:0 or camera:0@1280x960")
    return int(number), (int(sides[0]), int(sides[1])) if at else None
