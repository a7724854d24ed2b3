"""What goes back and forth with a Grbl board: one line under way, one question, a reset.

    line    ok or error:n answers the one under way
    ?       asked again and again; a report answers the oldest question that is open
    0x18    the board restarts; until it says so, nothing that it says answers a line

A report is as fresh as its question: what a line did is seen only in a report that was asked for
after the line was answered. A report is taken for that of the oldest question that is open, and
where none is, to be as old as the one before: it may be newer than that, and is never older. A
question may be lost on the way; after ``VOID`` it is open no more.
"""

from collections import deque
from collections.abc import Iterator
from enum import StrEnum

from equipoise.hardware.boards.grbl.report import Code, Greeting, Report, Status, Word, parsed
from equipoise.hardware.transport.attended_time import AttendedTime
from equipoise.hardware.transport.command_queue import CommandQueue
from equipoise.hardware.transport.conversation import Tally
from equipoise.hardware.transport.line_splitter import Lines
from equipoise.model.reading import Counts

RESET, HOLD, RESUME, CANCEL, QUERY = b"\x18", b"!", b"~", b"\x85", b"?"
BEGIN = 4.0  # s, attended, chosen: an Arduino's loader takes two of them after the port is opened
TRY = 1.5  # s, attended, chosen: between resets while it has not begun
UNGREETED = 1.0  # s, chosen: who reports a state so long after a reset has begun
AGAIN = 0.25  # s, attended, chosen: a question that is open for so long is asked again
VOID = 1.0  # s, attended, chosen: longer than a report takes there and back by radio
SHOWN = 60  # characters, chosen: of what was heard last


class Step(StrEnum):
    """What a line is for, as a person would say it."""

    SETTINGS = "its settings ($$)"
    HOME = "homing ($H)"
    HOMED = "an empty line after homing"
    UNLOCK = "unlocking ($X)"
    LEG = "a jog ($J)"
    SYNC = "an empty line"


HOMING = (Step.HOME, Step.HOMED)


class GrblTalk:
    """See above; ``tally`` counts what arrives."""

    def __init__(self, tally: Tally) -> None:
        self._tally, self._lines = tally, Lines()
        self.clock = AttendedTime()
        self.queue = CommandQueue[Step](self.clock)
        self.begin()

    def begin(self) -> None:
        """Reset the board: its port has just been opened, what was before is void."""
        self._lines.cleared()
        self._tally.counts = Counts()
        self.queue.drop()
        self.status: Status | None = None  # the last
        self.queried = self.arrived = float("-inf")  # s, bench time, of the last status
        self._queried_at = float("-inf")  # s, attended, of the last status
        self.line_sent = float("-inf")  # s, bench time, of the last line
        self._last_query = float("-inf")  # s, attended
        self._unreported = False  # nothing was reported since it was asked last
        self._last_line, self._line_at = b"", self.clock.now
        self.expected = True  # the last greeting was awaited
        self.reset()

    def reset(self) -> None:
        """Let the board restart; lines wait until it has."""
        self._urgent = RESET
        self.queue.cut()
        self.awaiting = True
        self._reset_at = self._tried = self.clock.now
        self._open: deque[tuple[float, float]] = deque()  # questions: s of bench, s attended
        self._quiet_since = self.clock.now

    def urge(self, byte: bytes) -> None:
        """Send a byte that acts at once, and a question behind it."""
        self._urgent += byte
        self._last_query = float("-inf")

    def void_queries(self) -> None:
        """Forget open questions: the board has not listened so far."""
        self._open.clear()

    def reports(self, data: bytes, t: float) -> Iterator[Report]:
        """Return what matters of what has arrived, one report after the other."""
        if data:
            self._line_at = self.clock.now
        for line in self._lines.cut(data):
            self._last_line = line
            report = parsed(line)
            self._tally.count(good=report is not None, corrupt=report is None)
            if report is not None:
                yield from self._mattering(report, t)

    def due(self, t: float, pause: float) -> bytes:
        """Return what to send; questions are ``pause`` apart, s."""
        said, self._urgent = self._urgent, b""
        if 0 < self.reset_waited <= BEGIN and self.clock.now - self._tried > TRY:
            self._tried = self.clock.now
            said += RESET
        said += self._question(t, pause)
        line = b"" if self.awaiting else self.queue.following()
        self.line_sent = t if line else self.line_sent
        return said + line

    @property
    def reset_waited(self) -> float:
        """How long the board has been awaited after a reset, s, attended."""
        return self.clock.now - self._reset_at if self.awaiting else 0.0

    @property
    def question_waited(self) -> float:
        """How long no report has come though one was asked for, s, attended."""
        return self.clock.now - self._quiet_since if self._open else 0.0

    @property
    def homing(self) -> bool:
        """Say whether a line of homing is under way: the board may answer nothing else then."""
        return self.queue.pending is not None and self.queue.pending.purpose in HOMING

    @property
    def reported_since_due(self) -> bool:
        """Say whether the board was asked, and reported, after an answer was due: it is there."""
        pending = self.queue.pending
        if pending is None:
            return False
        return self._queried_at > self.clock.now - self.queue.waited + pending.patience

    @property
    def last_received(self) -> tuple[str | None, float]:
        """What was heard last, for people, None: nothing; and how long ago, s, attended."""
        line = self._last_line or self._lines.rest
        text = f"'{line.decode('ascii', 'backslashreplace')[:SHOWN]}'" if line else None
        return text, self.clock.now - self._line_at

    def _question(self, t: float, pause: float) -> bytes:
        now = self.clock.now
        while len(self._open) > 1 and now - self._open[0][1] > VOID:
            self._open.popleft()
        if now - self._last_query < (AGAIN if self._unreported else pause) - 1e-9:
            return b""
        self._last_query = now
        if not self._open:
            self._quiet_since = now
        self._open.append((t, now))
        self._unreported = True
        return QUERY

    def _mattering(self, report: Report, t: float) -> Iterator[Report]:
        """Pass on what is no answer of before a reset; a state long after one is a greeting."""
        if isinstance(report, Greeting):
            self.expected, self.awaiting = self.awaiting, False
            self._open.clear()
        elif self.awaiting and isinstance(report, Status):
            if not self._open or self._open[0][1] - self._reset_at < UNGREETED:
                return
            self.expected, self.awaiting = True, False
            yield Greeting("no greeting", old=False)
        elif self.awaiting and not (isinstance(report, Code) and report.alarm):
            return
        if isinstance(report, Status):
            self._reported(report, t)
        if report is not Word.REMARK:
            yield report

    def _reported(self, status: Status, t: float) -> None:
        if self._open:
            self.queried, self._queried_at = self._open.popleft()
        else:
            self.queried = self.arrived
        self._quiet_since, self._unreported = self.clock.now, False
        self.status, self.arrived = status, self.clock.arrival(t)
