"""Messages of the runner: kept for pages that connect later, passed on to those connected.

Rows are kept up to a number of bytes, the oldest go first. Steps, the view and the state are kept
whole. A page that does not keep up is disconnected: it connects again and gets all that is kept.
"""

import asyncio
import json
from collections import deque
from typing import Any

MOST = 12_000_000  # bytes of rows, chosen: about five minutes at 100 Hz
BEHIND = 300  # messages, chosen: twenty seconds of them
Message = bytes | str
GONE = ""  # sent to a page that is disconnected


class Watch:
    """See above; all of it in the server's own thread."""

    def __init__(self) -> None:
        self.about: dict[str, Any] = {}
        self.state: dict[str, Any] = {}
        self.steps: dict[int, dict[str, Any]] = {}
        self.ended = ""  # why the runner has ended
        self._rows: deque[bytes] = deque()
        self._bytes = 0
        self._pages: set[asyncio.Queue[Message]] = set()

    def take(self, kind: str, what: Any) -> None:
        """Take a message of the runner."""
        match kind:
            case "rows":
                self._keep(what)
                self._hand_on(what)
                return
            case "about":
                self.about, self.steps = what, {}
                self._rows, self._bytes = deque(), 0
            case "step":
                self.steps[what["index"]] = what
            case "failed":
                self.end(what)
                return
            case _:
                self.state = what
        self._hand_on(json.dumps(what))

    def end(self, why: str) -> None:
        """Note that the runner has ended, and inform the pages; the first reason stays."""
        self.ended = self.ended or why
        known = {**self.state, "kind": "state", "recording": None}  # nobody writes it any more
        self.take("state", {**known, "phase": "stopped", "note": self.ended})

    def join(self) -> "asyncio.Queue[Message]":
        """Return what a page gets: all that is kept, then what comes."""
        page: asyncio.Queue[Message] = asyncio.Queue()
        first = [self.about, *self.steps.values(), self.state]
        for message in [*(json.dumps(each) for each in first if each), *self._rows]:
            page.put_nowait(message)
        self._pages.add(page)
        return page

    def leave(self, page: "asyncio.Queue[Message]") -> None:
        """Forget a page."""
        self._pages.discard(page)

    def _keep(self, rows: bytes) -> None:
        self._rows.append(rows)
        self._bytes += len(rows)
        while self._bytes > MOST:
            self._bytes -= len(self._rows.popleft())

    def _hand_on(self, message: Message) -> None:
        for page in list(self._pages):
            if page.qsize() > BEHIND + len(self._rows):
                self.leave(page)
                page.put_nowait(GONE)
            else:
                page.put_nowait(message)
