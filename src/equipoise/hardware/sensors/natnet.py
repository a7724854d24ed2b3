"""OptiTrack Motive by NatNet 3.0 to 4.x: the attitude of a rigid body, datagram by datagram.

    port = "udp:239.255.42.99:1511"      Motive's multicast group, as it is set by default
    port = "udpout:192.168.1.5:1510"     Motive's own address, for unicast

Quaternions turn the body's axes, as they were when it was made in Motive, into the streamed
laboratory: ``y_up`` unless Motive is set to Z up. A frame in which the body was not tracked
repeats what it was: it is no row. Rows bear Motive's frame number and its time. The mean error is
one of markers, in metres, and no sd of the attitude: that would need to know where they are.

See ``natnet_packet`` for the bytes. They are parsed here, since the library of that name reads
numbers of the computer's own size (wrong on Windows) and fills the memory for a wrong count.
"""

import math
from collections.abc import Mapping, Sequence

from equipoise.hardware.sensors import natnet_packet as natnet
from equipoise.hardware.sensors.attitudes import unit_row
from equipoise.hardware.sensors.settings import Settings, check_gives
from equipoise.hardware.transport.conversation import SensorDriver
from equipoise.model.hardware import SensorUnit
from equipoise.model.reading import Reading

BEAT = 1.0  # s, chosen: between signs of life; Motive forgets who has been silent for long
UNIT = 1e-3  # chosen: a quaternion of single precision is of length one well within this
UNICAST = "udpout:"
GREETING = "a greeting"


class NatNet(SensorDriver):
    """The conversation; setting: ``body``, a rigid body's streaming id or its name."""

    def __init__(self, unit: SensorUnit) -> None:
        settings = Settings(unit, ("body",))
        check_gives(unit, ["attitude"], '"attitude" alone: NatNet sends no rate')
        self._unicast = unit.port.address.startswith(UNICAST)
        self._name, self._id = _body(unit, settings, self._unicast)
        self._wanted = f"the rigid body '{self._name}'"
        names = {self._wanted: natnet.packet(natnet.REQUEST_NAMES, b"\0")} if self._name else {}
        greeting = {GREETING: natnet.packet(natnet.CONNECT, b"Ping\0")} if self._unicast else {}
        super().__init__(greeting | names, one_by_one=True)
        self._next, self._answered = float("-inf"), False

    def opened(self) -> None:
        """Restart; a body may have another id by now."""
        super().opened()
        self._next, self._answered = float("-inf"), False
        if self._name:
            self._id = None

    def due(self, t: float) -> bytes:
        """Return a greeting each second, and when it is answered a question or a sign of life.

        A Motive that has been silent since the last one may have restarted, and is greeted again.
        """
        beat = self._unicast and t >= self._next
        if beat:
            self._next = t + BEAT
            if not self._answered:
                self.requests.reopen(GREETING)
            self._answered = False
        said = super().due(t)
        return said or (natnet.packet(natnet.ALIVE, b"\0") if beat else b"")

    def feed(self, data: bytes) -> Sequence[Reading]:
        """Return the row of a datagram."""
        try:
            kind, payload = natnet.opened(data)
            readings = self._readings(kind, payload)
        except natnet.BrokenPacket:
            return self.counted([])
        self.count(good=readings is not None, foreign=readings is None)
        return readings or []

    def _readings(self, kind: int, payload: bytes) -> list[Reading] | None:
        """Return the row of a frame; None if a packet is of no use."""
        self._answered = True
        self.requests.confirmed(GREETING)
        if kind == natnet.SERVER:
            return []
        if kind == natnet.NAMES and self._name:
            self._named(natnet.names_of(payload))
            return []
        if kind != natnet.FRAME:
            return None
        frame = natnet.frame_of(payload)
        body = next((body for body in frame.bodies if body.id == self._id), None)
        if body is None or not body.tracked:
            return None
        x, y, z, w = body.turn
        turn = unit_row((w, x, y, z), UNIT)
        if turn is None or not math.isfinite(frame.stamp):
            raise natnet.BrokenPacket
        return [Reading("attitude", turn, frame.stamp, frame.number)]

    def _named(self, bodies: Mapping[str, int]) -> None:
        self._id = bodies.get(self._name)
        if self._id is None:
            self.requests.refused(f"rigid bodies {', '.join(bodies) or 'none'}", self._wanted)
        else:
            self.requests.confirmed(self._wanted)


def _body(unit: SensorUnit, settings: Settings, requests: bool) -> tuple[str, int | None]:
    """Return the name or the id of the body; a name needs somebody to ask for its id."""
    if not isinstance(unit.settings.get("body", 0.0), str):
        number = settings.positive("body")
        if number is None or number != int(number):
            raise settings.wrong(f"body {number}", "a rigid body's streaming id, or its name")
        return "", int(number)
    name = settings.text("body")
    if not requests:
        wanted = "its streaming id, or a port udpout:HOST:1510 that can be asked for names"
        raise settings.wrong(f"body '{name}' at {unit.port.address}", wanted)
    return name, None
