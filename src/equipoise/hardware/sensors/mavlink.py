"""MAVLink 2 and 1: a flight controller with PX4 or ArduPilot, over a serial line or UDP.

    ATTITUDE_QUATERNION  id 31    time_boot_ms, q1..q4 = w x y z, body rates rad/s
    HIGHRES_IMU          id 105   time_usec, gyro rad/s

Source: MAVLink common message set (mavlink.io). The attitude is "in the aeronautical frame
(right-handed, Z-down, X-front, Y-right), expressed as quaternion", (1 0 0 0) for no turn; PX4 says
of the same numbers that they turn from the FRD body frame to the NED earth frame. So a vehicle
that has turned by psi from north to east says (cos psi/2, 0, 0, sin psi/2). Its laboratory is
``ned``.

The rate comes from one message only: HIGHRES_IMU, which is the gyro's own, while the rates beside
the attitude have been through the vehicle's filters. ``rate_from = "ATTITUDE_QUATERNION"`` is for
vehicles that have no HIGHRES_IMU. The two messages' stamps may be of different clocks (since boot,
or Unix), so each channel has its own.
"""

import math
from collections.abc import Sequence
from typing import Any

from equipoise.hardware.sensors.attitudes import unit_row
from equipoise.hardware.sensors.settings import Settings
from equipoise.hardware.transport.conversation import SensorDriver
from equipoise.model.hardware import SensorUnit
from equipoise.model.optional_libraries import extra_library
from equipoise.model.reading import Reading
from equipoise.model.units import MS, US

DIALECT = "pymavlink.dialects.v20.common"
KEYS = ("rate_hz", "rate_from")
ATTITUDE, IMU = "ATTITUDE_QUATERNION", "HIGHRES_IMU"
IDS = {ATTITUDE: 31, IMU: 105}
BEAT = 1.0  # s, between heartbeats, as the protocol wants it
STATION, PLANNER = 255, 190  # system and component of a ground station
GYRO = 0x38  # bits of HIGHRES_IMU.fields_updated: gyro x, y, z
UNIT = 1e-3  # chosen: a quaternion of single precision is of length one well within this


class Mavlink(SensorDriver):
    """The conversation; settings: ``rate_hz``, asked for if given, and ``rate_from``.

    An acknowledgement does not say which message's interval it is of. So one is asked for at a
    time, and as many acknowledgements are void as were sent again.
    """

    def __init__(self, unit: SensorUnit) -> None:
        settings = Settings(unit, KEYS)
        where = f"hardware.sensor {unit.name}"
        self._dialect = extra_library(DIALECT, where, "a MAVLink vehicle", "mavlink")
        self._hz = settings.positive("rate_hz")
        self._rate = settings.text("rate_from", IMU, (ATTITUDE, IMU))
        sources = {"attitude": ATTITUDE, "rate": self._rate}
        kinds = sorted({sources[channel] for channel in unit.gives}) if self._hz else []
        super().__init__({f"the interval of {kind}": b"" for kind in kinds}, one_by_one=True)
        self._kinds = dict(zip(self._spoken, kinds, strict=True))
        self.opened()

    def opened(self) -> None:
        """Restart."""
        super().opened()
        self._received = self._dialect.MAVLink(None)
        self._received.robust_parsing = True
        self._said = self._dialect.MAVLink(None, STATION, PLANNER)
        self._vehicle: tuple[int, int] | None = None  # system and component
        self._sent = self._void = 0  # requests not acknowledged; acknowledgements of no use
        self._next = float("-inf")

    def due(self, t: float) -> bytes:
        """Return a heartbeat each second, and what asks for messages until it is confirmed."""
        said = b""
        if t >= self._next:
            self._next = t + BEAT
            said = self._beat()
        if self._vehicle is None or self._hz is None:
            return said
        wanted = [IDS[self._kinds[name]] for name in self.requests.due(t)]
        self._sent += len(wanted)
        return said + b"".join(self._request(each, 1e6 / self._hz) for each in wanted)

    def feed(self, data: bytes) -> Sequence[Reading]:
        """Return the rows that are complete with these bytes."""
        messages: list[Any] = self._received.parse_buffer(data) or []
        return [reading for message in messages for reading in self._message(message)]

    def _beat(self) -> bytes:
        kinds = self._dialect
        return self._packed(
            kinds.MAVLink_heartbeat_message(
                kinds.MAV_TYPE_GCS, kinds.MAV_AUTOPILOT_INVALID, 0, 0, kinds.MAV_STATE_ACTIVE, 3
            )
        )

    def _request(self, message_id: int, microseconds: float) -> bytes:
        command = self._dialect.MAV_CMD_SET_MESSAGE_INTERVAL
        system, component = self._vehicle or (0, 0)
        return self._packed(
            self._dialect.MAVLink_command_long_message(
                system, component, command, 0, message_id, microseconds, 0, 0, 0, 0, 0
            )
        )

    def _packed(self, message: Any) -> bytes:
        data: bytes = message.pack(self._said)
        self._said.seq = (self._said.seq + 1) % 256
        return data

    def _message(self, message: Any) -> list[Reading]:
        kind: str = message.get_type()
        if kind == "BAD_DATA":
            return self.counted([])
        ours = self._of_the_vehicle(kind, message)
        return self.counted(self._readings(kind, message) if ours else None)

    def _of_the_vehicle(self, kind: str, message: Any) -> bool:
        """Say whether a message is of use and of the first vehicle received; note its answers."""
        beats = kind == "HEARTBEAT" and message.autopilot != self._dialect.MAV_AUTOPILOT_INVALID
        if self._vehicle is None and (beats or kind in IDS):
            self._vehicle = (message.get_srcSystem(), message.get_srcComponent())
        ours = self._vehicle is not None and message.get_srcSystem() == self._vehicle[0]
        if ours and kind == "COMMAND_ACK":
            self._acknowledged(message)
        return ours and kind in IDS

    def _acknowledged(self, message: Any) -> None:
        """Credit an acknowledgement to the request that was sent last, unless it is void."""
        kinds, name = self._dialect, self.requests.first
        interval = message.command == kinds.MAV_CMD_SET_MESSAGE_INTERVAL
        if not interval or message.target_system not in (0, STATION):
            return
        if self._void:
            self._void -= 1
        elif name is not None and message.result != kinds.MAV_RESULT_IN_PROGRESS:
            self._void, self._sent = max(self._sent - 1, 0), 0
            if message.result == kinds.MAV_RESULT_ACCEPTED:
                self.requests.confirmed(name)
            else:
                known = kinds.enums["MAV_RESULT"].get(message.result)
                self.requests.refused(known.name if known else str(message.result), name)

    def _readings(self, kind: str, message: Any) -> list[Reading] | None:
        """Return the rows of a message; empty if it is broken, None if it holds none for us."""
        if kind == IMU:
            fresh = message.id == 0 and message.fields_updated & GYRO == GYRO
            if self._rate != IMU or not fresh:
                return None
            rate = (message.xgyro, message.ygyro, message.zgyro)
            return _rate(rate, message.time_usec * US)
        stamp = message.time_boot_ms * MS
        turn = unit_row((message.q1, message.q2, message.q3, message.q4), UNIT)
        if turn is None:
            return []
        attitude = Reading("attitude", turn, stamp)
        if self._rate != ATTITUDE:
            return [attitude]
        speeds = (message.rollspeed, message.pitchspeed, message.yawspeed)
        return [attitude, *_rate(speeds, stamp)]


def _rate(rate: tuple[float, ...], stamp: float) -> list[Reading]:
    return [Reading("rate", rate, stamp)] if all(map(math.isfinite, rate)) else []
