"""Requests and replies in TMCL: one request at a time.

A reply does not say which motor it is about. So nothing is asked while an answer is due, and
nothing is asked again: an answer that comes late would be taken for that of the next motor.
"""

from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass

from equipoise.hardware.boards.tmcl_words import Request, packed, refusal, replies_in
from equipoise.hardware.transport.conversation import Tally
from equipoise.hardware.transport.driver_protocol import SILENCE
from equipoise.model.reading import Counts


@dataclass(frozen=True, slots=True)
class Answer:
    """A reply and when it came."""

    status: int
    value: int
    done: bool
    t: float  # s


class Talk:
    """Says one script of requests after the other; ``tally`` counts the replies."""

    def __init__(self, tally: Tally) -> None:
        self._tally = tally
        self.begin()

    def begin(self) -> None:
        """Forget everything: the port has just been opened."""
        self._tally.counts = Counts()
        self.answers: dict[Request, Answer] = {}  # of this script
        self._script: deque[Request] = deque()
        self._pending: Request | None = None
        self._requested = 0.0  # s
        self._void = False  # what is pending is of an earlier script
        self._rest = b""

    def say(self, script: Iterable[Request]) -> None:
        """Say a script from now on; what was to be said before is not said any more."""
        self._script = deque(script)
        self.answers = {}
        self._void = self._pending is not None

    def give_up(self) -> None:
        """Await no answer any more, and say nothing."""
        self._script.clear()
        self._pending = None

    @property
    def over(self) -> bool:
        """Say whether all was said and answered."""
        return self._pending is None and not self._script

    def silent(self, t: float) -> bool:
        """Say whether an answer is overdue."""
        return self._pending is not None and t - self._requested > SILENCE

    @property
    def refused(self) -> str:
        """What was refused first, in words; empty if nothing was."""
        found = (refusal(q, a.status) for q, a in self.answers.items() if not a.done)
        return next(found, "")

    def value(self, request: Request) -> int | None:
        """Return what was answered to a request of this script; None: nothing, or a refusal."""
        answer = self.answers.get(request)
        return answer.value if answer is not None and answer.done else None

    def middle(self, command: int, type_: int, t: float) -> float:
        """Return the middle of the times at which these were answered; ``t`` if none was."""
        same = (a.t for q, a in self.answers.items() if (q.command, q.type) == (command, type_))
        when = list(same) or [t]
        return (when[0] + when[-1]) / 2

    def feed(self, data: bytes, t: float) -> None:
        """Take in what has arrived."""
        replies, breaks, self._rest = replies_in(self._rest + data)
        self._tally.count(corrupt=breaks)
        for reply in replies:
            pending = self._pending
            if pending is None or reply.command != pending.command:
                self._tally.count(foreign=1)
                continue
            self._tally.count(good=1)
            self._pending = None
            if not self._void:
                self.answers[pending] = Answer(reply.status, reply.value, reply.done, t)
            self._void = False

    def due(self, t: float) -> bytes:
        """Return the next request once the one before is answered."""
        if self._pending is not None or not self._script:
            return b""
        self._tally.count(corrupt=bool(self._rest))
        self._rest = b""  # what is left over now belongs to no answer
        self._pending, self._requested, self._void = self._script.popleft(), t, False
        return packed(self._pending)
