"""The rows of a bench, live: a Foxglove WebSocket server that Foxglove and PlotJuggler connect to.

Protocol: Foxglove WebSocket, public (subprotocol ``foxglove.sdk.v1``). Messages are those of the
file (``log_messages``). It listens on this computer alone and takes no commands: an observer
cannot move anything.

Who may observe, by the ``Origin`` of a connection (``origin_gate``):

    none                          programs: PlotJuggler, scripts. A page in a browser always has one
    file://                       the desktop programs Foxglove and Lichtblick
    https://app.foxglove.dev      Foxglove in a browser, and studio.foxglove.dev, which led there
    http://localhost, 127.0.0.1   Lichtblick served from this computer, at any port

Every other page is refused, and so is a ``Host`` that is not this computer. The server of the
library knows no origins: it listens behind the gate, at a loopback address drawn for each session.
"""

import re
import secrets
import socket
from collections.abc import Mapping
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.mcap.log_messages import SCENE_TOPIC, Send, Topics
from equipoise.io.mcap.origin_gate import Head, OriginGate
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

LOOPBACK = "127.0.0.1"
PORT = 8765  # the protocol's customary port
ADDRESS = f"ws://{LOOPBACK}:{PORT}"
ORIGINS = re.compile(
    r"file://|https://(app|studio)\.foxglove\.dev|http://(localhost|127\.0\.0\.1|\[::1\])(:\d+)?"
)
HOSTS = re.compile(r"(localhost|127\.0\.0\.1)(:\d+)?")
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
        at = _listening(port, where)
        self._port: int = at.getsockname()[1]
        inner = drawn_address()
        try:
            self._server: Any = foxglove.start_server(
                name="equipoise", host=inner, port=0, context=context,
                server_listener=self._newcomers,
            )  # fmt: skip
        except (OSError, RuntimeError) as error:
            at.close()
            raise InputError(where, str(error), "a port that is free") from error
        self._gate = OriginGate(at, (inner, self._server.port), welcome)

    @property
    def address(self) -> str:
        """Where to connect to."""
        return f"ws://{LOOPBACK}:{self._port}"

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
        self._gate.close()
        self._server.stop()

    def __exit__(self, *_raised: object) -> None:
        """Close."""
        self.close()


def welcome(head: Head) -> bool:
    """Say whether a connection may observe, by the head of its request (see above)."""
    hosts, origins = head.get("host", []), head.get("origin", [])
    ours = len(hosts) == 1 and HOSTS.fullmatch(hosts[0]) is not None
    return ours and all(ORIGINS.fullmatch(origin) for origin in origins)


def drawn_address() -> str:
    """Return a loopback address that no page guesses, where the system has more than one."""
    drawn = ".".join(["127", *(str(1 + secrets.randbelow(254)) for _ in range(3))])
    with socket.socket() as probe:
        try:
            probe.bind((drawn, 0))
        except OSError:
            return LOOPBACK
    return drawn


def _listening(port: int, where: str) -> socket.socket:
    try:
        return socket.create_server((LOOPBACK, port))
    except OSError as error:
        raise InputError(where, error.strerror or str(error), "a port that is free") from error
