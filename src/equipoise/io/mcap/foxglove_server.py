"""The rows of a bench, live: a Foxglove WebSocket server that Foxglove and PlotJuggler connect to.

Protocol: Foxglove WebSocket, public (subprotocol ``foxglove.sdk.v1``). Messages are those of the
file (``log_messages``). It listens on this computer alone and takes no commands: an observer
cannot move anything.
"""

from collections.abc import Mapping
from contextlib import AbstractContextManager
from typing import Any

from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.mcap.log_messages import Topics
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording

LOOPBACK = "127.0.0.1"
PORT = 8765  # the protocol's customary port
ADDRESS = f"ws://{LOOPBACK}:{PORT}"


class LiveView(AbstractContextManager["LiveView"]):
    """A server of the rows that it is given."""

    def __init__(self, zero_ns: int, port: int | None = None) -> None:
        """Begin to listen, at 0: any free port; ``zero_ns`` is UTC at bench time zero."""
        port = PORT if port is None else port
        where = f"live view on {LOOPBACK}:{port}"
        foxglove = log_library("foxglove", where)
        context = foxglove.Context()
        self._topics = Topics(context, zero_ns, where)
        try:
            self._server: Any = foxglove.start_server(
                name="equipoise", host=LOOPBACK, port=port, context=context
            )
        except (OSError, RuntimeError) as error:
            raise InputError(where, str(error), "a port that is free") from error

    @property
    def address(self) -> str:
        """Where to connect to."""
        return f"ws://{LOOPBACK}:{self._server.port}"

    def rows(self, recording: Recording) -> None:
        """Send the rows of every channel to whoever is connected."""
        self._topics.rows(recording)

    def event(self, t: float, kind: str, sentence: str, data: Mapping[str, Any]) -> None:
        """Send what happened at a time (s)."""
        self._topics.event(t, kind, sentence, data)

    def turn(self, t: float) -> None:
        """Do nothing: rows are sent as they are given."""

    def close(self) -> None:
        """End all connections."""
        self._server.stop()

    def __exit__(self, *_raised: object) -> None:
        """Close."""
        self.close()
