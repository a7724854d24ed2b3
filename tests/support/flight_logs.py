"""Logs of flight controllers and of a VectorNav, byte by byte from their public descriptions.

The vehicle has turned by 30 deg: north to east, or about another axis. Its gyro says (0.1, 0.2,
0.3) rad/s in FRD.
"""

import struct
from binascii import crc_hqx
from functools import reduce
from math import cos, radians, sin

from pymavlink.dialects.v20 import common

from tests.support.byte_captures import telemetry

HALF = radians(30) / 2
HEADING = (cos(HALF), 0.0, 0.0, sin(HALF))  # yaw of +30 deg, from north to east
RATE = (0.1, 0.2, 0.3)
START = 1_700_000_000.0  # s since 1970

# --- ArduPilot on board ------------------------------------------------------------------------

CODES = {"Q": "Q", "B": "B", "f": "f", "c": "h", "C": "H", "I": "I", "L": "i"}
LAYOUTS = {  # as ArduPilot declares them
    "IMU": (1, "QBffffff", "TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ"),
    "GYR": (2, "QBQfff", "TimeUS,I,SampleUS,GyrX,GyrY,GyrZ"),
    "ATT": (3, "QccccCC", "TimeUS,DesRoll,Roll,DesPitch,Pitch,DesYaw,Yaw"),
    "AHR2": (4, "QccCfLLffff", "TimeUS,Roll,Pitch,Yaw,Alt,Lat,Lng,Q1,Q2,Q3,Q4"),
    "XKQ": (5, "QBffff", "TimeUS,C,Q1,Q2,Q3,Q4"),
    "NKQ1": (6, "Qffff", "TimeUS,Q1,Q2,Q3,Q4"),
    "IMU2": (7, "Qffffff", "TimeUS,GyrX,GyrY,GyrZ,AccX,AccY,AccZ"),
    "BARO": (8, "Qff", "TimeUS,Alt,Press"),
}


def size_of(name: str) -> int:
    return 3 + struct.calcsize("<" + "".join(CODES[letter] for letter in LAYOUTS[name][1]))


def layout(number: int, length: int, name: str, letters: str, columns: str) -> bytes:
    texts = name.encode(), letters.encode(), columns.encode()
    return b"\xa3\x95\x80" + struct.pack("<BB4s16s64s", number, length, *texts)


def logged(name: str, *values: float) -> bytes:
    """Return a message of ArduPilot's."""
    number, letters, _ = LAYOUTS[name]
    codes = "".join(CODES[letter] for letter in letters)
    return bytes([0xA3, 0x95, number]) + struct.pack(f"<{codes}", *values)


def dataflash(*messages: bytes, names=tuple(LAYOUTS)) -> bytes:
    """Return a log that declares what it holds, and then holds it."""
    out = layout(0x80, 89, "FMT", "BBnNZ", "Type,Length,Name,Format,Columns")
    for name in names:
        number, letters, columns = LAYOUTS[name]
        out += layout(number, size_of(name), name, letters, columns)
    return out + b"".join(messages)


def times(count: int = 4) -> range:
    """Every 10 ms from 7 s after the start of the board, us."""
    return range(7_000_000, 7_000_000 + 10_000 * count, 10_000)


def flight(*names: str, heading=HEADING, rate=RATE, count: int = 4) -> bytes:
    """Return a log of such messages; instruments of IMU and GYR: 0 and, at twice the rate, 1."""
    made: list[bytes] = []
    for us in times(count):
        rows = {
            "IMU": [(us, i, *((1 + i) * w for w in rate), 0, 0, -9.8) for i in (0, 1)],
            "IMU2": [(us, *(2 * w for w in rate), 0, 0, -9.8)],
            "GYR": [(us + 900, i, us, *((1 + i) * w for w in rate)) for i in (0, 1)],
            "ATT": [(us, 0, 0, 0, 0, 0, 3000)],
            "AHR2": [(us, 0, 0, 3000, 1, 0, 0, *heading)],
            "XKQ": [(us, 0, *heading), (us, 1, 1, 0, 0, 0)],
            "NKQ1": [(us, *heading)],
            "BARO": [(us, 1, 2)],
        }
        made += [logged(name, *row) for name in names for row in rows[name]]
    return dataflash(*made)


# --- Telemetry ---------------------------------------------------------------------------------


class Station:
    """Packs messages as a vehicle sends them; version 1 or 2 of MAVLink."""

    def __init__(self, system: int = 1, component: int = 1, version: int = 2) -> None:
        self.link = common.MAVLink(None, system, component)
        self.old = version == 1

    def packed(self, kind: str, *values: float, **more: float) -> bytes:
        made = getattr(common, f"MAVLink_{kind}_message")(*values, **more)
        return bytes(made.pack(self.link, force_mavlink1=self.old))

    def beat(self, autopilot: int) -> bytes:
        return self.packed("heartbeat", 2, autopilot, 0, 0, 4, 3)

    def turned(self, k: int, turn=HEADING) -> bytes:
        """The k-th attitude; boot time 2 s and 20 ms each."""
        return self.packed("attitude_quaternion", 2_000 + 20 * k, *turn, 0.7, 0.8, 0.9)

    def angles(self, k: int) -> bytes:
        return self.packed("attitude", 2_000 + 20 * k, 0.0, 0.0, radians(30), 0.7, 0.8, 0.9)

    def highres(self, k: int, zero_us: int = 2_000_000, sensor: int = 0, bits: int = 0x3F) -> bytes:
        rate = tuple((1 + sensor) * w for w in RATE)
        values = (zero_us + 20_000 * k, 0, 0, -9.8, *rate, 0, 0, 0, 0, 0, 0, 20, bits)
        return self.packed("highres_imu", *values, id=sensor)

    def scaled(self, k: int, number: str = "") -> bytes:
        return self.packed(
            f"scaled_imu{number}", 2_000 + 20 * k, 0, 0, -1000, 100, 200, 300, 0, 0, 0
        )

    def raw(self, k: int) -> bytes:
        return self.packed("raw_imu", 2_000_000 + 20_000 * k, 0, 0, -1000, 100, 200, 300, 0, 0, 0)


def tlog(*rows: list[bytes], late: float = 0.0) -> bytes:
    """Return a log of what arrives every 20 ms; all but the first time ``late`` s later."""
    stamped = [
        (START + 0.02 * k + late * (k > 0), frame) for k, row in enumerate(rows) for frame in row
    ]
    return telemetry(stamped)


def flown(*kinds: str, count: int = 5, autopilot: int = 12, version: int = 2) -> bytes:
    """Return a log of a vehicle that sends such messages."""
    vehicle = Station(version=version)
    rows = [[getattr(vehicle, kind)(k) for kind in kinds] for k in range(count)]
    rows[0].insert(0, vehicle.beat(autopilot))
    return tlog(*rows)


# --- VectorNav ---------------------------------------------------------------------------------


def said(body: str, wide: bool = False) -> str:
    """Return a line of a VectorNav with its checksum."""
    data = body.encode()
    if wide:
        return f"${body}*{crc_hqx(data, 0):04X}"
    return f"${body}*{reduce(lambda a, b: a ^ b, data, 0):02X}"


TURNED_LINE = (
    f"VNQMR,+0.000000,+0.000000,{sin(HALF):+.6f},{cos(HALF):+.6f},1,0,1,0,0,-9.8,0.1,0.2,0.3"
)
ANGLES_LINE = "VNYMR,+030.000,+000.000,+000.000,1,0,1,0,0,-9.8,0.1,0.2,0.3"
VECTORNAV_LINES = {
    "VNQMR": TURNED_LINE,
    "VNYMR": ANGLES_LINE,
    "VNQTN": f"VNQTN,+0.000000,+0.000000,{sin(HALF):+.6f},{cos(HALF):+.6f}",
    "VNYPR": "VNYPR,+030.000,+000.000,+000.000",
    "VNGYR": "VNGYR,+00.100000,+00.200000,+00.300000",
}


def terminal(*kinds: str, count: int = 5, clock: str = "14:03:21.{:03d} -> ") -> str:
    """Return a terminal's log: a message of each kind every 20 ms."""
    lines = ["Connected to COM7"]
    for k in range(count):
        lines += [clock.format(20 * k) + said(VECTORNAV_LINES[kind]) for kind in kinds]
    return "\r\n".join(lines) + "\r\n"
