"""An emulated Grbl 1.1h: settings, status, jogs, homing, holds, alarms, a planner with a delay.

Written from the wiki's "Interface", "Jogging" and "Configuration", independently of the driver.
Ways are straight and of constant speed; a block that is queued behind another begins when that
ends. Only jogs and homing move: other G-code is answered with ok or an error and does nothing.
"""

import re
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

from equipoise.hardware.boards.axis_letters import check_letters
from equipoise.hardware.emulated.device import Leg
from equipoise.model.hardware import Axis, MotorBoard
from equipoise.model.testbed import SlidingMass
from equipoise.model.units import MINUTE, MM

LETTERS = "XYZABC"
LINE = 80  # characters that a line may have
DELAY = 0.02  # s, chosen: from a command to the first step, as a planner needs
HOMING = 3.0  # s, chosen: for all axes to find their switches
PULL_OFF = 1.0  # mm, $27's default: where an axis stands after homing
WELCOME = b"\r\nGrbl 1.1h ['$' for help]\r\n"
LOCKED = b"[MSG:'$H'|'$X' to unlock]\r\n"
JOG = re.compile(r"\$J=((?:[GXYZABCF][-+]?\d*\.?\d+)+)")
WORD = re.compile(r"([GXYZABCF])([-+]?\d*\.?\d+)")


@dataclass(frozen=True, slots=True)
class Block:
    """A way in the planner."""

    start: float  # s
    end: float  # s
    begin: tuple[float, ...]  # mm, machine
    to: tuple[float, ...]  # mm, machine


class EmulatedGrbl:
    """The firmware and its motors."""

    def __init__(self, board: MotorBoard, masses: Sequence[SlidingMass]) -> None:
        check_letters(board, LETTERS, "Grbl names its axes")
        self._axes = board.axes
        self._count = max(3, *(LETTERS.index(axis.letter) + 1 for axis in board.axes))
        self._settings = _defaults(board, masses, self._count)
        self._input, self._said = b"", b""
        # Masses stand at home when the power comes on, wherever the board counts that to be.
        self._at = self._place({axis.mass: 0.0 for axis in board.axes})
        self._blocks: deque[Block] = deque()
        self._legs: list[Leg] = []
        self._now = 0.0
        self._state, self._homed_at = "Alarm" if board.homing else "Idle", float("inf")
        self.powered = True
        self._begun = False

    # --- The protocol of emulated boards -----------------------------------------------------

    def take(self, data: bytes, t: float) -> bytes:
        """Return what it answers at once."""
        self._run(t)
        if not self.powered:
            return b""
        for byte in data:
            self._byte(bytes([byte]))
        return self._flushed()

    def run(self, t: float) -> tuple[bytes, Sequence[Leg]]:
        """Let time pass."""
        if self.powered and not self._begun:
            self._begun = True
            self._say(WELCOME + (LOCKED if self._state == "Alarm" else b""))
        self._run(t)
        legs, self._legs = self._legs, []
        return self._flushed(), legs

    @property
    def homing(self) -> bool:
        """Say whether masses are on their way to their switches."""
        return self._state == "Home"

    # --- What people do to it ----------------------------------------------------------------

    def press_reset(self) -> None:
        """Press the button on the board."""
        self._reset()

    def switch(self, on: bool) -> None:
        """Switch the power; without it masses stand where they are."""
        self._stand()
        self._input, self._said, self.powered, self._begun = b"", b"", on, False
        self._state = "Alarm" if self._settings[22] else "Idle"

    def hit_limit(self) -> None:
        """Push a limit switch."""
        self._stand()
        self._state = "Alarm"
        self._say(b"ALARM:1\r\n" + LOCKED)

    # --- Bytes -------------------------------------------------------------------------------

    def _byte(self, byte: bytes) -> None:
        at_once = {
            b"?": self._report_status,
            b"!": self._hold,
            b"~": self._resume,
            b"\x85": self._cancel,
        }
        if byte == b"\x18":
            self._reset()
        elif byte in at_once:
            if self._state != "Home":  # it takes nothing but a reset while it homes
                at_once[byte]()
        elif byte in (b"\n", b"\r"):
            line, self._input = self._input, b""
            self._line(line.decode("ascii", "replace").upper().replace(" ", ""))
        elif len(self._input) <= LINE:
            self._input += byte

    def _line(self, line: str) -> None:
        if len(line) > LINE:
            self._say(b"error:11\r\n")
        elif line.startswith("$J="):
            self._jog(line)
        elif line == "$$":
            text = "".join(f"${k}={v:g}\r\n" for k, v in sorted(self._settings.items()))
            self._say(text.encode() + b"ok\r\n")
        elif line == "$X":
            self._state = "Idle" if self._state == "Alarm" else self._state
            self._say(b"[MSG:Caution: Unlocked]\r\nok\r\n")
        elif line == "$H":
            self._home()
        elif line.startswith("$"):
            self._say(b"error:3\r\n")
        else:
            self._say(b"error:9\r\n" if self._state == "Alarm" and line else b"ok\r\n")

    def _jog(self, line: str) -> None:
        match = JOG.fullmatch(line)
        words = WORD.findall(match[1]) if match else []
        modes = {float(value) for letter, value in words if letter == "G"}
        values = {letter: float(value) for letter, value in words if letter != "G"}
        if self._state not in ("Idle", "Jog"):
            self._say(b"error:9\r\n" if self._state == "Alarm" else b"error:8\r\n")
        elif not match or "F" not in values or modes - {21.0, 53.0, 90.0, 91.0}:
            self._say(b"error:16\r\n" if not match else b"error:22\r\n")
        elif any(letter not in LETTERS[: self._count] for letter in values if letter != "F"):
            self._say(b"error:20\r\n")
        else:
            self._queue(values, relative=91.0 in modes)

    def _queue(self, values: dict[str, float], relative: bool) -> None:
        begin = self._blocks[-1].to if self._blocks else self._at
        to = list(begin)
        for letter, value in values.items():
            if letter != "F":
                k = LETTERS.index(letter)
                to[k] = begin[k] + value if relative else value
                if self._settings[20] and not -self._settings[130 + k] <= to[k] <= 0:
                    self._say(b"error:15\r\n")
                    return
        # No axis goes faster than its setting, whatever the speed of the whole.
        way = [abs(b - a) for a, b in zip(begin, to, strict=True)]
        length = sum(step**2 for step in way) ** 0.5
        needs = [MINUTE * step / self._settings[110 + k] for k, step in enumerate(way)]
        taken = max([MINUTE * length / values["F"], *needs])
        start = self._blocks[-1].end if self._blocks else self._now + DELAY
        self._blocks.append(Block(start, start + taken, begin, tuple(to)))
        self._lead_masses(self._blocks[-1])
        self._state = "Jog"
        self._say(b"ok\r\n")

    def _home(self) -> None:
        if not self._settings[22]:
            self._say(b"error:5\r\n")
        elif self._state in ("Idle", "Alarm"):
            self._state, self._homed_at = "Home", self._now + HOMING
            place = tuple(-PULL_OFF for _ in range(self._count))
            for axis in self._axes:
                goal = self._displacement(axis, place)
                self._legs.append(Leg(axis.mass, self._now, self._homed_at, goal))
        else:
            self._say(b"error:8\r\n")

    # --- Time --------------------------------------------------------------------------------

    def _run(self, t: float) -> None:
        self._now = max(t, self._now)
        if not self.powered:
            return
        if self._state == "Home" and t >= self._homed_at:
            self._at = tuple(-PULL_OFF for _ in range(self._count))
            self._state, self._homed_at = "Idle", float("inf")
            self._say(b"ok\r\n")
        while self._blocks and self._blocks[0].end <= t:
            self._at = self._blocks.popleft().to
            if not self._blocks and self._state == "Jog":
                self._state = "Idle"

    def _where(self) -> tuple[float, ...]:
        """Return where the axes are now, mm."""
        if not self._blocks or self._now <= self._blocks[0].start:
            return self._at
        block = self._blocks[0]
        share = (self._now - block.start) / (block.end - block.start)
        pairs = zip(block.begin, block.to, strict=True)
        return tuple(a + min(share, 1.0) * (b - a) for a, b in pairs)

    def _lead_masses(self, block: Block) -> None:
        for axis in self._axes:
            k = LETTERS.index(axis.letter)
            if block.to[k] != block.begin[k]:
                goal = self._displacement(axis, block.to)
                self._legs.append(Leg(axis.mass, block.start, block.end, goal))

    def _stand(self) -> None:
        """Halt every axis where it is, and forget what was queued."""
        self._at = self._where()
        self._blocks.clear()
        for axis in self._axes:
            at = self._displacement(axis, self._at)
            self._legs.append(Leg(axis.mass, self._now, self._now, at))

    def _hold(self) -> None:
        """Throw a jog away; a board that stands is on hold."""
        if self._state == "Jog":
            self._cancel()
        elif self._state == "Idle":
            self._state = "Hold"

    def _resume(self) -> None:
        if self._state == "Hold":
            self._state = "Idle"

    def _cancel(self) -> None:
        if self._state == "Jog":
            self._stand()
            self._state = "Idle"

    def _reset(self) -> None:
        moving = bool(self._blocks) or self._state == "Home"
        locked = self._state == "Alarm"
        self._stand()
        self._input, self._homed_at = b"", float("inf")
        if moving:
            self._say(b"ALARM:%d\r\n" % (6 if self._state == "Home" else 3))
        self._state = "Alarm" if moving or locked else "Idle"
        self._say(WELCOME + (LOCKED if self._state == "Alarm" else b""))

    def _report_status(self) -> None:
        state = "Hold:0" if self._state == "Hold" else self._state
        place = ",".join(f"{value:.3f}" for value in self._where())
        self._say(f"<{state}|MPos:{place}|FS:0,0>\r\n".encode())

    def _displacement(self, axis: Axis, place: Sequence[float]) -> float:
        sign = -1.0 if axis.reversed else 1.0
        return sign * (place[LETTERS.index(axis.letter)] * MM - axis.zero)

    def _place(self, displacement: dict[str, float]) -> tuple[float, ...]:
        place = [0.0] * self._count
        for axis in self._axes:
            sign = -1.0 if axis.reversed else 1.0
            place[LETTERS.index(axis.letter)] = (axis.zero + sign * displacement[axis.mass]) / MM
        return tuple(place)

    def _say(self, data: bytes) -> None:
        self._said += data

    def _flushed(self) -> bytes:
        said, self._said = self._said, b""
        return said


def _defaults(board: MotorBoard, masses: Sequence[SlidingMass], count: int) -> dict[int, float]:
    """Return settings that a careful person would have made for these masses."""
    settings: dict[int, float] = {0: 10, 10: 1, 13: 0, 20: 0, 21: 0, 22: 0, 27: PULL_OFF}
    for k in range(count):
        settings |= {100 + k: 250.0, 110 + k: 500.0, 120 + k: 10.0, 130 + k: 200.0}
    by_name = {mass.name: mass for mass in masses}
    for axis in board.axes:
        k, mass = LETTERS.index(axis.letter), by_name[axis.mass]
        settings[100 + k] = axis.steps_per_m * MM
        settings[110 + k] = mass.speed * MINUTE / MM
    if board.homing:
        settings |= {20: 1, 22: 1}
    return settings
