"""An emulated VN-100: one message of attitude and rate for each row, and register writes.

Written from the manual, apart from the driver.
"""

from collections.abc import Sequence
from functools import reduce

from equipoise.hardware.links.frame_transform import as_sensed
from equipoise.model.hardware import SensorUnit
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
        said: dict[float, dict[str, bytes]] = {}
        for channel, samples in (("attitude", rows.attitude), ("rate", rows.rate)):
            if samples is None or channel not in self._unit.gives:
                continue
            sensed = as_sensed(self._unit, channel, samples.values)
            for t, row in zip(samples.t, sensed, strict=True):
                # Vector first; seven digits, so that the wire adds no noise of its own.
                values = [*row[1:], row[0]] if channel == "attitude" else row
                said.setdefault(float(t), {})[channel] = b",".join(b"%+.7f" % v for v in values)
        return [_reported(parts) for _, parts in sorted(said.items())]


def _reported(parts: dict[str, bytes]) -> bytes:
    if len(parts) == 2:
        still = b"+00.0000,+00.0000,+00.0000,+00.000,+00.000,-09.807"  # field and acceleration
        return message(b"VNQMR," + parts["attitude"] + b"," + still + b"," + parts["rate"])
    if "attitude" in parts:
        return message(b"VNQTN," + parts["attitude"])
    return message(b"VNGYR," + parts["rate"])


def _answer(line: bytes) -> bytes:
    if not line:
        return b""
    body, _, checksum = line.removeprefix(b"$").partition(b"*")
    if checksum != message(body)[-4:-2]:
        return message(BAD_CHECKSUM)
    return message(b"VNWRG" + body[5:]) if body.startswith(b"VNWRG") else message(NOT_KNOWN)
