"""TMCL's binary datagrams: nine bytes to the module, nine bytes back.

    request   module  command  type     motor or bank  value, 4 bytes  checksum
    reply     host    module   status   command        value, 4 bytes  checksum

A value is signed, its highest byte first; a checksum is the sum of the eight bytes before it,
modulo 256. A reply names neither type nor motor: so only one request may be under way. Module and
host have the addresses that they have when they are new. Source: TMCM-6110 TMCL Firmware Manual
V1.31, 4.1 "Binary Command Format", 4.2 "Reply Format", 4.5; the sentences are ours.
"""

import struct
from collections.abc import Sequence
from dataclasses import dataclass

MODULE, HOST = 1, 2  # addresses: global parameters 66 and 76 as delivered
SIZE = 9  # bytes of a datagram
DONE = (100, 101)

MST, MVP, SAP, GAP, SGP, GGP, RFS, VERSION = 3, 4, 5, 6, 9, 10, 13, 136
ABSOLUTE = 0  # type of MVP
START, STOP, STATUS = 0, 1, 2  # types of RFS
BINARY = 1  # type of VERSION

# Axis parameters, types of SAP and GAP.
AT, SPEED, MOST_SPEED, MOST_ACCELERATION = 1, 3, 4, 5
RIGHT, LEFT, RIGHT_OFF, LEFT_OFF = 10, 11, 12, 13
MICROSTEPS, RAMP_DIVISOR, PULSE_DIVISOR, UNITS = 140, 153, 154, 255

REFUSALS = {
    1: "a request reached it garbled",
    2: "it does not know a command",
    3: "it does not have a parameter",
    4: "it does not take a value",
    5: "its memory is locked",
    6: "it cannot do this now",
}


@dataclass(frozen=True, slots=True)
class Request:
    """A command or a query to a module."""

    command: int
    type: int
    motor: int  # or the bank of a global parameter
    value: int = 0


@dataclass(frozen=True, slots=True)
class Reply:
    """What it answered."""

    status: int
    command: int
    value: int

    @property
    def done(self) -> bool:
        """Say whether the module carried out the request."""
        return self.status in DONE


def packed(request: Request) -> bytes:
    """Return a request as bytes."""
    each = (request.command, request.type, request.motor, request.value)
    head = struct.pack(">BBBBi", MODULE, *each)
    return head + bytes([sum(head) % 256])


def replies_in(data: bytes) -> tuple[Sequence[Reply], int, bytes]:
    """Return the replies in bytes, how often they were broken, and the rest that may go on.

    Where nine bytes are no reply, one may begin at the next byte.
    """
    found: list[Reply] = []
    k, breaks, whole = 0, 0, True
    while len(data) - k >= SIZE:
        reply = _reply(data[k : k + SIZE])
        if reply is None:
            breaks += whole
        else:
            found.append(reply)
        whole = reply is not None
        k += SIZE if whole else 1
    return found, breaks, data[k:]


def refusal(request: Request, status: int) -> str:
    """Return in words what was refused."""
    return (
        f"{REFUSALS.get(status, 'it refused a request')} (status {status} to {requested(request)})"
    )


def requested(request: Request) -> str:
    """Return a request in words."""
    return f"command {request.command}, type {request.type}, motor {request.motor}"


def _reply(data: bytes) -> Reply | None:
    host, module, status, command, value, check = struct.unpack(">BBBBiB", data)
    known = status in DONE or status in REFUSALS
    ours = (host, module) == (HOST, MODULE) and known and sum(data[:-1]) % 256 == check
    return Reply(status, command, value) if ours else None
