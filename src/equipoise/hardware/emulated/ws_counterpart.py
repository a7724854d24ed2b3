"""The emulated counterpart of a WebSocket: a server of the loopback, for one listener at a time.

A listener waits for the answer to its handshake, and may do so in the very thread that runs the
emulated devices. So a thread of its own receives; what is sent goes out at once, in the caller's.
"""

import select
import socket
import threading
from contextlib import suppress
from typing import Any

from equipoise.hardware.emulated.outbox import CHUNK, FULL, LOOPBACK, Outbox
from equipoise.model.optional_libraries import extra_library

POLL = 0.05  # s, chosen: between checks whether it has been closed


class WsCounterpart:
    """A server; the newest listener counts. What comes is a line for each message."""

    def __init__(self, path: str = "") -> None:
        extra_library("websockets", "emulate", "a WebSocket", "hardware")
        self._server = socket.create_server((LOOPBACK, 0))
        self.address = f"ws://{LOOPBACK}:{self._server.getsockname()[1]}{path}"
        self._lock = threading.Lock()  # held for no longer than a check
        self._listener: Listener | None = None
        self._received: list[bytes] = []
        self._open = True
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def receive(self) -> bytes:
        """Return what has been sent to the device."""
        with self._lock:
            if self._listener is not None:
                self._listener.flush()
            received, self._received = self._received, []
        return b"".join(message + b"\n" for message in received)

    def send(self, data: bytes) -> None:
        """Send a message to whoever listens."""
        with self._lock:
            if self._listener is not None and data:
                self._listener.say(data)

    def close(self) -> None:
        """Pull it out."""
        self._open = False
        self._thread.join()
        self._hang_up()
        self._server.close()

    def _serve(self) -> None:
        while self._open:
            lines = [self._server]
            if self._listener is not None:
                lines.append(self._listener.line)
            ready, _, _ = select.select(lines, [], [], POLL)
            with self._lock:
                if self._server in ready:
                    self._hang_up()
                    self._listener = Listener(self._server.accept()[0])
                elif ready and self._listener is not None:
                    received = self._listener.received()
                    self._received += received or []
                    if received is None:
                        self._hang_up()

    def _hang_up(self) -> None:
        """Close the listener's line; done by the thread that polls it, or after its end."""
        if self._listener is not None:
            self._listener.line.close()
        self._listener = None


class Listener:
    """A connection: a socket that never waits, and the state of its WebSocket."""

    def __init__(self, line: socket.socket) -> None:
        from websockets.server import ServerProtocol

        line.setblocking(False)
        line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.line, self._outbox = line, Outbox()
        self._protocol = ServerProtocol()

    def say(self, data: bytes) -> None:
        """Send a message, if the handshake is done and the listener is not too slow."""
        from websockets.protocol import State

        if self._protocol.state is State.OPEN and len(self._outbox.waiting) + len(data) < FULL // 2:
            self._protocol.send_text(data)
            self.flush()

    def received(self) -> list[bytes] | None:
        """Return the messages that have come; None if the line is closed."""
        try:
            data = self.line.recv(CHUNK)
        except BlockingIOError:
            return []
        except OSError:
            return None
        if not data:
            return None
        self._protocol.receive_data(data)
        found = [self._taken(event) for event in self._protocol.events_received()]
        self.flush()
        return None if self._protocol.close_expected() else [each for each in found if each]

    def flush(self) -> None:
        """Send what there is to send; a closed line is noticed when it is read."""
        self._outbox.add(b"".join(self._protocol.data_to_send()))
        with suppress(OSError):  # it would have to wait, or is closed
            self._outbox.flush(self.line.send)

    def _taken(self, event: Any) -> bytes:
        """Return a message's text; answer a handshake."""
        from websockets.frames import Opcode
        from websockets.http11 import Request

        if isinstance(event, Request):
            self._protocol.send_response(self._protocol.accept(event))
            return b""
        return bytes(event.data) if event.opcode is Opcode.TEXT else b""
