"""Requests of pages, past the guard and the schema, to the runner."""

from collections.abc import Callable, Collection
from dataclasses import dataclass
from pathlib import Path

from equipoise.app.dashboard.protocol.data_folder import recordings
from equipoise.app.dashboard.protocol.requests import (
    Balance,
    Identify,
    Jog,
    Replay,
    Request,
    shown,
    sound,
)
from equipoise.app.dashboard.server.authorisation import Guard
from equipoise.app.dashboard.server.broadcast import Watch
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed

OBSERVER = "This page only observes. Enter the token to command."
AUTO = "auto"  # the method that the recording chooses


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
        """Hand a request of a page to the runner; return why not, or nothing.

        A page can send anything in place of a request's values: what does not keep to the schema
        is refused here, in a sentence, and does not get to the runner.
        """
        if not self.guard.commands(page):
            return OBSERVER
        if self.watch.ended:
            return self.watch.ended
        try:
            checked = sound(request)
            self._known(checked)
        except InputError as error:
            return str(error)
        self.send(checked)
        return ""

    def _known(self, request: Request) -> None:
        """Raise InputError for a name that this platform or folder does not have."""
        match request:
            case Balance(law=law):
                _one_of("law", law, self.laws)
            case Identify(method=method):
                _one_of("method", method, (AUTO, *self.methods))
            case Jog(mass=mass):
                _one_of("mass", mass, self.testbed.mass_names)
            case Replay(name=name) if name:
                _one_of("recording", name, recordings(self.folder))
            case _:
                pass


def _one_of(what: str, name: str, known: Collection[str]) -> None:
    if name not in known:
        raise InputError(what, shown(name), "one that this page lists")
