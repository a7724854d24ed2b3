"""Requests of pages, past the guard, to the runner."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from equipoise.app.dashboard.protocol.requests import Request
from equipoise.app.dashboard.server.authorisation import Guard
from equipoise.app.dashboard.server.broadcast import Watch
from equipoise.model.testbed import Testbed

OBSERVER = "This page only observes. Enter the token to command."


@dataclass(frozen=True, slots=True)
class Counter:
    """What all pages share."""

    testbed: Testbed
    folder: Path  # of runs and recordings
    laws: tuple[str, ...]
    methods: tuple[str, ...]
    watch: Watch
    guard: Guard
    send: Callable[[Request], None]  # to the runner

    def request(self, page: str, request: Request) -> str:
        """Hand a request of a page to the runner; return why not, or nothing."""
        if not self.guard.commands(page):
            return OBSERVER
        if self.watch.ended:
            return self.watch.ended
        self.send(request)
        return ""
