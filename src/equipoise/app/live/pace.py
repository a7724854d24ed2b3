"""How fast a simulated bench or a replay goes."""

import time

LAGGING = 0.5  # s, chosen: what is later than this is not made up for


class Pace:
    """Bench time held to the clock on the wall, times a speed; 0: as fast as possible."""

    def __init__(self, speed: float = 1.0, lagging: float = LAGGING) -> None:
        self._speed, self._lagging = speed, lagging
        self._due = time.monotonic()

    @property
    def speed(self) -> float:
        """Seconds of the bench in one."""
        return self._speed

    def at(self, speed: float) -> None:
        """Go on at another speed."""
        self._speed, self._due = speed, time.monotonic()

    def wait(self, passed: float) -> float:
        """Return how long to wait (s) after so much bench time (s); what is late is forgotten."""
        if not self._speed:
            return 0.0
        now = time.monotonic()
        self._due = max(self._due, now - self._lagging) + passed / self._speed
        return max(self._due - now, 0.0)
