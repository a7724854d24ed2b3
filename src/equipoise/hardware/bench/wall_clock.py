"""Real time as a bench's clock: seconds since one origin, which UTC knows too, and a short wait.

The origin is taken once, when the clock is made. Whatever stamps a bench's rows in UTC adds the
bench's time to it, so record and live view agree with each other and with the rows' own times.
Bench time never steps: it stays as it is when somebody sets the system's clock meanwhile.
"""

import time

from equipoise.model.units import NS

PAUSE = 1e-3  # s, chosen: between turns; a row waits for half of it on average
READINGS = 9  # chosen: of both clocks; the system seldom interrupts all of them


class WallClock:
    """Real time."""

    def __init__(self) -> None:
        """Begin now: bench time is zero at ``begun_ns``, UTC in ns since 1970."""
        self._zero_ns, self.begun_ns = _both_clocks()

    @property
    def now(self) -> float:
        """Now, s."""
        return (time.monotonic_ns() - self._zero_ns) * NS

    def wait(self) -> None:
        """Let a little time pass."""
        time.sleep(PAUSE)


def _both_clocks() -> tuple[int, int]:
    """Return one moment on the clock that never steps and in UTC, ns.

    UTC is read between two readings of the other clock; the closest two of several count, and their
    middle is the moment.
    """
    readings = [(time.monotonic_ns(), time.time_ns(), time.monotonic_ns()) for _ in range(READINGS)]
    before, utc, after = min(readings, key=lambda each: each[2] - each[0])
    return (before + after) // 2, utc
