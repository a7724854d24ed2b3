"""Commands to a board, one under way at a time, each with its own answer and deadline.

The next command goes out when the answer of the one before has come. So no answer is ever credited
to another command: what is dropped while it is under way stays under way, and its answer is void.
Deadlines are on attended time.
"""

from collections import deque
from collections.abc import Hashable, Iterable
from dataclasses import dataclass
from typing import Generic, TypeVar

from equipoise.hardware.transport.attended_time import AttendedTime

Purpose = TypeVar("Purpose", bound=Hashable)


@dataclass(frozen=True, slots=True)
class Command(Generic[Purpose]):
    """Something that a board is to answer."""

    data: bytes
    purpose: Purpose  # what it is for, known to the driver
    patience: float  # s, attended, until its answer


class CommandQueue(Generic[Purpose]):
    """What waits to be sent, and what is under way."""

    def __init__(self, clock: AttendedTime) -> None:
        self._clock = clock
        self._waiting: deque[Command[Purpose]] = deque()
        self.pending: Command[Purpose] | None = None
        self._void, self._since = False, 0.0

    def put(self, commands: Iterable[Command[Purpose]]) -> None:
        """Say these after what waits already."""
        self._waiting.extend(commands)

    def drop(self) -> None:
        """Say nothing of what waits; the answer of what is under way is void when it comes."""
        self._waiting.clear()
        self._void = self.pending is not None

    def cut(self) -> None:
        """Await no answer any more: the device was reset, or has not answered in time."""
        self.pending = None

    def clear(self) -> None:
        """Say nothing and await nothing any more."""
        self.drop()
        self.cut()

    def following(self) -> bytes:
        """Return the next command to send; nothing while an answer is due."""
        if self.pending is not None or not self._waiting:
            return b""
        self.pending, self._void = self._waiting.popleft(), False
        self._since = self._clock.now
        return self.pending.data

    def answered(self) -> Command[Purpose] | None:
        """Note that an answer has come; return its command, None if it is void or of none."""
        done, self.pending = self.pending, None
        return None if self._void else done

    @property
    def over(self) -> bool:
        """Say whether all was said and answered."""
        return self.pending is None and not self._waiting

    @property
    def waited(self) -> float:
        """How long the answer has been awaited, s, attended."""
        return 0.0 if self.pending is None else self._clock.now - self._since

    @property
    def overdue(self) -> bool:
        """Say whether an answer is overdue."""
        return self.pending is not None and self.waited > self.pending.patience
