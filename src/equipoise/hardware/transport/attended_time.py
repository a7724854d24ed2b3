"""Time in which somebody listened.

A computer that pauses (it is busy, it is suspended, somebody stopped the program) hears nothing
meanwhile and asks nothing. What arrived waits for it. So such a time says nothing about a device:
silence and deadlines are counted on a clock that goes on by at most ``LISTENED`` from turn to turn.
"""

LISTENED = 0.05  # s, chosen: turns are 1 ms apart, and some tens of ms on a busy computer


class AttendedTime:
    """The clock; ``now`` is s since it was made."""

    def __init__(self) -> None:
        self.now = 0.0
        self._turn: float | None = None  # s, bench time of the last turn

    def turn(self, t: float) -> None:
        """Note that somebody listens at bench time t (s)."""
        if self._turn is not None:
            self.now += min(max(t - self._turn, 0.0), LISTENED)
        self._turn = t

    def arrival(self, t: float) -> float:
        """Return when something that is found at t (s) arrived at the latest.

        After a pause it has most likely waited: it came soon after the turn before.
        """
        return t if self._turn is None else min(t, self._turn + LISTENED)
