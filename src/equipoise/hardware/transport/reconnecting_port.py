"""A device's port, opened again and again for as long as it is gone."""

from collections.abc import Callable
from dataclasses import dataclass

from equipoise.hardware.transport.port import Port, PortLost
from equipoise.model.hardware import Port as Address

AGAIN = 0.25  # s, chosen: between tries to open a port that is gone

Opener = Callable[[Address], Port]


@dataclass(frozen=True, slots=True)
class Turn:
    """What one poll of a port returned."""

    data: tuple[bytes, ...] = ()
    opened: bool = False  # just now
    lost: str = ""  # why it is gone, just now


class Connection:
    """Keeps a port open; never raises for a port that is gone."""

    def __init__(self, address: Address, opener: Opener) -> None:
        self._address, self._opener = address, opener
        self._port: Port | None = None
        self._next = float("-inf")
        self.why = "not opened yet"  # it is closed; empty while it is open

    def turn(self, t: float) -> Turn:
        """Return what has arrived, after opening the port if it is time to try."""
        opened = self._port is None and t >= self._next and self._open(t)
        if self._port is None:
            return Turn()
        try:
            return Turn(tuple(self._port.receive()), opened)
        except PortLost as lost:
            return self._gone(t, lost)

    def send(self, data: bytes, t: float) -> Turn:
        """Send, if the port is open."""
        if self._port is not None and data:
            try:
                self._port.send(data)
            except PortLost as lost:
                return self._gone(t, lost)
        return Turn()

    def close(self) -> None:
        """Close it for good, or until the next turn."""
        if self._port is not None:
            self._port.close()
        self._port = None

    def _open(self, t: float) -> bool:
        self._next = t + AGAIN
        try:
            self._port, self.why = self._opener(self._address), ""
        except PortLost as lost:
            self.why = str(lost)
        return self._port is not None

    def _gone(self, t: float, lost: PortLost) -> Turn:
        self.close()
        self.why, self._next = str(lost), t + AGAIN
        return Turn(lost=self.why)
