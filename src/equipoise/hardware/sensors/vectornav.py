"""VectorNav VN-100 and VN-200, ASCII over a serial line.

    $VNQMR,x,y,z,w,mx,my,mz,ax,ay,az,p,q,r*CS       CS: two hex digits, the exclusive or of all
                                                   bytes between $ and *; or four, CRC-16-CCITT

Source: VN-100 user manual, sections "Communication interface" and "Asynchronous outputs" (registers
6 and 7). Quaternions come vector first. Their numbers are those of the turn that takes sensor
components to north-east-down ones: a device turned by +psi about down says (0, 0, sin psi/2,
cos psi/2), and its own matrix, printed in the manual for the way from NED to the sensor, is the
transpose of ours. Angles are yaw, pitch, roll in degrees, 3-2-1. Rates are rad/s.

These messages hold no time, so rows are stamped as they arrive.
"""

from binascii import crc_hqx
from collections.abc import Callable, Sequence
from functools import reduce
from typing import NamedTuple

from equipoise.hardware.sensors.attitudes import from_angles, unit_row
from equipoise.hardware.sensors.settings import Settings
from equipoise.hardware.transport.conversation import SensorDriver
from equipoise.hardware.transport.finite_numbers import all_finite
from equipoise.hardware.transport.line_splitter import Lines
from equipoise.model.hardware import Gives, SensorUnit
from equipoise.model.reading import Reading

Values = Sequence[float]


def quaternion(v: Values) -> tuple[float, ...]:
    """Return the quaternion at the front, scalar first."""
    return (v[3], v[0], v[1], v[2])


def angles(v: Values) -> tuple[float, ...]:
    """Return the quaternion of yaw, pitch, roll (deg) at the front; 3-2-1."""
    return from_angles(v[0], v[1], v[2])


def last_three(v: Values) -> tuple[float, ...]:
    """Return the rates at the end."""
    return tuple(v[-3:])


class Message(NamedTuple):
    """A kind of message: how many numbers, and what they hold."""

    width: int
    code: int  # of register 6, which asks for it
    attitude: Callable[[Values], tuple[float, ...]] | None = None
    rate: Callable[[Values], tuple[float, ...]] | None = None


MESSAGES = {
    b"VNYPR": Message(3, 1, angles),
    b"VNQTN": Message(4, 2, quaternion),
    b"VNQMR": Message(13, 8, quaternion, last_three),
    b"VNGYR": Message(3, 12, None, last_three),
    b"VNYMR": Message(12, 14, angles, last_three),
}
UNIT = 1e-3  # chosen: a quaternion of six decimals is of length one within this
KEYS = ("message", "rate_hz")
KIND, RATE = 6, 7  # registers
WRITE, ERROR = b"VNWRG", b"VNERR"


class VectorNav(SensorDriver):
    """The conversation; settings: ``message`` such as VNQMR and ``rate_hz``, asked for if given.

    The device answers a request by saying it again, or by $VNERR and a number. One that restarted
    has forgotten: it is asked again when another of these messages comes than the one asked for.
    """

    def __init__(self, unit: SensorUnit) -> None:
        self._requested = _requests(unit)  # bodies by register
        super().__init__({body.decode(): _line_of(body) for body in self._requested.values()})
        self._lines, self._first = Lines(), False

    def opened(self) -> None:
        """Restart."""
        super().opened()
        self._lines.cleared()
        self._first = True

    def feed(self, data: bytes) -> Sequence[Reading]:
        """Return the rows that are complete with these bytes."""
        return [reading for line in self._lines.cut(data) for reading in self._line(line)]

    def _line(self, line: bytes) -> list[Reading]:
        body, first, self._first = checked(line), self._first, False
        if body is None:
            text = b"$" not in line and b"*" not in line and line.isascii()
            # the port may have been opened in the middle of a line
            self.count(corrupt=not (first or text), foreign=text)
            return []
        name, *fields = body.split(b",")
        message = MESSAGES.get(name)
        self._confirm(name, fields, message)
        return self.counted(None if message is None else _readings(message, fields))

    def _confirm(self, name: bytes, fields: Sequence[bytes], message: Message | None) -> None:
        """Note what a line says of the requests: an echo, an error, or the message asked for."""
        if name == ERROR:
            self.requests.refused(b",".join((name, *fields)).decode(errors="replace"))
        elif name == WRITE:
            for body in self._requested.values():
                if all_finite(fields[:2]) == all_finite(body.split(b",")[1:]):
                    self.requests.confirmed(body.decode())
        elif message is not None and KIND in self._requested:
            body = self._requested[KIND]
            right = body == _request(KIND, message.code)
            (self.requests.confirmed if right else self.requests.reopen)(body.decode())


def checked(line: bytes) -> bytes | None:
    """Return what stands between $ and *; None if the checksum says that it is broken."""
    start = line.rfind(b"$")  # what stands before it is a rest of another line
    body, star, message = line[start + 1 :].partition(b"*")
    if start < 0 or not star:
        return None
    right = {2: exclusive_or, 4: crc16}.get(len(message))
    try:
        return body if right is not None and int(message, 16) == right(body) else None
    except ValueError:
        return None


def exclusive_or(body: bytes) -> int:
    """Return the 8-bit checksum."""
    return reduce(lambda a, b: a ^ b, body, 0)


def crc16(body: bytes) -> int:
    """Return the 16-bit checksum: CRC-CCITT, polynomial 0x1021, begun at zero."""
    return crc_hqx(body, 0)


def _readings(message: Message, fields: Sequence[bytes]) -> list[Reading]:
    values = all_finite(fields)
    if values is None or len(values) != message.width:
        return []
    found: list[Reading] = []
    wanted: tuple[tuple[Gives, Callable[[Values], tuple[float, ...]] | None], ...] = (
        ("attitude", message.attitude),
        ("rate", message.rate),
    )
    for channel, taken in wanted:
        if taken is None:
            continue
        row = taken(values)
        if channel == "attitude":
            row = unit_row(row, UNIT)
        if row is None:
            return []
        found.append(Reading(channel, row))
    return found


def _requests(unit: SensorUnit) -> dict[int, bytes]:
    """Return the bodies of the commands that ask for a message and its rate, by register."""
    settings = Settings(unit, KEYS)
    name, rate = settings.text("message"), settings.positive("rate_hz")
    found: dict[int, bytes] = {}
    if name:
        known = [each.decode() for each in MESSAGES]
        code = MESSAGES[settings.text("message", among=known).encode()].code
        found[KIND] = _request(KIND, code)
    if rate is not None:
        found[RATE] = _request(RATE, int(rate))
    return found


def _request(register: int, value: int) -> bytes:
    return b"%s,%02d,%d" % (WRITE, register, value)


def _line_of(body: bytes) -> bytes:
    return b"$%s*%02X\r\n" % (body, exclusive_or(body))
