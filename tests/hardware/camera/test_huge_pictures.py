"""Pictures that stand for more than any camera gives, and what is no file."""

import os
import struct
import zlib

import pytest

from equipoise.hardware.camera.aruco import decoded
from equipoise.hardware.camera.pictures import picture_at, pictures_of
from equipoise.model.errors import InputError


def png(width: int, height: int) -> bytes:
    """A black picture (PNG, greys of one byte), packed as well as can be."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        whole = kind + data
        return struct.pack(">I", len(data)) + whole + struct.pack(">I", zlib.crc32(whole))

    packer = zlib.compressobj(9)
    rows = [packer.compress(bytes(1 + width)) for _ in range(height)] + [packer.flush()]
    head = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + head + chunk(b"IDAT", b"".join(rows)) + chunk(b"IEND", b"")


def test_a_small_file_of_a_huge_picture_is_refused(tmp_path):
    (tmp_path / "a.png").write_bytes(png(20_000, 20_000))
    assert (tmp_path / "a.png").stat().st_size < 500_000
    with pytest.raises(InputError, match="10000 x 10000 pixels at most"):
        picture_at(tmp_path / "a.png")


def test_a_picture_of_a_camera_is_read():
    assert decoded(png(640, 480)).shape == (480, 640)


def test_a_pipe_is_no_picture_and_no_video(tmp_path):
    os.mkfifo(tmp_path / "a.png")
    with pytest.raises(InputError, match="found no file"):
        picture_at(tmp_path / "a.png")
    with pytest.raises(InputError, match="no such file"):
        next(pictures_of(tmp_path / "a.png", 10.0))
