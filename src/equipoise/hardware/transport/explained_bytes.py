"""Bytes in words, for a person who watches a conversation as it happens."""

from typing import Protocol

SHOWN = 80  # characters, chosen: of a message that nobody has words for


class Explained(Protocol):
    """The words for what goes back and forth with one device."""

    def sent(self, data: bytes) -> list[str]:
        """Return what the driver has said."""
        ...

    def received(self, data: bytes) -> list[str]:
        """Return what the device has said."""
        ...


class PlainBytes:
    """Text as it is, and other bytes by their number: enough for what a sensor sends."""

    def sent(self, data: bytes) -> list[str]:
        """Return what the driver has said."""
        return _shown(data)

    def received(self, data: bytes) -> list[str]:
        """Return what the device has said."""
        return _shown(data)


def _shown(data: bytes) -> list[str]:
    if not all(32 <= byte < 127 or byte in b"\r\n\t" for byte in data):
        return [f"{len(data)} bytes: {data[:12].hex(' ')} ..."]
    lines = data.decode("ascii").split("\n")
    return [line.strip()[:SHOWN] for line in lines if line.strip()]
