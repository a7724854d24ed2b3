"""An emulated six-axis Trinamic module (TMCM-6212, speeds in microsteps/s) with TMCL in binary.

Written from the firmware manuals' chapters on the binary format, the commands and the axis
parameters, independently of the driver. Ways are straight and of constant speed, without ramps; but
a motor that is stopped goes as far as its ramp would take it. The module boots at once, which is
harder to notice than a slow boot. It receives nothing until it has answered: of two requests sent
at once the second is lost.
"""

import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from equipoise.hardware.boards.axis_letters import check_letters
from equipoise.hardware.emulated.device import Leg
from equipoise.model.hardware import Axis, MotorBoard
from equipoise.model.testbed import SlidingMass

MODULE, HOST, MOTORS = 1, 2, 6
OK, CHECKSUM, COMMAND, TYPE, VALUE = 100, 1, 2, 3, 4
LENGTH = 9
TYPED, VERSION = 6212, 0x010B
RIGHT, LEFT = 10, 11
SEARCH_RIGHT = 65  # a reference search for the right end switch; 1 is the left one


@dataclass(slots=True)
class Motor:
    """A motor; places are microsteps from its end switch, the counter shows them less an offset."""

    stored: dict[int, int]  # axis parameters as after a reset
    axis: Axis | None = None  # None: no mass hangs on it
    begin: float = 0.0
    to: float = 0.0
    start: float = 0.0  # s
    end: float = 0.0  # s
    offset: float = 0.0
    searching: bool = False
    pressed: set[int] = field(default_factory=set[int])
    now: dict[int, int] = field(default_factory=dict[int, int])

    def place(self, t: float) -> float:
        """Return where it is."""
        if t >= self.end:
            return self.to
        return self.begin + (t - self.start) / (self.end - self.start) * (self.to - self.begin)


class EmulatedTmcl:
    """The firmware and its motors."""

    def __init__(self, board: MotorBoard, masses: Sequence[SlidingMass]) -> None:
        check_letters(board, "012345", "a Trinamic module numbers its motors")
        by_name = {mass.name: mass for mass in masses}
        self._motors = [Motor({4: 2000, 5: 51200} | _COMMON) for _ in range(MOTORS)]
        for axis in board.axes:
            motor = self._motors[int(axis.letter)]
            motor.axis, motor.stored = axis, _set_with_care(axis, by_name[axis.mass])
            # Masses stand at home when the power comes on, wherever the module counts that to be.
            motor.begin = motor.to = axis.zero * axis.steps_per_m
        self._legs: list[Leg] = []
        self._input, self._now = b"", 0.0
        self._variables: dict[int, int] = {}
        self.powered = True
        self._boot()

    # --- The protocol of emulated boards -----------------------------------------------------

    def take(self, data: bytes, t: float) -> bytes:
        """Return what it answers at once."""
        self._run(t)
        if not self.powered:
            return b""
        self._input += data
        if len(self._input) < LENGTH:
            return b""
        request, self._input = self._input[:LENGTH], b""
        module, command, type_, motor, value, check = struct.unpack(">BBBBiB", request)
        if module != MODULE:
            return b""
        good = sum(request[:-1]) % 256 == check
        status, said = self._obey(command, type_, motor, value) if good else (CHECKSUM, 0)
        reply = struct.pack(">BBBBI", HOST, MODULE, status, command, said % 2**32)
        return reply + bytes([sum(reply) % 256])

    def run(self, t: float) -> tuple[bytes, Sequence[Leg]]:
        """Let time pass; it says nothing that it was not asked."""
        self._run(t)
        legs, self._legs = self._legs, []
        return b"", legs

    @property
    def homing(self) -> bool:
        """Say whether masses are on their way to their switches."""
        return any(motor.searching for motor in self._motors)

    # --- What people do to it ----------------------------------------------------------------

    def press_reset(self) -> None:
        """Let it restart."""
        self._boot()

    def switch(self, on: bool) -> None:
        """Switch the power; without it masses stand where they are."""
        self._boot()
        self.powered = on

    def hit_limit(self) -> None:
        """Push the switch ahead of each motor that goes."""
        for motor in self._motors:
            if self._now < motor.end:
                motor.pressed.add(RIGHT if motor.to > motor.begin else LEFT)
                self._stand(motor)

    # --- Commands ----------------------------------------------------------------------------

    def _obey(self, command: int, type_: int, bank: int, value: int) -> tuple[int, int]:
        """Return a status and a value."""
        if command == 136:
            return (OK, TYPED << 16 | VERSION) if type_ == 1 else (TYPE, 0)
        if command in (9, 10):
            return self._variable(command, type_, bank, value)
        if bank >= MOTORS:
            return (VALUE, 0) if command in (3, 4, 5, 6, 13) else (COMMAND, 0)
        motor = self._motors[bank]
        commands: dict[int, Callable[[], tuple[int, int]]] = {
            3: lambda: self._stop(motor),
            4: lambda: self._move(motor, type_, value),
            5: lambda: self._set(motor, type_, value),
            6: lambda: self._get(motor, type_),
            13: lambda: self._search(motor, type_),
        }
        return commands.get(command, lambda: (COMMAND, 0))()

    def _variable(self, command: int, type_: int, bank: int, value: int) -> tuple[int, int]:
        if bank != 2:
            return VALUE, 0
        if command == 9:
            self._variables[type_] = value
        return OK, self._variables.get(type_, 0)

    def _stop(self, motor: Motor) -> tuple[int, int]:
        """Let it go on as far and for as long as its ramp would: v^2 / 2 a at v / 2."""
        if self._now < motor.end:
            speed = abs(motor.to - motor.begin) / (motor.end - motor.start)
            slowed = min(speed**2 / (2 * motor.now[5]), speed * (motor.end - self._now))
            way = slowed if motor.to > motor.begin else -slowed
            self._lead(motor, motor.place(self._now) + way, max(1, round(speed / 2)))
        return OK, 0

    def _move(self, motor: Motor, type_: int, value: int) -> tuple[int, int]:
        if type_ not in (0, 1):
            return TYPE, 0
        counted = value if type_ == 0 else motor.place(self._now) - motor.offset + value
        self._lead(motor, counted + motor.offset, motor.now[4])
        return OK, value

    def _set(self, motor: Motor, type_: int, value: int) -> tuple[int, int]:
        if type_ == 1:
            motor.offset = motor.place(self._now) - value
        elif type_ in motor.now and value >= 0:
            motor.now[type_] = value
        else:
            return (VALUE if type_ in motor.now else TYPE), 0
        return OK, value

    def _get(self, motor: Motor, type_: int) -> tuple[int, int]:
        going = self._now < motor.end
        way = (motor.to > motor.begin) - (motor.to < motor.begin)
        observed = {
            0: round(motor.to - motor.offset),
            1: round(motor.place(self._now) - motor.offset),
            3: way * motor.now[4] * going,
            8: int(not going),
            9: 0,
            RIGHT: int(RIGHT in motor.pressed),
            LEFT: int(LEFT in motor.pressed),
        } | motor.now
        return (OK, observed[type_]) if type_ in observed else (TYPE, 0)

    def _search(self, motor: Motor, type_: int) -> tuple[int, int]:
        if type_ == 0:
            motor.pressed.clear()
            self._lead(motor, 0.0, motor.now[194])
            motor.searching = True
        elif type_ == 1 and motor.searching:
            self._stand(motor)
        return (OK, int(motor.searching)) if type_ in (0, 1, 2) else (TYPE, 0)

    # --- Motors ------------------------------------------------------------------------------

    def _run(self, t: float) -> None:
        self._now = max(t, self._now)
        for motor in self._motors:
            if motor.searching and self._now >= motor.end:
                motor.searching, motor.offset = False, motor.to

    def _lead(self, motor: Motor, to: float, speed: int) -> None:
        """Send a motor straight to a place; a switch that is pushed ahead of it holds it."""
        at = motor.place(self._now)
        motor.searching = False
        if to != at and (RIGHT if to > at else LEFT) in motor.pressed:
            to = at
        motor.begin, motor.to, motor.start = at, to, self._now
        motor.end = self._now + abs(to - at) / speed
        if motor.axis is not None:
            displacement = _displacement(motor.axis, to)
            self._legs.append(Leg(motor.axis.mass, motor.start, motor.end, displacement))

    def _stand(self, motor: Motor) -> None:
        self._lead(motor, motor.place(self._now), 1)

    def _boot(self) -> None:
        self._input, self._variables = b"", {}
        for motor in self._motors:
            self._stand(motor)
            motor.pressed.clear()
            motor.now, motor.offset = dict(motor.stored), motor.to


def _displacement(axis: Axis, place: float) -> float:
    sign = -1.0 if axis.reversed else 1.0
    return sign * (place / axis.steps_per_m - axis.zero)


_COMMON = {6: 128, 7: 8, 12: 0, 13: 0, 140: 8, 193: 1, 194: 2000, 195: 500, 255: 1}


def _set_with_care(axis: Axis, mass: SlidingMass) -> dict[int, int]:
    """Return what a careful person would have stored for a mass."""
    speed = round(mass.speed * axis.steps_per_m)
    sign = -1.0 if axis.reversed else 1.0
    below = axis.zero + sign * sum(mass.travel) / 2 < 0  # the travel is left of the switch
    own = {4: speed // 2, 5: 20 * speed, 193: SEARCH_RIGHT if below else 1, 194: speed}
    return _COMMON | own
