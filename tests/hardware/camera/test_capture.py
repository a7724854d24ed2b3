"""A camera of this computer: one picture at a time, the newest, from a thread of its own."""

import threading
import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

cv2 = pytest.importorskip("cv2", reason="the extra 'camera' is not installed")

from equipoise.hardware.bench.open_port import open_port  # noqa: E402
from equipoise.hardware.camera.capture import CapturePort, camera_at  # noqa: E402
from equipoise.hardware.camera.raw_picture import RawPicture, packed, unpacked  # noqa: E402
from equipoise.hardware.transport.port import PortLost  # noqa: E402
from equipoise.model.errors import InputError  # noqa: E402
from equipoise.model.hardware import Port  # noqa: E402

FRAMES = 8


@pytest.fixture
def video(tmp_path):
    """Return a video whose pictures get brighter one by one; a file stands in for a camera."""
    path = tmp_path / "run.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (64, 48))
    for k in range(FRAMES):
        writer.write(np.full((48, 64, 3), 20 * k, np.uint8))
    writer.release()
    return str(path)


def until_lost(port, pause):
    """Return the pictures that came before the camera ended, and why it did."""
    found, end = [], time.monotonic() + 10.0
    while time.monotonic() < end:
        try:
            found += [unpacked(data) for data in port.receive()]
        except PortLost as lost:
            return found, str(lost)
        time.sleep(pause)
    raise AssertionError("it never ends")


def test_only_the_newest_picture_waits(video):
    """Nobody reads until the video is over: one picture is left, numbered by their count."""
    port = CapturePort("camera:0", video, None)
    port._thread.join(10.0)
    found, why = until_lost(port, 0.0)
    port.close()
    (last,) = found
    assert last.number == FRAMES - 1
    assert last.grey.shape == (48, 64)
    assert abs(float(last.grey.mean()) - 20 * (FRAMES - 1)) < 3
    assert "no more pictures" in why


def test_receiving_does_not_wait_for_a_camera_that_is_slow_to_open(monkeypatch):
    ready = threading.Event()

    class Slow:
        def __init__(self, source):
            ready.wait(60.0)

        def isOpened(self):
            return False

        def release(self):
            pass

    monkeypatch.setattr(cv2, "VideoCapture", Slow)
    port = open_port(Port("camera:0"))
    assert port.receive() == []
    ready.set()
    assert until_lost(port, 0.01)[0] == []
    port.close()


def test_a_missing_camera_is_reported():
    port = open_port(Port("camera:97"))
    found, why = until_lost(port, 0.01)
    port.send(b"anything")
    port.close()
    assert found == []
    assert "it does not open" in why


def test_addresses():
    assert camera_at("2") == (2, None)
    assert camera_at("0@1280x960") == (0, (1280, 960))
    for wrong in ("x", "0@", "0@1280", "0@1280x"):
        with pytest.raises(InputError, match="camera:0@1280x960"):
            camera_at(wrong)


def test_a_picture_as_bytes_and_back():
    grey = np.arange(12, dtype=np.uint8).reshape(3, 4)
    data = packed(RawPicture(grey, 7, 1.25))
    assert data == b"P5\n# 7 1.250000\n4 3\n255\n" + bytes(range(12))
    back = unpacked(data)
    assert (back.number, back.t) == (7, 1.25)
    np.testing.assert_array_equal(back.grey, grey)
    assert unpacked(data[:-1]) is None
    assert unpacked(data.replace(b"4 3", b"0 0")) is None


@given(st.binary(max_size=80))
def test_no_bytes_raise(data):
    assert unpacked(data) is None
    unpacked(b"P5\n# 1 1.000000\n" + data)
