"""The send buffer of an emulated device, for a listener on this computer that may be slow."""

from collections.abc import Callable

LOOPBACK = "127.0.0.1"
CHUNK = 65536  # bytes, taken at once
FULL = 1 << 20  # bytes, chosen: kept for a listener that is slow; what is older is dropped


class Outbox:
    """Bytes on their way to a listener who may be slow; the oldest go when there are too many."""

    def __init__(self) -> None:
        self.waiting = b""

    def add(self, data: bytes) -> None:
        """Put more behind."""
        self.waiting = (self.waiting + data)[-FULL:]

    def flush(self, write: Callable[[bytes], int]) -> None:
        """Write what waits until it is gone; ``write`` says how much of it went, or raises."""
        while self.waiting:
            self.waiting = self.waiting[write(self.waiting) :]
