"""Ports: bytes out, and whatever has arrived, at once and without waiting.

An address is as in ``model.hardware``. A port that is gone says so by PortLost, whether it was
pulled out, closed by the emulated counterpart or never there.
"""

import select
import socket
from contextlib import ExitStack, suppress
from typing import Protocol

from equipoise.model.errors import EquipoiseError
from equipoise.model.hardware import Port as Address
from equipoise.model.optional_libraries import extra_library

PATIENCE = 1.0  # s, chosen: for a computer on the same network to accept a connection
CHUNK = 65536  # bytes, at most taken at once: a datagram's greatest size
BACKLOG = 64  # chunks, chosen: taken in one turn, so that no port keeps others waiting


class PortLost(EquipoiseError):
    """A port that cannot be opened, or is gone."""

    def __init__(self, address: str, why: object) -> None:
        super().__init__(f"{address}: {why}")


class Port(Protocol):
    """An open port."""

    def receive(self) -> list[bytes]:
        """Return what has arrived since the last call, for datagrams and messages one each."""
        ...

    def send(self, data: bytes) -> None:
        """Send all of it."""
        ...

    def close(self) -> None:
        """Close it; what is not sent yet may be lost."""
        ...


def why(error: BaseException) -> str:
    """Return what the system says, without its number."""
    return getattr(error, "strerror", None) or str(error)


class SocketPort:
    """A stream or a socket for datagrams."""

    def __init__(
        self, address: str, connection: socket.socket, to: tuple[str, int] | None = None
    ) -> None:
        self._address, self._socket = address, connection
        self._stream = connection.type == socket.SOCK_STREAM
        self._to = to  # where datagrams go; None: to whom the last one came from
        self._from: tuple[str, int] | None = None
        connection.setblocking(False)

    def receive(self) -> list[bytes]:
        """Return what has arrived."""
        found: list[bytes] = []
        while len(found) < BACKLOG:
            try:
                data, self._from = self._socket.recvfrom(CHUNK)
            except BlockingIOError:
                break
            except OSError as error:
                raise PortLost(self._address, why(error)) from error
            if self._stream and not data:
                raise PortLost(self._address, "the other end closed the connection")
            found.append(data)
        return found

    def send(self, data: bytes) -> None:
        """Send all of it; a datagram that nobody is known for yet is dropped."""
        to = self._to or self._from
        try:
            if self._stream:
                self._all(data)
            elif to is not None:
                self._socket.sendto(data, to)
        except OSError as error:
            raise PortLost(self._address, why(error)) from error

    def _all(self, data: bytes) -> None:
        while data:
            _, ready, _ = select.select([], [self._socket], [], PATIENCE)
            if not ready:
                raise PortLost(self._address, f"it took nothing for {PATIENCE:g} s")
            data = data[self._socket.send(data) :]

    def close(self) -> None:
        """Close it."""
        self._socket.close()


def tcp_port(port: Address, rest: str) -> Port:
    """Return a stream to a computer."""
    host, _, number = rest.rpartition(":")
    connection = socket.create_connection((host, int(number)), PATIENCE)
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return SocketPort(port.address, connection)


def http_port(port: Address, rest: str) -> Port:
    """Return the connection to a camera's server; its driver asks for the path."""
    host = rest.removeprefix("//").partition("/")[0]
    return tcp_port(port, host if ":" in host else f"{host}:80")


def udp_port(port: Address, rest: str) -> Port:
    """Return a socket that receives datagrams sent to a local port or to a multicast group."""
    group, _, number = rest.rpartition(":")
    connection = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        connection.bind(("" if _is_group(group) or not group else group, int(number)))
        if _is_group(group):
            member = socket.inet_aton(group) + socket.inet_aton("0.0.0.0")
            connection.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
    except OSError:
        connection.close()
        raise
    return SocketPort(port.address, connection)


def udp_out_port(port: Address, rest: str) -> Port:
    """Return a socket that sends to another computer and receives its answers."""
    host, _, number = rest.rpartition(":")
    to = (socket.gethostbyname(host), int(number))
    connection = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        connection.bind(("", 0))
    except OSError:
        connection.close()
        raise
    return SocketPort(port.address, connection, to)


def _is_group(host: str) -> bool:
    """Say whether a host is a multicast group: 224.0.0.0 to 239.255.255.255."""
    first = host.partition(".")[0]
    return first.isdigit() and 224 <= int(first) <= 239


class SerialPort:
    """A serial line, held by this process alone."""

    def __init__(self, port: Address, path: str) -> None:
        address = port.address
        serialx = extra_library("serialx", address, "a serial port", "hardware")
        self._address, self._lost = address, (OSError, serialx.SerialException)
        try:
            self._line = serialx.serial_for_url(path, baudrate=port.baud, timeout=0, exclusive=True)
            self._line.open()
            self._line.reset_read_buffer()  # what the system kept from before is no news
        except self._lost as error:
            raise PortLost(address, why(error)) from error

    def receive(self) -> list[bytes]:
        """Return what has arrived."""
        try:
            data: bytes = self._line.read(CHUNK)
        except TimeoutError:
            return []
        except self._lost as error:
            raise PortLost(self._address, why(error)) from error
        return [data] if data else []

    def send(self, data: bytes) -> None:
        """Send all of it."""
        try:
            while data:
                data = data[self._line.write(data, timeout=PATIENCE) :]
        except self._lost as error:
            raise PortLost(self._address, why(error)) from error

    def close(self) -> None:
        """Close it."""
        with suppress(*self._lost):
            self._line.close()


class WebSocketPort:
    """Messages of a WebSocket."""

    def __init__(self, port: Address, _rest: str) -> None:
        address = port.address
        extra_library("websockets", address, "a WebSocket", "hardware")
        from websockets.exceptions import WebSocketException
        from websockets.sync.client import connect

        self._address, self._lost = address, (OSError, WebSocketException)
        self._held = ExitStack()
        try:
            opened = connect(address, open_timeout=PATIENCE, close_timeout=PATIENCE)
            self._connection = self._held.enter_context(opened)
        except self._lost as error:
            raise PortLost(address, error) from error

    def receive(self) -> list[bytes]:
        """Return what has arrived, a message each."""
        found: list[bytes] = []
        while len(found) < BACKLOG:
            try:
                message = self._connection.recv(timeout=0)
            except TimeoutError:
                break
            except self._lost as error:
                raise PortLost(self._address, error) from error
            found.append(message.encode() if isinstance(message, str) else message)
        return found

    def send(self, data: bytes) -> None:
        """Send one message as text for each line."""
        try:
            for message in data.splitlines():
                self._connection.send(message.decode())
        except self._lost as error:
            raise PortLost(self._address, error) from error

    def close(self) -> None:
        """Close it."""
        with suppress(*self._lost):
            self._held.close()
