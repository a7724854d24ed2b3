"""An emulated VN-100: one message of attitude and rate for each row, and register writes.

Written from the manual, independently of the driver.
"""

from collections.abc import Mapping, Sequence
from functools import reduce

import numpy as np

from equipoise.hardware.emulated.device import sensed_rows
from equipoise.model.arrays import Floats
from equipoise.model.hardware import Gives, SensorUnit
from equipoise.model.recording import Recording

BAD_CHECKSUM = b"VNERR,03"
NOT_KNOWN = b"VNERR,05"


def message(body: bytes) -> bytes:
    """Return a body between dollar sign and checksum."""
    return b"$" + body + b"*%02X\r\n" % reduce(lambda a, b: a ^ b, body, 0)


class EmulatedVectorNav:
    """Says VNQMR where rows of both channels coincide, VNQTN or VNGYR for one alone."""

    def __init__(self, unit: SensorUnit) -> None:
        self._unit = unit
        self._rest = b""

    def take(self, data: bytes, t: float) -> bytes:
        """Return the echo of each register write, as the device gives it."""
        *lines, self._rest = (self._rest + data).split(b"\n")
        return b"".join(_answer(line.strip()) for line in lines)

    def messages(self, rows: Recording) -> Sequence[bytes]:
        """Return the messages, in order of time."""
        return [_reported(parts) for _, parts in sensed_rows(self._unit, rows)]


def _reported(parts: Mapping[Gives, Floats]) -> bytes:
    if "attitude" not in parts:
        return message(b"VNGYR," + _digits(parts["rate"]))
    turn = _digits(np.roll(parts["attitude"], -1))  # vector first
    if "rate" not in parts:
        return message(b"VNQTN," + turn)
    still = b"+00.0000,+00.0000,+00.0000,+00.000,+00.000,-09.807"  # field and acceleration
    return message(b"VNQMR," + turn + b"," + still + b"," + _digits(parts["rate"]))


def _digits(values: Floats) -> bytes:
    """Return numbers with seven digits, so that the wire adds no noise of its own."""
    return b",".join(b"%+.7f" % value for value in values)


def _answer(line: bytes) -> bytes:
    if not line:
        return b""
    body, _, checksum = line.removeprefix(b"$").partition(b"*")
    if checksum != message(body)[-4:-2]:
        return message(BAD_CHECKSUM)
    return message(b"VNWRG" + body[5:]) if body.startswith(b"VNWRG") else message(NOT_KNOWN)
