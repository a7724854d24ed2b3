"""A line between a board and its driver that does what lines do, in either direction.

Bytes keep their order. They are split anywhere, and come as late as they like; now and then nothing
comes for a while, and then all of it.
"""

from collections import deque

import numpy as np


class NastyLine:
    """One direction."""

    def __init__(self, rng, latency=0.25, stall=0.4, stalls=0.002):
        self._rng, self._latency, self._stall, self._stalls = rng, latency, stall, stalls
        self._under_way, self._free = deque(), 0.0

    def put(self, data, t):
        """Send bytes, in pieces."""
        cuts = np.flatnonzero(self._rng.random(max(len(data) - 1, 0)) < 0.1) + 1
        for piece in np.split(np.frombuffer(data, np.uint8), cuts):
            late = self._rng.random() * self._latency
            if self._rng.random() < self._stalls:
                late += self._rng.random() * self._stall
            self._free = max(self._free, t + late)
            self._under_way.append((self._free, piece.tobytes()))

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
