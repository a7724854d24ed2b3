"""A port that tells somebody of every byte that goes through it."""

from collections.abc import Callable

from equipoise.hardware.transport.port import Port

Tap = Callable[[bool, bytes], None]  # whether it is sent, and what


class TappedPort:
    """See ``transport.port.Port``."""

    def __init__(self, port: Port, tap: Tap) -> None:
        self._port, self._tap = port, tap

    def receive(self) -> list[bytes]:
        """Return what has arrived."""
        found = self._port.receive()
        for data in found:
            self._tap(False, data)
        return found

    def send(self, data: bytes) -> None:
        """Send all of it; to tell of it comes after, since it may be a halt."""
        self._port.send(data)
        self._tap(True, data)

    def close(self) -> None:
        """Close it."""
        self._port.close()
