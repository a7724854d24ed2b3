"""The socket on which an experiment states what balancing masses may do.

Datagrams of text over UDP: ``hold``, ``free`` or ``done``; each is answered with ``ok`` and what
holds from then on. Anything else is answered with what was found and what is wanted, and
changes nothing; ``state`` asks alone. What was stated last holds until something else is: an
experiment that ends without a word leaves masses as it had them. A lost datagram shows by its
missing answer.

It is bound to one address of this computer; whoever reaches that may command.
"""

import socket
from types import TracebackType

from equipoise.model.errors import InputError
from equipoise.model.permission import Permission

LONGEST = 64  # bytes of a datagram that are read, chosen: the longest word has five
AT_ONCE = 100  # datagrams between two measurements, chosen: no flood delays a bench
STATE = "state"
WANTED = ", ".join((*Permission, STATE))


class ExperimentPort:
    """What the experiment stated last; call it between two measurements."""

    def __init__(self, host: str, port: int) -> None:
        self._permission = Permission.FREE
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        try:
            self._socket.bind((host, port))
        except OSError as error:
            self._socket.close()
            found = error.strerror or str(error)
            raise InputError(
                f"experiment port {host}:{port}", found, "a free port of this computer"
            ) from error

    @property
    def address(self) -> tuple[str, int]:
        """Return host and port."""
        host, port = self._socket.getsockname()
        return host, port

    def __call__(self) -> Permission:
        """Take in what has arrived, answer it, and return what holds now."""
        for _ in range(AT_ONCE):
            try:
                data, sender = self._socket.recvfrom(LONGEST + 1)
            except BlockingIOError:
                break
            except OSError:
                continue  # an answer before did not arrive: the system says so here
            self._answer(data, sender)
        return self._permission

    def _answer(self, data: bytes, sender: tuple[str, int]) -> None:
        text = self._said(data)
        try:
            self._socket.sendto(text.encode(), sender)
        except OSError:
            return  # who has left needs no answer

    def _said(self, data: bytes) -> str:
        """Return the answer to a datagram, after what it states holds."""
        word = data.decode("ascii", errors="replace").strip().lower()
        if word != STATE:
            try:
                self._permission = Permission(word)
            except ValueError:
                return f"error: found {word[:LONGEST]!a}; wanted {WANTED}"
        return f"ok {self._permission}"

    def close(self) -> None:
        """Give the port back."""
        self._socket.close()

    def __enter__(self) -> "ExperimentPort":
        """Return it, open."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Give the port back."""
        self.close()
