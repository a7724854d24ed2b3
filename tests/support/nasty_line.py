"""A line between a board and its driver that does what lines do, in either direction.

Bytes keep their order. They are split anywhere, and come as late as they like; now and then nothing
comes for a while, and then all of it. Where lines are the messages, one comes twice now and then,
the second time behind others.
"""

from collections import deque

import numpy as np


class NastyLine:
    """One direction."""

    def __init__(self, rng, latency=0.25, stall=0.4, stalls=0.002, twice=0.0):
        """Take how late bytes are (s), how long and how often none come, how often a line twice."""
        self._rng, self._latency, self._stall, self._stalls = rng, latency, stall, stalls
        self._twice, self._lines, self._again = twice, b"", deque()
        self._under_way, self._free = deque(), 0.0

    def put(self, data, t):
        """Send bytes, in pieces."""
        data = self._repeated(data)
        cuts = np.flatnonzero(self._rng.random(max(len(data) - 1, 0)) < 0.1) + 1
        for piece in np.split(np.frombuffer(data, np.uint8), cuts):
            late = self._rng.random() * self._latency
            if self._rng.random() < self._stalls:
                late += self._rng.random() * self._stall
            self._free = max(self._free, t + late)
            self._under_way.append((self._free, piece.tobytes()))

    def _repeated(self, data):
        """Put lines of before behind those that are complete now."""
        *whole, self._lines = (self._lines + data).split(b"\n")
        for line in whole:
            if self._again and self._rng.random() < 0.3:
                data += b"" if self._lines else self._again.popleft() + b"\n"
            if self._rng.random() < self._twice:
                self._again.append(line)
        return data

    def arrived(self, t):
        """Return what has come."""
        found = b""
        while self._under_way and self._under_way[0][0] <= t:
            found += self._under_way.popleft()[1]
        return found

    def cleared(self):
        """Lose what is under way, as when it is unplugged."""
        self._under_way.clear()


class PlainLine(NastyLine):
    """One that is as good as the loopback."""

    def put(self, data, t):
        """Send bytes; they are there at once."""
        if data:
            self._under_way.append((t, data))
