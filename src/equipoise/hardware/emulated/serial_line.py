"""A board at the end of a serial line: bytes take their time, there and back.

A byte with its start and stop bit is ten bits; a wire carries one after the other. Each byte
reaches the board at its own time, and what the board says leaves it in the order in which it was
said. A bridge of Wi-Fi or Bluetooth has such a line behind it too.
"""

from collections import deque
from collections.abc import Sequence

from equipoise.hardware.emulated.device import EmulatedBoard, Leg

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


class BoardOnLine:
    """A board behind its line; what people do to it reaches the board itself."""

    def __init__(self, board: EmulatedBoard, baud: int) -> None:
        self.board = board
        self._there, self._back = SerialLine(baud), SerialLine(baud)

    @property
    def homing(self) -> bool:
        """Say whether masses are on their way to their switches."""
        return self.board.homing

    def take(self, data: bytes, t: float) -> bytes:
        """Put bytes on the line; nothing is answered at once."""
        self._there.put(data, t)
        return b""

    def run(self, t: float) -> tuple[bytes, Sequence[Leg]]:
        """Let time pass, byte by byte."""
        legs: list[Leg] = []
        for when, byte in self._there.arrived(t):
            self._ran(when, legs)
            self._back.put(self.board.take(byte, when), when)
        self._ran(t, legs)
        return b"".join(byte for _, byte in self._back.arrived(t)), legs

    def press_reset(self) -> None:
        """Press the button on the board."""
        self.board.press_reset()

    def switch(self, on: bool) -> None:
        """Switch the power."""
        self.board.switch(on)

    def hit_limit(self) -> None:
        """Push a limit switch."""
        self.board.hit_limit()

    def _ran(self, t: float, legs: list[Leg]) -> None:
        said, begun = self.board.run(t)
        self._back.put(said, t)
        legs += begun
