"""What a halt asks of a Grbl board, report by report, until masses surely stand.

    Jog           cancel again, unless it slows down: a leg was on its way when the first was sent
    Run           hold: a cancel does nothing there
    Hold:0        reset: it stands, and a resumed hold would go on
    Idle          an empty line, once; when that is answered and it is Idle still, masses stand

A cancel that comes while a cancelled jog ends suspends the board: it says Idle and answers no
line. The empty line shows that, and the driver's reset or resumption frees it. Source: Grbl 1.1,
its published state machine (``protocol``, ``jog``).
"""

from enum import Enum

from equipoise.hardware.boards.grbl.report import MachineState, Status


class Wish(Enum):
    """What to do next."""

    WAIT = "wait for the next report"
    CANCEL = "cancel the jog"
    HOLD = "hold"
    RESET = "reset"
    SYNC = "send an empty line"
    STANDS = "masses stand"
    WRONG = "this state has no way out but homing"


class Halting:
    """One halt; ``feed`` is what the board said last before it (mm/min)."""

    def __init__(self, feed: float | None) -> None:
        self._feed, self._synced = feed, False

    def begun_anew(self) -> None:
        """Note that the board was reset: lines of before are void."""
        self._synced = False

    def wish(self, status: Status, quiet: bool) -> Wish:
        """Return what to do after a fresh report; ``quiet``: no line waits for an answer."""
        before, self._feed = self._feed, status.feed
        if status.state is MachineState.JOG:
            return self._anew(Wish.WAIT if slowing(before, status.feed) else Wish.CANCEL)
        if status.state is MachineState.RUN:
            return self._anew(Wish.HOLD)
        if status.state is MachineState.HOLD:
            return self._anew(Wish.WAIT if status.detail == 1 else Wish.RESET)
        if status.state is not MachineState.IDLE:
            return Wish.WRONG
        if not quiet:
            return Wish.WAIT
        synced, self._synced = self._synced, True
        return Wish.STANDS if synced else Wish.SYNC

    def _anew(self, wish: Wish) -> Wish:
        self._synced = False
        return wish


def slowing(before: float | None, now: float | None) -> bool:
    """Say whether a feed has become less, or is none."""
    return now == 0 or (before is not None and now is not None and now < before)
