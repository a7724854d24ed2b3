"""How much is unpacked of a file, or tried in vain, whether it stays in memory or not."""

from equipoise.io.files.reading_budget import RATIO, Meter, in_mb


class Work:
    """Counts bytes; InputError once they are more than any recording of that size unpacks to."""

    def __init__(self, meter: Meter, size: int) -> None:
        self.meter, self._size = meter, size
        self._most, self._done = max(RATIO * size, meter.left), 0

    def add(self, count: int) -> None:
        """Count bytes that are about to be unpacked or tried."""
        self._done += count
        if self._done > self._most:
            most = in_mb(self._most)
            raise self.meter.refused(f"more than {most} unpacked, or tried in vain")
