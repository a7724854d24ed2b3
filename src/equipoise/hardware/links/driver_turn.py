"""A driver and its port: bytes there and back, and what happens to the port."""

from typing import Protocol, TypeVar

from equipoise.hardware.transport.reconnecting_port import Connection

Found = TypeVar("Found", covariant=True)


class Fed(Protocol[Found]):
    """A driver that commands something (``transport.driver_protocol``)."""

    def opened(self, t: float) -> None:
        """Note that the port has just been opened."""
        ...

    def closed(self, why: str) -> None:
        """Note that the port is gone."""
        ...

    def feed(self, data: bytes, t: float) -> Found:
        """Take in what has arrived."""
        ...

    def due(self, t: float) -> bytes:
        """Return what to send now."""
        ...


def fed(driver: Fed[Found], connection: Connection, t: float) -> list[Found]:
    """Feed a driver what has arrived; return what it made of each piece."""
    turn = connection.turn(t)
    if turn.opened:
        driver.opened(t)
    found = [driver.feed(data, t) for data in turn.data]
    if turn.lost:
        driver.closed(turn.lost)
    return found


def said(driver: Fed[object], connection: Connection, t: float) -> None:
    """Send what a driver has to say."""
    if connection.why:
        return
    lost = connection.send(driver.due(t), t).lost
    if lost:
        driver.closed(lost)
