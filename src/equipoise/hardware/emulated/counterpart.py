"""The other ends of ports on this computer: where an emulated device is reached.

A serial line becomes a pseudo terminal, a network bridge or a camera's server a TCP port of the
loopback, a UDP device sends to a port of the loopback, a WebSocket has a server there. What nobody
listens to is dropped, as on a real wire.
"""

import errno
import os
import socket
from contextlib import suppress
from functools import partial
from typing import Protocol

from equipoise.hardware.emulated.outbox import CHUNK, LOOPBACK, Outbox
from equipoise.hardware.emulated.ws_counterpart import WsCounterpart
from equipoise.model.errors import InputError
from equipoise.model.hardware import Port


class Counterpart(Protocol):
    """The end of a wire where the device is."""

    @property
    def address(self) -> str:
        """Where the other end is, as ``model.hardware`` has it."""
        ...

    def receive(self) -> bytes:
        """Return what has been sent to the device."""
        ...

    def send(self, data: bytes) -> None:
        """Send to whoever listens."""
        ...

    def close(self) -> None:
        """Pull it out."""
        ...


class PtyCounterpart:
    """A pseudo terminal; whether anybody holds its other end is known from reading."""

    def __init__(self) -> None:
        import tty

        self._master, slave = os.openpty()
        tty.setraw(slave)
        os.set_blocking(self._master, False)
        self.address = f"serial:{os.ttyname(slave)}"
        os.close(slave)
        self._held, self._outbox = False, Outbox()

    def receive(self) -> bytes:
        """Return what has been sent to the device."""
        self._flush()
        try:
            data = os.read(self._master, CHUNK)
            self._held = bool(data)  # BSD: an end of file where nobody holds it
        except OSError as error:
            if error.errno not in (errno.EAGAIN, errno.EIO):
                raise
            self._held, data = error.errno == errno.EAGAIN, b""  # Linux: EIO where nobody does
        if not self._held:
            self._outbox = Outbox()
        return data

    def send(self, data: bytes) -> None:
        """Send to whoever listens."""
        if self._held:
            self._outbox.add(data)
            self._flush()

    def close(self) -> None:
        """Pull it out."""
        os.close(self._master)

    def _flush(self) -> None:
        with suppress(BlockingIOError):
            self._outbox.flush(partial(os.write, self._master))


class TcpCounterpart:
    """A server on the loopback, for one listener at a time; the newest counts."""

    def __init__(self, scheme: str = "tcp", path: str = "", number: int = 0) -> None:
        self._server = socket.create_server((LOOPBACK, number))
        self._server.setblocking(False)
        host = f"{LOOPBACK}:{self._server.getsockname()[1]}"
        self.address = f"{scheme}:{host}" if scheme == "tcp" else f"{scheme}://{host}{path}"
        self._line: socket.socket | None = None
        self._outbox = Outbox()

    def receive(self) -> bytes:
        """Return what has been sent to the device."""
        self._accept()
        self._flush()
        if self._line is None:
            return b""
        try:
            data = self._line.recv(CHUNK)
        except BlockingIOError:
            return b""
        except OSError:
            data = b""
        if not data:
            self._hang_up()
        return data

    def send(self, data: bytes) -> None:
        """Send to whoever listens; a new one is taken when something is received."""
        if self._line is not None:
            self._outbox.add(data)
            self._flush()

    def close(self) -> None:
        """Pull it out."""
        self._hang_up()
        self._server.close()

    def _accept(self) -> None:
        with suppress(BlockingIOError):
            line, _ = self._server.accept()
            self._hang_up()
            line.setblocking(False)
            line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._line = line

    def _flush(self) -> None:
        try:
            if self._line is not None:
                self._outbox.flush(self._line.send)
        except BlockingIOError:
            pass
        except OSError:
            self._hang_up()

    def _hang_up(self) -> None:
        if self._line is not None:
            self._line.close()
        self._line, self._outbox = None, Outbox()


class UdpCounterpart:
    """A sender of datagrams to a port of the loopback; without one, to whoever last sent any."""

    def __init__(self, number: int | None) -> None:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind((LOOPBACK, 0))
        self._socket.setblocking(False)
        self._answers = number is None
        self._to: tuple[str, int] | None = None if number is None else (LOOPBACK, number)
        own = self._socket.getsockname()[1]
        self.address = f"udpout:{LOOPBACK}:{own}" if number is None else f"udp:{LOOPBACK}:{number}"

    def receive(self) -> bytes:
        """Return what has been sent to the device."""
        try:
            data, sender = self._socket.recvfrom(CHUNK)
        except OSError:  # nothing, or nobody listens yet
            return b""
        if self._answers:
            self._to = sender
        return data

    def send(self, data: bytes) -> None:
        """Send to whoever listens."""
        with suppress(OSError):
            if self._to is not None:
                self._socket.sendto(data, self._to)

    def close(self) -> None:
        """Pull it out."""
        self._socket.close()


def free_udp_port() -> int:
    """Return a port of the loopback that nobody holds now."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as trial:
        trial.bind((LOOPBACK, 0))
        return int(trial.getsockname()[1])


def counterpart(port: Port) -> Counterpart:
    """Return an emulated counterpart of the kind that a port's address asks for."""
    scheme, _, rest = port.address.partition(":")
    if scheme == "serial":
        return PtyCounterpart() if hasattr(os, "openpty") else TcpCounterpart()
    if scheme == "tcp":
        return TcpCounterpart()
    if scheme == "http":
        return TcpCounterpart("http", "/" + rest.removeprefix("//").partition("/")[2])
    if scheme in ("udp", "udpout"):
        return UdpCounterpart(free_udp_port() if scheme == "udp" else None)
    if scheme == "ws":
        return WsCounterpart("/" + rest.removeprefix("//").partition("/")[2])
    known = "serial, tcp, udp, udpout, ws or http to emulate"
    raise InputError(f"port {port.address}", f"'{scheme}:'", known)
