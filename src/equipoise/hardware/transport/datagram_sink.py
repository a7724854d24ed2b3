"""Datagrams to whoever listens: sent at once or lost, never waited for."""

from contextlib import AbstractContextManager

from equipoise.hardware.transport.port import Port, PortLost


class DatagramSink(AbstractContextManager["DatagramSink"]):
    """A port that datagrams go out of; what it cannot take is counted and forgotten.

    A receiver that is not there costs nothing: UDP does not say whether anybody listens.
    """

    def __init__(self, port: Port) -> None:
        self._port = port
        self.sent, self.lost = 0, 0  # datagrams

    def send(self, data: bytes) -> None:
        """Send a datagram, or count it as lost."""
        try:
            self._port.send(data)
            self.sent += 1
        except PortLost:
            self.lost += 1

    def close(self) -> None:
        """Close the port."""
        self._port.close()

    def __exit__(self, *_raised: object) -> None:
        """Close."""
        self.close()
