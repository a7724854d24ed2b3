"""A dashboard from its start to its end: port, token, runner, server."""

import socket
from collections.abc import Iterator
from contextlib import AbstractContextManager

from equipoise.app.dashboard.protocol.requests import Request
from equipoise.app.dashboard.runner.runner_process import Opening
from equipoise.app.dashboard.server.authorisation import Guard, new_token
from equipoise.app.dashboard.server.broadcast import Watch
from equipoise.app.dashboard.server.gate import Doors, Gate
from equipoise.app.dashboard.server.request_queue import Counter
from equipoise.app.dashboard.server.server import RemoteRunner, application
from equipoise.app.dashboard.server.serving import (
    bracketed,
    check_libraries,
    listening,
    names,
    serve,
)
from equipoise.estimation.methods.registry import METHODS
from equipoise.procedure.balancing.catalogue import CARDS


class Session(AbstractContextManager["Session"]):
    """See above."""

    def __init__(
        self, at: socket.socket, token: str, app: Gate, runner: RemoteRunner, exposed: bool
    ) -> None:
        self._socket, self._app, self._runner = at, app, runner
        self._token, self._exposed = token, exposed

    def lines(self) -> Iterator[str]:
        """Yield what a person has to know."""
        host, port = self._socket.getsockname()[:2]
        query = f"/?token={self._token}" if self._exposed else ""
        yield f"The dashboard is at http://{bracketed(host)}:{port}{query}"
        yield f"Token, to command: {self._token}"
        if self._exposed:
            yield "Others on the network can read the traffic: it is not encrypted."
        yield "Ctrl-C ends it and halts every mass."

    def serve(self) -> None:
        """Serve until Ctrl-C."""
        serve(self._app, self._socket)

    def __exit__(self, *_raised: object) -> None:
        """End the runner, which halts the bench."""
        self._runner.close()
        self._socket.close()


def open_session(opening: Opening, host: str, port: int, exposed: bool) -> Session:
    """Return a session that listens; InputError where it cannot."""
    check_libraries()
    at = listening(host, port)
    token, watch = new_token(), Watch()
    runner = RemoteRunner(opening)
    try:
        runner.wait_until_ready()
    except BaseException:
        runner.close()
        at.close()
        raise

    def send(request: Request) -> None:
        try:
            runner.pipe.send(request)
        except OSError:
            return  # it has ended; the watch says so

    laws, methods = tuple(CARDS), tuple(METHODS)
    counter = Counter(opening.testbed, opening.folder, laws, methods, watch, Guard(token), send)
    doors = Doors(frozenset(names(host, at.getsockname()[1])), exposed)
    return Session(at, token, application(counter, runner.pipe, doors), runner, exposed)
