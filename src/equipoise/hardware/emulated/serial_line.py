"""A device at the end of a serial line: bytes take their time, there and back.

A byte with its start and stop bit is ten bits; a wire carries one after the other. Each byte
reaches the device at its own time, and what the device says leaves it in the order in which it was
said. A bridge of Wi-Fi or Bluetooth has such a line behind it too.
"""

from collections import deque
from collections.abc import Sequence
from typing import Generic, Protocol, TypeVar

from equipoise.hardware.emulated.device import EmulatedActuator, EmulatedBoard, Given, Leg
from equipoise.model.recording import Recording

Begun = TypeVar("Begun", covariant=True)
Started = TypeVar("Started")
BITS = 10  # of a byte on the wire: start, eight, stop


class SerialLine:
    """One direction of a wire."""

    def __init__(self, baud: int) -> None:
        self._byte = BITS / baud  # s
        self._free = 0.0  # s, when the last byte is through
        self._under_way: deque[tuple[float, bytes]] = deque()

    def put(self, data: bytes, t: float) -> None:
        """Send bytes from t s on."""
        for value in data:
            self._free = max(self._free, t) + self._byte
            self._under_way.append((self._free, bytes([value])))

    def arrived(self, t: float) -> list[tuple[float, bytes]]:
        """Return the bytes that are through at t s, each with its time."""
        found: list[tuple[float, bytes]] = []
        while self._under_way and self._under_way[0][0] <= t:
            found.append(self._under_way.popleft())
        return found


class Device(Protocol[Begun]):
    """What is behind a line: it answers bytes, and begins something by and by."""

    def take(self, data: bytes, t: float) -> bytes:
        """Return what it answers at once."""
        ...

    def run(self, t: float) -> tuple[bytes, Sequence[Begun]]:
        """Let time pass; return what it says meanwhile and what it began."""
        ...


class OnLine(Generic[Started]):
    """A device behind its line."""

    def __init__(self, device: Device[Started], baud: int) -> None:
        self._device = device
        self._there, self._back = SerialLine(baud), SerialLine(baud)

    def take(self, data: bytes, t: float) -> bytes:
        """Put bytes on the line; nothing is answered at once."""
        self._there.put(data, t)
        return b""

    def run(self, t: float) -> tuple[bytes, Sequence[Started]]:
        """Let time pass, byte by byte."""
        begun: list[Started] = []
        for when, byte in self._there.arrived(t):
            self._ran(when, begun)
            self._back.put(self._device.take(byte, when), when)
        self._ran(t, begun)
        return b"".join(byte for _, byte in self._back.arrived(t)), begun

    def _ran(self, t: float, begun: list[Started]) -> None:
        said, new = self._device.run(t)
        self._back.put(said, t)
        begun += new


class BoardOnLine(OnLine[Leg]):
    """A board behind its line; what people do to it reaches the board itself."""

    def __init__(self, board: EmulatedBoard, baud: int) -> None:
        super().__init__(board, baud)
        self.board = board

    @property
    def homing(self) -> bool:
        """Say whether masses are on their way to their switches."""
        return self.board.homing

    def press_reset(self) -> None:
        """Press the button on the board."""
        self.board.press_reset()

    def switch(self, on: bool) -> None:
        """Switch the power."""
        self.board.switch(on)

    def hit_limit(self) -> None:
        """Push a limit switch."""
        self.board.hit_limit()


class ActuatorOnLine(OnLine[Given]):
    """The electronics of wheels, gyros, coils or jets behind their line."""

    def __init__(self, actuator: EmulatedActuator, baud: int) -> None:
        super().__init__(actuator, baud)
        self.actuator = actuator

    def observe(self, rows: Recording, t: float) -> None:
        """Take what the platform's devices did."""
        self.actuator.observe(rows, t)

    def press_reset(self, t: float) -> None:
        """Press the button on it."""
        self.actuator.press_reset(t)

    def switch(self, on: bool, t: float) -> None:
        """Switch the power."""
        self.actuator.switch(on, t)
