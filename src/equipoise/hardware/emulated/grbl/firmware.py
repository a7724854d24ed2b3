"""An emulated Grbl 1.1h, as slow and as strict as the real one: the lines that it takes.

Written from the wiki's "Interface", "Jogging", "Configuration" and the published firmware's
behaviour, independently of the driver. Only jogs and homing move; other G-code is answered and
does nothing. What acts at once, and when no line is taken, is in ``machine``.
"""

import re
from collections.abc import Callable

from equipoise.hardware.emulated.grbl.defaults import homing_takes, shown
from equipoise.hardware.emulated.grbl.machine import GrblMachine
from equipoise.hardware.emulated.grbl.motion import LETTERS
from equipoise.hardware.emulated.grbl.states import Flag, State
from equipoise.model.units import MINUTE

LINE = 79  # characters that a line may have
WRITING = 0.02  # s, chosen: to store a setting; what arrives meanwhile is lost
LATE = 0.05  # mm of the way before that a jog may find left, and run instead of jog
JOG = re.compile(r"\$J=((?:[GXYZABCF][-+]?\d*\.?\d+)+)")
WORD = re.compile(r"([GXYZABCF])([-+]?\d*\.?\d+)")
SET = re.compile(r"\$(\d{1,3})=([-+]?\d*\.?\d+)")


class EmulatedGrbl(GrblMachine):
    """The firmware and its motors."""

    def _line(self, line: str) -> None:
        self._say(self._answer(line))

    def _answer(self, line: str) -> bytes:
        if len(line) > LINE:
            return b"error:11\r\n"
        if not line:
            return b"ok\r\n"
        system: dict[str, Callable[[], bytes]] = {
            "$$": self._list, "$X": self._unlock, "$H": self._home, "$C": self._check,
            "$SLP": self._sleep,
        }  # fmt: skip
        if line in system:
            return system[line]()
        if line.startswith("$J"):
            return self._jog(line)
        if line.startswith("$"):
            return self._set(line)
        return b"error:9\r\n" if self._state in (State.ALARM, State.JOG) else b"ok\r\n"

    def _list(self) -> bytes:
        if self._state in (State.RUN, State.HOLD):
            return b"error:8\r\n"
        text = "".join(f"${k}={shown(k, v)}\r\n" for k, v in sorted(self.settings.items()))
        return text.encode() + b"ok\r\n"

    def _unlock(self) -> bytes:
        if self._state is not State.ALARM:
            return b"ok\r\n"
        self._state = State.IDLE
        return b"[MSG:Caution: Unlocked]\r\nok\r\n"

    def _check(self) -> bytes:
        if self._state is State.CHECK:
            self._reset()
            return b""
        if self._state is not State.IDLE:
            return b"error:8\r\n"
        self._state = State.CHECK
        return b"[MSG:Enabled]\r\nok\r\n"

    def _sleep(self) -> bytes:
        if self._state not in (State.IDLE, State.ALARM):
            return b"error:8\r\n"
        self._flags.add(Flag.SLEEP)
        return b"ok\r\n"

    def _set(self, line: str) -> bytes:
        if self._state not in (State.IDLE, State.ALARM):
            return b"error:8\r\n"
        match = SET.fullmatch(line)
        if match is None or int(match[1]) not in self.settings:
            return b"error:3\r\n"
        self.settings[int(match[1])] = float(match[2])
        self._deaf_until = self._now + WRITING
        self._busy(WRITING)
        return b"ok\r\n"

    def _home(self) -> bytes:
        if self._state not in (State.IDLE, State.ALARM):
            return b"error:8\r\n"
        if not self.settings[22]:
            return b"error:5\r\n"
        self._state = State.HOME
        taken = homing_takes(self.settings, self.motion.farthest)
        self.motion.home(self._now, taken, self.settings[27])
        return b""

    def _jog(self, line: str) -> bytes:
        if self._state not in (State.IDLE, State.JOG):
            return b"error:8\r\n"
        match = JOG.fullmatch(line)
        words = WORD.findall(match[1]) if match else []
        modes = {float(value) for letter, value in words if letter == "G"}
        values = {letter: float(value) for letter, value in words if letter != "G"}
        if match is None:
            return b"error:3\r\n" if not line.startswith("$J=") else b"error:2\r\n"
        if modes - {20.0, 21.0, 53.0, 90.0, 91.0}:
            return b"error:16\r\n"
        if "F" not in values:
            return b"error:22\r\n"
        return self._queued(values, relative=91.0 in modes)

    def _queued(self, values: dict[str, float], relative: bool) -> bytes:
        begin = self.late[-1][0] if self.late else self.motion.last
        to = begin.copy()
        for letter, value in values.items():
            if letter != "F":
                k = LETTERS.index(letter)
                if k >= len(to):
                    return b"error:20\r\n"
                to[k] = begin[k] + value if relative else value
                if self.settings[20] and not -self.settings[130 + k] <= to[k] <= 0:
                    return b"error:15\r\n"
        if values["F"] <= 0:
            return b"error:22\r\n"
        feed = values["F"] / MINUTE
        if self._state is State.JOG and self.motion.ahead(self._now) < LATE:
            self.late.append((to, feed))
        elif self.motion.queue(to, feed, self._now):
            self._state = State.JOG
        return b"ok\r\n"
