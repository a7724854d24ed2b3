"""The send buffer of an emulated device, for a listener on this computer that may be slow."""

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

    def sent(self, count: int) -> None:
        """Take away what is gone."""
        self.waiting = self.waiting[count:]
