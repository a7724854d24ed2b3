"""Requests and replies in TMCL: one request at a time.

A reply does not say which motor it is about. So nothing is asked while an answer is due, and
nothing is asked again: an answer that comes late would be taken for that of the next motor.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from equipoise.hardware.boards.tmcl.words import Request, packed, refusal, replies_in
from equipoise.hardware.transport.attended_time import AttendedTime
from equipoise.hardware.transport.command_queue import Command, CommandQueue
from equipoise.hardware.transport.conversation import Tally
from equipoise.hardware.transport.driver_protocol import SILENCE
from equipoise.model.reading import Counts

CALL = 0.5  # s, attended, chosen: as long as a radio bridge takes there and back
SHOWN = 9  # bytes, chosen: a reply


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
        self.clock = AttendedTime()
        self.queue = CommandQueue[Request](self.clock)
        self.begin()

    def begin(self) -> None:
        """Forget everything: the port has just been opened."""
        self._tally.counts = Counts()
        self.answers: dict[Request, Answer] = {}  # of this script
        self.give_up()
        self._rest = b""
        self._last_reply, self._last_at = "nothing", self.clock.now

    def say(self, script: Iterable[Request]) -> None:
        """Say a script from now on; what was to be said before is not said any more."""
        self.queue.drop()
        self.queue.put(Command(packed(request), request, SILENCE) for request in script)
        self.answers = {}

    def call(self, request: Request, shifted: bool) -> None:
        """Say a request to a module that may be in the middle of a datagram.

        ``shifted``: one byte stands before it, so that another part of it completes what the
        module has. After as many calls as a datagram has bytes, one has met its beginning.
        """
        self.queue.drop()
        data = (b"\0" if shifted else b"") + packed(request)
        self.queue.put([Command(data, request, CALL)])
        self.answers = {}

    def give_up(self) -> None:
        """Await no answer any more, and say nothing."""
        self.queue.clear()

    @property
    def refused(self) -> str:
        """What was refused first, in words; empty if nothing was."""
        found = (refusal(q, a.status) for q, a in self.answers.items() if not a.done)
        return next(found, "")

    @property
    def last_received(self) -> tuple[str, float]:
        """What was heard last, for people, and how long ago, s, attended."""
        return self._last_reply, self.clock.now - self._last_at

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
        if data:
            self._last_reply, self._last_at = f"'{data[-SHOWN:].hex(' ')}'", self.clock.now
        replies, breaks, self._rest = replies_in(self._rest + data)
        self._tally.count(corrupt=breaks)
        for reply in replies:
            pending = self.queue.pending
            if pending is None or reply.command != pending.purpose.command:
                self._tally.count(foreign=1)
                continue
            self._tally.count(good=1)
            done = self.queue.answered()
            if done is not None:
                answer = Answer(reply.status, reply.value, reply.done, self.clock.arrival(t))
                self.answers[done.purpose] = answer

    def due(self) -> bytes:
        """Return the next request once the one before is answered."""
        said = self.queue.following()
        if said:
            self._tally.count(corrupt=bool(self._rest))
            self._rest = b""  # what is left over now belongs to no answer
        return said
