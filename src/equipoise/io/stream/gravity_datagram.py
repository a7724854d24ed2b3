"""The datagram of the gravity torque: one table of fields, packed and unpacked by it.

Little endian, IEEE 754, every field at a multiple of its size, so that a C structure with the same
members has no gaps. The length belongs to the version: a later version has another number, and may
add fields at the end. The names say the units; vectors are x, y, z in body axes.

There is no checksum of its own. UDP has one over the whole datagram, and Ethernet has another; what
fails either is dropped by the receiver's system. Who sends it on over a bare serial line has to
add one.
"""

import math
import struct
from dataclasses import dataclass

import numpy as np

from equipoise.model.errors import InputError
from equipoise.model.gravity_torque import GravityTorque, TorqueStatus

MAGIC, VERSION = b"EQGT", 1
HOLD = 2.0  # s, chosen: four times what silence stops a real bench; a lost datagram changes nothing
FADE = 10.0  # s, chosen: longer than an attitude loop settles, so that the end is no step
C_TYPES = {"4s": "char", "H": "uint16_t", "I": "uint32_t", "Q": "uint64_t", "d": "double"}


@dataclass(frozen=True, slots=True)
class Field:
    """A field of the datagram."""

    name: str
    code: str  # as ``struct`` has it
    count: int
    meaning: str

    @property
    def size(self) -> int:
        """Bytes of all of it."""
        return self.count * struct.calcsize(f"<{self.code}")

    @property
    def c_type(self) -> str:
        """The type of one element in C."""
        return C_TYPES[self.code]

    @property
    def elements(self) -> int:
        """Elements of the member in C: the letters of a text are one each."""
        return 4 if self.code == "4s" else self.count


FIELDS = (
    Field("magic", "4s", 1, 'the letters "EQGT"'),
    Field("version", "H", 1, "of this layout"),
    Field("size", "H", 1, "bytes of the whole datagram"),
    Field("sequence", "I", 1, "counts datagrams from 0, and starts again after 4294967295"),
    Field("status", "I", 1, "0 not usable, 1 usable, 2 stale: sensors are silent"),
    Field("bench_time_s", "d", 1, "bench time of the newest row that it rests on"),
    Field("host_time_ns", "Q", 1, "when it was sent: UTC, nanoseconds since 1970"),
    Field("lead_s", "d", 1, "the torque is that at bench time + lead"),
    Field("hold_s", "d", 1, "how long a receiver may act on it in full"),
    Field("torque_N_m", "d", 3, "of gravity, on the platform, about the centre of rotation"),
    Field("torque_sd_N_m", "d", 3, "one standard deviation of each"),
    Field("first_moment_kg_m", "d", 3, "mass times centre of mass, masses as they stand"),
    Field("first_moment_sd_kg_m", "d", 3, "one standard deviation of each"),
    Field("gravity_m_s2", "d", 3, "gravity, by which the torque is formed"),
)
LAYOUT = struct.Struct("<" + "".join(each.count * each.code for each in FIELDS))
SIZE = LAYOUT.size
OFFSETS = tuple(sum(each.size for each in FIELDS[:k]) for k in range(len(FIELDS)))


@dataclass(frozen=True, slots=True, eq=False)
class Datagram:
    """A datagram as it is received."""

    sequence: int
    host_time_ns: int
    hold: float  # s
    content: GravityTorque


def packed(content: GravityTorque, sequence: int, host_time_ns: int) -> bytes:
    """Return the datagram of a torque; the sequence number starts again after 2^32 - 1."""
    numbers = (content.torque, content.torque_sd, content.first_moment, content.first_moment_sd,
               content.gravity)  # fmt: skip
    return LAYOUT.pack(
        MAGIC, VERSION, SIZE, sequence % 2**32, content.status,
        content.t, host_time_ns, content.lead, HOLD, *np.concatenate(numbers),
    )  # fmt: skip


def unpacked(data: bytes) -> Datagram:
    """Return what a datagram holds; InputError where it is none of this version."""
    if len(data) < SIZE or data[:4] != MAGIC:
        found = f"{len(data)} bytes that begin with {data[:4]!r}"
        raise InputError("datagram", found, f"{SIZE} bytes that begin with {MAGIC!r}")
    _, version, size, sequence, status, t, host_time_ns, lead, hold, *numbers = LAYOUT.unpack_from(
        data
    )
    known = status in list(TorqueStatus) and all(map(math.isfinite, (t, lead, hold, *numbers)))
    if version != VERSION or size != len(data) or not known:
        found = f"version {version}, {size} of {len(data)} bytes, status {status}"
        wanted = f"version {VERSION} of {SIZE} bytes, a known status, finite numbers"
        raise InputError("datagram", found, wanted)
    torque, torque_sd, moment, moment_sd, gravity = np.reshape(numbers, (5, 3))
    content = GravityTorque(t, lead, torque, torque_sd, moment, moment_sd, gravity,
                            TorqueStatus(status))  # fmt: skip
    return Datagram(sequence, host_time_ns, hold, content)


def replaces(found: Datagram, last: Datagram | None, age: float) -> bool:
    """Say whether a receiver should act on a datagram from now on, in the place of the last.

    It has to be usable, and to come after the last: by its sequence number, across the end of its
    32 bits. Once the last (``age`` s) holds no more, the sender may have restarted: any will do.
    """
    if found.content.status is not TorqueStatus.USABLE:
        return False
    if last is None or age > last.hold:
        return True
    return 0 < (found.sequence - last.sequence) % 2**32 < 2**31


def weight_at(age: float, hold: float) -> float:
    """Return the share (0 to 1) to act on at an age (s): all while it holds, then less and less.

    w = min(1, max(0, 1 - (age - hold) / FADE)). The age counts from the arrival of the last usable
    datagram, on the receiver's own clock.
    """
    return min(1.0, max(0.0, 1.0 - (age - hold) / FADE))
