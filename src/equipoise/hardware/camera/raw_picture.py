"""A picture in greys as bytes, with its number and time: a PGM file (P5) with one comment.

P5 / # NUMBER SECONDS / WIDTH HEIGHT / 255 / width x height bytes
"""

import re
from dataclasses import dataclass

import numpy as np

from equipoise.hardware.camera.aruco import Picture

HEAD = re.compile(rb"P5\n# (\d{1,18}) (\d{1,12}\.\d{6})\n(\d{1,5}) (\d{1,5})\n255\n")


@dataclass(frozen=True, slots=True, eq=False)
class RawPicture:
    """One picture of a camera."""

    grey: Picture
    number: int  # as the camera counts them
    t: float  # s, when it was taken, on the camera's clock


def packed(picture: RawPicture) -> bytes:
    """Return a picture as bytes."""
    height, width = picture.grey.shape
    head = f"P5\n# {picture.number} {picture.t:.6f}\n{width} {height}\n255\n"
    return head.encode() + picture.grey.tobytes()


def unpacked(data: bytes) -> RawPicture | None:
    """Return the picture of bytes; None if they are none."""
    head = HEAD.match(data)
    if head is None:
        return None
    width, height = int(head[3]), int(head[4])
    if width * height == 0 or len(data) - head.end() != width * height:
        return None
    grey = np.frombuffer(data, np.uint8, offset=head.end()).reshape(height, width)
    return RawPicture(grey, int(head[1]), float(head[2]))
