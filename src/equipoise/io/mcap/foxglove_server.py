"""The rows of a bench, live: a Foxglove WebSocket server that Foxglove and PlotJuggler connect to.

Protocol: Foxglove WebSocket, public (subprotocol ``foxglove.sdk.v1``). Messages are those of the
file (``log_messages``). It listens on this computer alone and takes no commands: an observer
cannot move anything.
"""

from collections.abc import Mapping
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.mcap.log_messages import SCENE_TOPIC, Send, Topics
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

LOOPBACK = "127.0.0.1"
PORT = 8765  # the protocol's customary port
ADDRESS = f"ws://{LOOPBACK}:{PORT}"
LAYOUT = Path(__file__).with_name("foxglove_layout.json")  # panels for these topics, to import


class _Newcomers:
    """Notes, in the server's thread, that somebody wants the scene who has not seen it."""

    def __init__(self) -> None:
        self.there = False

    def on_subscribe(self, client: Any, channel: Any) -> None:
        """Note it; the scene is sent by who has the bench."""
        self.there |= channel.topic == SCENE_TOPIC

    def on_unsubscribe(self, client: Any, channel: Any) -> None:
        """Do nothing: who leaves needs nothing."""


class LiveView(AbstractContextManager["LiveView"]):
    """A server of the rows that it is given."""

    def __init__(
        self, zero_ns: int, testbed: Testbed | None = None, port: int | None = None
    ) -> None:
        """Begin to listen, at 0: any free port; ``zero_ns`` is UTC at bench time zero.

        ``testbed`` tells what topics there will be, and what the scene shows.
        """
        port = PORT if port is None else port
        where = f"live view on {LOOPBACK}:{port}"
        foxglove = log_library("foxglove", where)
        context = foxglove.Context()
        self._newcomers = _Newcomers()

        def opened(topic: str, encoding: str, schema: Any, metadata: Mapping[str, str]) -> Send:
            channel = foxglove.Channel(
                topic, message_encoding=encoding, context=context, metadata=dict(metadata),
                schema=foxglove.Schema(
                    name=schema.name, encoding=schema.encoding, data=schema.data
                ),
            )  # fmt: skip
            return lambda data, ns: channel.log(data, log_time=ns)

        self._topics = Topics(opened, zero_ns, where, testbed)
        try:
            self._server: Any = foxglove.start_server(
                name="equipoise", host=LOOPBACK, port=port, context=context,
                server_listener=self._newcomers,
            )  # fmt: skip
        except (OSError, RuntimeError) as error:
            raise InputError(where, str(error), "a port that is free") from error

    @property
    def address(self) -> str:
        """Where to connect to."""
        return f"ws://{LOOPBACK}:{self._server.port}"

    def rows(self, recording: Recording) -> None:
        """Send the rows of every channel to whoever is connected."""
        self._topics.rows(recording)
        self._greeted(recording.span[1])

    def event(self, t: float, kind: str, sentence: str, data: Mapping[str, Any]) -> None:
        """Send what happened at a time (s)."""
        self._topics.event(t, kind, sentence, data)

    def turn(self, t: float) -> None:
        """Show the scene to who came; rows are sent as they are given."""
        self._greeted(t)

    def _greeted(self, t: float) -> None:
        if self._newcomers.there:
            self._newcomers.there = False
            self._topics.scene_again(t)

    def close(self) -> None:
        """End all connections."""
        self._server.stop()

    def __exit__(self, *_raised: object) -> None:
        """Close."""
        self.close()
