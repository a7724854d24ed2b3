"""An emulated flight controller: heartbeats, attitude and its IMU by MAVLink 2.

Written from the message set, independently of the driver. As on many vehicles the attitude is
stamped in time since boot, the IMU in Unix time.
"""

from collections.abc import Sequence
from typing import Any

from equipoise.hardware.emulated.device import sensed_rows
from equipoise.model.arrays import Floats
from equipoise.model.hardware import SensorUnit
from equipoise.model.optional_libraries import extra_library
from equipoise.model.recording import Recording
from equipoise.model.units import MS, US

DIALECT = "pymavlink.dialects.v20.common"
BOOTED = 20.0  # s, chosen: before the bench began
EPOCH = 1.7e9  # s, chosen: Unix time when the bench began
FILTERED = (9.0, 9.0, 9.0)  # rad/s: what a filter made of the rates, so that nobody takes them
BEAT = 1.0  # s, between heartbeats


class EmulatedMavlink:
    """System 1, component 1, as an autopilot is by default."""

    def __init__(self, unit: SensorUnit) -> None:
        self._dialect = extra_library(DIALECT, "emulate", "a MAVLink vehicle", "mavlink")
        self._unit = unit
        self._link = self._dialect.MAVLink(None, 1, 1)
        self._link.robust_parsing = True
        self._next = float("-inf")
        self.requested: dict[int, float] = {}  # message and interval in microseconds

    def take(self, data: bytes, t: float) -> bytes:
        """Return acknowledgements of commands."""
        answers: list[bytes] = []
        messages: list[Any] = self._link.parse_buffer(data) or []
        for message in messages:
            if message.get_type() == "COMMAND_LONG" and message.target_system in (0, 1):
                known = message.command == self._dialect.MAV_CMD_SET_MESSAGE_INTERVAL
                if known:
                    self.requested[int(message.param1)] = message.param2
                result = 0 if known else 3  # accepted, or not supported
                ack = self._dialect.MAVLink_command_ack_message(message.command, result)
                answers.append(self._packed(ack))
        return b"".join(answers)

    def messages(self, rows: Recording) -> Sequence[bytes]:
        """Return the messages, in order of time."""
        made = {"attitude": self._attitude, "rate": self._imu}
        return [
            self._beats(t) + self._packed(made[channel](t, row))
            for t, parts in sensed_rows(self._unit, rows)
            for channel, row in parts.items()
        ]

    def _beats(self, t: float) -> bytes:
        """Return a heartbeat when it is time for one: a quadrotor with PX4."""
        if t < self._next:
            return b""
        self._next = t + BEAT
        return self._packed(self._dialect.MAVLink_heartbeat_message(2, 12, 0, 0, 4, 3))

    def _attitude(self, t: float, q: Floats) -> Any:
        boot = round((t + BOOTED) / MS)
        return self._dialect.MAVLink_attitude_quaternion_message(boot, *map(float, q), *FILTERED)

    def _imu(self, t: float, w: Floats) -> Any:
        unix, still = round((t + EPOCH) / US), (0.0, 0.0, -9.807)
        field = (0.2, 0.0, 0.4)
        return self._dialect.MAVLink_highres_imu_message(
            unix, *still, *map(float, w), *field, 1013.0, 0.0, 100.0, 25.0, 0xFFF
        )

    def _packed(self, message: Any) -> bytes:
        data: bytes = message.pack(self._link)
        self._link.seq = (self._link.seq + 1) % 256
        return data
