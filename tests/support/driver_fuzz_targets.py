"""Drivers as fuzz targets: each receives any bytes, at any point of a conversation."""

import contextlib
import functools
from collections.abc import Callable

import numpy as np

from equipoise.hardware.actuators.registry import ACTUATORS
from equipoise.hardware.boards.registry import BOARDS
from equipoise.hardware.camera.raw_picture import RawPicture, packed, unpacked
from equipoise.hardware.emulated.registry import SENSORS
from equipoise.hardware.sensors.registry import DRIVERS
from equipoise.hardware.transport.driver_protocol import Phase
from equipoise.hardware.transport.mjpeg_stream import Parts
from equipoise.model.errors import BenchStopped
from equipoise.model.recording import Recording, Samples
from equipoise.model.units import MM
from tests.support.actuator_wire import BED as DRIVEN
from tests.support.actuator_wire import ActuatorWire, unit_of
from tests.support.board_wire import BED, Wire, board_of
from tests.support.fuzz_target import Target
from tests.support.sensor_units import PICTURES, unit

LUMP, TURN = 48, 0.02  # bytes that arrive in a turn; s
SHARE_OF_PICTURES = 0.01  # drawing and reading one takes a hundred times as long as a line


def received(name: str) -> Callable[[bytes], None]:
    """Return what a driver of a sensor does with bytes, at once and in two halves."""

    def take(content: bytes) -> None:
        driver = DRIVERS[name](unit(name))
        for half in (content, content[: len(content) // 2], content[len(content) // 2 :]):
            for reading in driver.feed(half):
                assert len(reading.values) == {"attitude": 4, "rate": 3}[reading.channel]
                assert np.all(np.isfinite(reading.values))
        driver.due(1.0)
        driver.feed(b"\n")
        driver.opened()
        driver.due(2.0)

    return take


def reported(name: str) -> bytes:
    """Return three rows of each channel as a sensor's emulated counterpart sends them."""
    t = np.arange(3) * 0.025
    q = np.stack([np.cos(t), np.sin(t), 0 * t, 0 * t], axis=1)
    rows = Recording(Samples(t, q), Samples(t, np.stack([t, 1 - t, t / 7], axis=1)))
    remote, driver = SENSORS[name](unit(name)), DRIVERS[name](unit(name))
    driver.opened()
    remote.take(driver.due(0.0), 0.0)
    return b"".join(remote.messages(rows))


class Listened(Wire):
    """A wire that keeps what the board has said."""

    def __init__(self, kind: str) -> None:
        self.said = b""
        super().__init__(kind)
        feed = self.driver.feed

        def kept(data: bytes, t: float) -> None:
            self.said += data
            feed(data, t)

        self.driver.feed = kept


def conversation(kind: str) -> bytes:
    """Return all that a board says from its start through homing and two moves."""
    wire = Listened(kind).at_home()
    wire.driver.go({"x": 2 * MM, "y": -1 * MM}, wire.t)
    wire.run(0.2)
    wire.driver.halt(wire.t)
    wire.run(0.3)
    wire.driver.go({"x": 0.0}, wire.t)
    wire.run(0.6)
    return wire.said[:2000] + wire.said[-1000:]


def made(make: Callable[[str], bytes], name: str) -> Callable[[], bytes]:
    """Return what makes valid bytes, once."""
    return functools.cache(functools.partial(make, name))


def answered(kind: str) -> Callable[[bytes], None]:
    """Return what a board's driver does with bytes, while it is commanded to home, go and halt."""

    def take(content: bytes) -> None:
        driver = BOARDS[kind](board_of(kind), BED.masses)
        driver.opened(0.0)
        orders = {8: "home", 30: "go", 40: "halt", 50: "go"}
        for k in range(len(content) // LUMP + 1):
            t = k * TURN
            driver.feed(content[LUMP * k : LUMP * k + LUMP], t)
            with contextlib.suppress(BenchStopped):
                words = ({"x": 2 * MM}, t) if orders.get(k) == "go" else (t,)
                getattr(driver, orders.get(k, "due"))(*words)
            driver.due(t)
            assert driver.state.phase in Phase
            assert np.all(np.isfinite(list(driver.state.position.values())))

    return take


def driven(kind: str) -> bytes:
    """Return all that electronics say from their start through a drive and a halt."""
    wire, said = ActuatorWire(kind), b""
    feed = wire.driver.feed

    def kept(data: bytes, t: float) -> object:
        nonlocal said
        said += data
        return feed(data, t)

    wire.driver.feed = kept
    wire.working({"rw_x": 0.001, "jp_z": 0.002})
    wire.driver.rest(wire.t)
    wire.run(0.2)
    return said


def commanded(kind: str) -> Callable[[bytes], None]:
    """Return what a driver of devices does with bytes, while it is driven and halted."""

    def take(content: bytes) -> None:
        driver = ACTUATORS[kind](unit_of(kind), DRIVEN.devices)
        driver.opened(0.0)
        orders = {8: "drive", 20: "rest", 26: "drive", 40: "begin"}
        for k in range(len(content) // LUMP + 1):
            t = k * TURN
            for counted in driver.feed(content[LUMP * k : LUMP * k + LUMP], t):
                assert np.all(np.isfinite(list(counted.values.values())))
            with contextlib.suppress(BenchStopped):
                words = ({"rw_x": 0.001}, t) if orders.get(k) == "drive" else (t,)
                getattr(driver, orders.get(k, "due"))(*words)
            driver.due(t)

    return take


def cut_separation(content: bytes) -> None:
    """A stream of pictures as a server sends it."""
    parts = Parts()
    for k in range(0, len(content), LUMP):
        for part in parts.cut(content[k : k + LUMP]):
            assert len(part.body) <= len(content)


def stream() -> bytes:
    """Return a stream of three small parts, one of them in chunks."""
    head = b"HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=frame\r\n"
    part = b"--frame\r\nContent-Type: image/jpeg\r\nX-Timestamp: 1.5\r\nContent-Length: 20\r\n\r\n"
    body = part + b"\xff\xd8" + bytes(16) + b"\xff\xd9\r\n"
    chunk = f"{len(body):x}\r\n".encode() + body + b"\r\n"
    return head + b"Transfer-Encoding: chunked\r\n\r\n" + 3 * chunk


def picture() -> bytes:
    """Return a picture of four by three greys."""
    return packed(RawPicture(np.arange(12, dtype=np.uint8).reshape(3, 4), 7, 1.25))


def pictured(content: bytes) -> None:
    """A datagram of a camera of this computer."""
    found = unpacked(content)
    assert found is None or found.grey.size


TARGETS = (
    *(
        Target(
            f"driver {name}",
            made(reported, name),
            received(name),
            SHARE_OF_PICTURES if name in PICTURES else 1.0,
        )
        for name in DRIVERS
    ),
    *(Target(f"driver {kind}", made(conversation, kind), answered(kind)) for kind in BOARDS),
    *(Target(f"driver {kind}", made(driven, kind), commanded(kind)) for kind in ACTUATORS),
    Target("stream of pictures", stream, cut_separation),
    Target("raw picture", picture, pictured),
)
