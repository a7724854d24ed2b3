"""Real time as a bench's clock: seconds since its creation, and a short wait."""

import time

PAUSE = 1e-3  # s, chosen: between turns; a row waits for half of it on average


class WallClock:
    """Real time."""

    def __init__(self) -> None:
        self._zero = time.monotonic()

    @property
    def now(self) -> float:
        """Now, s."""
        return time.monotonic() - self._zero

    def wait(self) -> None:
        """Let a little time pass."""
        time.sleep(PAUSE)
