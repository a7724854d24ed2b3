"""Limits of a server that anybody may connect to: how many, how long in silence, how often.

    connections that wait    those that have no request under way; beyond ``WAITING`` the one that
                             has waited longest gives way to a new one: a flood of silent
                             connections shuts nobody out
    connections at all       new ones beyond ``ALL`` are closed at once
    silence                  a connection whose request is not complete after ``SILENCE``, or that
                             sends nothing after an answer, is closed
    how often                a bucket of tokens, refilled at a constant rate

A page that is open uses sockets, which are not among the connections that wait.
"""

import asyncio
import time
from collections.abc import Callable
from functools import partial
from typing import Any

from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol

WAITING = 200  # connections, chosen: a browser has six to one address
SILENCE = 5.0  # s, chosen: a request on a poor network takes less
ALL = 600  # connections and sockets, chosen: a process may have 1024 open files
BACKLOG = 128  # connections that the system keeps until they are accepted, chosen


class Bucket:
    """Tokens for what may be done ``rate`` times a second, and ``burst`` times at once."""

    def __init__(
        self, rate: float, burst: float, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._rate, self._burst, self._clock = rate, burst, clock
        self._left, self._at = burst, clock()

    def take(self) -> bool:
        """Take a token; say whether there was one."""
        now = self._clock()
        self._left = min(self._burst, self._left + self._rate * (now - self._at))
        self._at = now
        if self._left < 1:
            return False
        self._left -= 1
        return True


class Waiting:
    """The connections without a request under way, the oldest first."""

    def __init__(self, most: int = WAITING, silence: float = SILENCE) -> None:
        self._most, self._silence = most, silence
        self._held = dict[asyncio.Transport, asyncio.TimerHandle]()

    def join(self, connection: asyncio.Transport) -> None:
        """Count a connection among those that wait; the oldest gives way where there are many."""
        self.leave(connection)
        loop = asyncio.get_running_loop()
        self._held[connection] = loop.call_later(self._silence, self._end, connection)
        if len(self._held) > self._most:
            self._end(next(iter(self._held)))

    def leave(self, connection: asyncio.Transport) -> None:
        """Count a connection no more."""
        timer = self._held.pop(connection, None)
        if timer is not None:
            timer.cancel()

    def _end(self, connection: asyncio.Transport) -> None:
        self.leave(connection)
        connection.abort()


class LimitedProtocol(HttpToolsProtocol):
    """uvicorn's connection, which is closed where it is silent."""

    def __init__(self, waiting: Waiting, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._waiting = waiting

    def connection_made(self, transport: Any) -> None:
        """Begin to wait for a request."""
        super().connection_made(transport)
        self._waiting.join(transport)
        if len(self.connections) > ALL:
            transport.abort()

    def connection_lost(self, exc: Exception | None) -> None:
        """End."""
        self._waiting.leave(self.transport)
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Receive a part of a request; the connection waits no more once its headers are here."""
        super().data_received(data)
        if self.cycle and not self.cycle.response_complete:
            self._waiting.leave(self.transport)

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        super().on_response_complete()
        if self.cycle.response_complete and not self.transport.is_closing():
            self._waiting.join(self.transport)

    def handle_websocket_upgrade(self) -> None:
        """Become a socket, which the gate counts."""
        self._waiting.leave(self.transport)
        super().handle_websocket_upgrade()


def limited(waiting: Waiting) -> Callable[..., asyncio.Protocol]:
    """Return what makes uvicorn's connections, all with these limits."""
    return partial(LimitedProtocol, waiting)
