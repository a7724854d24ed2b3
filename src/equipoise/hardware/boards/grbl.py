"""Grbl 1.1, the usual firmware of stepper boards; G-code over a serial line or TCP.

Masses move by jogs, $J=G53 G21 G90 X.. F.., in machine coordinates: a jog beyond the travel is
refused and locks nothing, and what is queued of it is thrown away by a hold, so that nothing goes
on by itself afterwards. One leg is sent when less than a leg is left of what was sent before.

    displacement = position - zero, or the negative of it where the axis is reversed

A board that has just been opened is reset: what it did before is over, and it must home. Masses
without switches are put at home by a person, whose word is ``home``. Source: Grbl 1.1 wiki,
"Interface", "Jogging", "Configuration".
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from equipoise.hardware.boards.axis_letters import check_letters
from equipoise.hardware.boards.grbl_report import (
    Code,
    Report,
    Setting,
    Status,
    Word,
    parsed,
    sentence_of,
)
from equipoise.hardware.boards.grbl_settings import LETTERS, disagreement
from equipoise.hardware.boards.legs import next_leg, time_left
from equipoise.hardware.transport.driver_protocol import (
    LEG,
    POLL,
    POLL_MOVING,
    SILENCE,
    BoardDriver,
    BoardState,
    Phase,
)
from equipoise.hardware.transport.line_splitter import Lines
from equipoise.model.hardware import MotorBoard
from equipoise.model.reading import Counts
from equipoise.model.testbed import SlidingMass
from equipoise.model.units import MINUTE, MM, in_si

RESET, HOLD, RESUME, CANCEL = b"\x18", b"!", b"~", b"\x85"
BEGIN = 4.0  # s, chosen: an Arduino's loader takes two of them after the port is opened
TRY = 1.5  # s, chosen: between resets while it has not begun
LONGEST_HOMING = 60.0  # s, chosen: it answers nothing meanwhile
THERE = 2e-6  # m, chosen: positions are reported to 1 um
SETTLED = 0.3  # s, chosen: standing for so long, it goes nowhere else


class Grbl(BoardDriver):
    """The conversation with one board."""

    def __init__(self, board: MotorBoard, masses: Sequence[SlidingMass]) -> None:
        super().__init__(board)
        check_letters(board, LETTERS, "Grbl names its axes")
        self._masses = tuple(masses)
        self._speed = {mass.name: mass.speed for mass in masses}
        self._lines = Lines()
        self._axes = {axis.mass: axis for axis in board.axes}
        self._begin(0.0)

    def _begin(self, t: float) -> None:
        self._settings: dict[int, float] = {}
        self._offset: tuple[float, ...] | None = None
        self._urgent = b""  # to be sent before anything else
        self._todo: list[str] = []  # of finding the position: settings, home, zero
        self._awaited = ""  # what the next ok is for
        self._sent: dict[str, float] = {}  # m, where the legs sent so far end
        self._since, self._tried, self._requested = t, t, t
        self._still = t  # s, since when it says that it stands
        self._said = ""  # its last state

    def opened(self, t: float) -> None:
        """Begin anew, with a reset."""
        self._lines.cleared()
        self.counts = Counts()
        self._begin(t)
        self.state = BoardState("connecting")
        self._urgent = RESET

    def closed(self, why: str) -> None:
        """Note that the port is gone."""
        self._fault(f"its port is gone ({why}): unplugged, or without power", lost=True)

    def feed(self, data: bytes, t: float) -> None:
        """Take in what has arrived."""
        for line in self._lines.cut(data):
            report = parsed(line)
            self.count(good=report is not None, corrupt=report is None)
            if report is not None:
                self._received(report, t)

    def due(self, t: float) -> bytes:
        """Return what to send now."""
        self._watch(t)
        said, self._urgent = self._urgent, b""
        if self.state.phase != "connecting" and t - self._requested >= self._pause - 1e-9:
            self._requested = t
            said += b"?"
        return said + self._next(t)

    def home(self, t: float) -> None:
        """Find the position, then go to displacement zero."""
        self.state = BoardState("homing", reported=self.state.reported)
        self._todo = ["settings", "home" if self._board.homing else "unlock", "zero"]
        self._awaited, self._sent, self._since = "", {}, t

    def halt(self, t: float) -> None:
        """Stop at once, slowing down in order; a homing is broken off by a reset."""
        if self.state.phase == "homing":
            self._urgent = RESET
            self._fault("homing was broken off", lost=True)
        elif self.state.phase == "moving":
            self._urgent = HOLD + CANCEL
            self.state = replace(self.state, phase="halted")
            self._still = t

    # --- What it says ------------------------------------------------------------------------

    def _received(self, report: Report, t: float) -> None:
        if isinstance(report, Status):
            self._status(report, t)
        elif isinstance(report, Setting):
            self._settings[report.number] = report.value
        elif isinstance(report, Code):
            self._trouble(report)
        elif report is Word.OK:
            self._taken(t)
        elif report is Word.WELCOME:
            self._welcomed(t)

    def _welcomed(self, t: float) -> None:
        nothing_lost = self.state.phase in ("halted", "ready") and not self.state.sure
        if self.state.phase == "connecting" or nothing_lost:  # opening a port may reset it twice
            self._todo, self._awaited, self._since = ["settings"], "", t
            self.state = replace(self.state, phase="halted", reported=t)
        elif self.state.phase != "fault":
            self._fault("it began anew: its power failed or somebody reset it", lost=True)

    def _trouble(self, code: Code) -> None:
        if code.alarm or self._awaited:
            lost = code.alarm or self._awaited != "leg"
            self._fault(sentence_of(code.alarm, code.number), lost)

    def _taken(self, t: float) -> None:
        """Note that the line under way was taken."""
        done, self._awaited = self._awaited, ""
        if done == "settings":
            wrong = disagreement(self._board, self._masses, self._settings)
            if wrong:
                self._fault(f"{wrong}; mend one of the two", lost=True)
            elif self.state.phase == "halted":
                self.state = replace(self.state, phase="ready")
        self._since = t

    def _status(self, status: Status, t: float) -> None:
        self._offset = status.offset or self._offset
        machine = status.machine
        if machine is None and status.work is not None and self._offset is not None:
            machine = tuple(a + b for a, b in zip(status.work, self._offset, strict=False))
        if status.state != self._said:
            self._said, self._still = status.state, t
        if machine is None:
            self.state = replace(self.state, reported=t)
            return
        columns = {mass: LETTERS.index(axis.letter) for mass, axis in self._axes.items()}
        if max(columns.values()) >= len(machine):  # the line lost a part: Grbl reports every axis
            self.count(corrupt=1)
            return
        position = {
            mass: self._axes[mass].displacement(in_si(machine[k], MM))
            for mass, k in columns.items()
        }
        self.state = replace(self.state, position=position, reported=t)
        self._settle(t)

    def _settle(self, t: float) -> None:
        """Let a way or a halt end when the board stands."""
        state = self.state
        if self._said == "Hold" and state.phase in ("halted", "ready"):
            self._urgent = RESUME  # what it held was a jog, which is thrown away
        if self._awaited or self._said != "Idle" or self._todo:
            return
        if state.phase == "halted" and t - self._still >= POLL and self._settings:
            self.state = replace(state, phase="ready", goal=dict(state.position))
        elif state.phase in ("moving", "homing") and state.goal and self._sent == state.goal:
            there = max(abs(state.position[k] - v) for k, v in state.goal.items()) <= THERE
            if there or t - max(self._still, self._since) > SETTLED:
                self.state = replace(state, phase="ready", sure=True)

    # --- What is sent ------------------------------------------------------------------------

    def _next(self, t: float) -> bytes:
        """Return the next line, one at a time."""
        phase = self.state.phase
        if self._awaited or phase in ("connecting", "fault"):
            return b""
        if self._todo:
            return self._seek(t)
        if phase in ("moving", "homing"):
            return self._leg(t)
        return self._stop_again(t)

    def _seek(self, t: float) -> bytes:
        """Return the next step of finding the position."""
        step = self._todo[0]
        if step == "zero":
            return self._found(t)
        self._todo.pop(0)
        self._awaited, self._since = step, t
        if step == "settings":
            self._settings = {}
        return {"settings": b"$$\n", "home": b"$H\n", "unlock": b"$X\n"}[step]

    def _found(self, t: float) -> bytes:
        """Begin the way to displacement zero once the board says where it is after homing."""
        if self._said not in ("Idle", "Alarm") or (self.state.reported or 0.0) <= self._since:
            return b""
        if not self.state.position or self._said == "Alarm":
            return b""
        self._todo.pop(0)
        if not self._board.homing:
            self._axes = {
                mass: replace(axis, zero=axis.position(self.state.position[mass]))
                for mass, axis in self._axes.items()
            }
            position = dict.fromkeys(self.state.position, 0.0)
            self.state = replace(self.state, position=position)
        self._aim(dict.fromkeys(self.state.position, 0.0), t)
        return b""

    def _aim(self, goal: Mapping[str, float], t: float) -> None:
        """Take up a goal; legs are sent from where the last ones end."""
        if self.state.phase == "ready" or not self._sent:
            self._sent = dict(self.state.position)
        phase: Phase = "homing" if self.state.phase == "homing" else "moving"
        whole = {name: goal.get(name, at) for name, at in self._sent.items()}
        self.state = replace(self.state, phase=phase, goal=whole)

    def _leg(self, t: float) -> bytes:
        """Return the next leg when little is left of those before."""
        if time_left(self.state.position, self._sent, self._speed) > LEG:
            return b""
        way = next_leg(self._sent, self.state.goal, self._speed)
        if way is None:
            self._sent = dict(self.state.goal)
            return b""
        words, square = "", 0.0
        for axis in self._axes.values():
            if axis.mass in way.to:
                words += f" {axis.letter}{axis.position(way.to[axis.mass]) / MM:.4f}"
                square += ((way.to[axis.mass] - self._sent[axis.mass]) / MM) ** 2
        feed = max(square**0.5 / way.duration * MINUTE, 1.0)
        self._sent = {**self._sent, **way.to}
        self._awaited, self._since = "leg", t
        return f"$J=G53 G21 G90{words} F{feed:.2f}\n".encode()

    def _stop_again(self, t: float) -> bytes:
        """Cancel a leg, too, that was on its way to the board when the hold was sent."""
        again = self.state.phase == "halted" and self._said in ("Jog", "Run")
        return CANCEL if again and t - self._still > POLL else b""

    # --- Time and trouble --------------------------------------------------------------------

    @property
    def _pause(self) -> float:
        return POLL_MOVING if self.state.phase in ("moving", "homing", "halted") else POLL

    def _watch(self, t: float) -> None:
        """Notice a board that says nothing."""
        if self.state.phase == "connecting":
            if t - self._since > BEGIN:
                self._fault("it does not answer: unplugged, without power, or no Grbl", lost=True)
            elif t - self._tried > TRY:
                self._tried, self._urgent = t, RESET
            return
        if self.state.phase == "fault":
            return
        patience = LONGEST_HOMING if self._awaited == "home" else SILENCE
        received = max(self.state.reported or 0.0, self._since)
        if t - received > patience:
            self._fault("it does not answer: unplugged, or without power", lost=True)

    def _fault(self, sentence: str, lost: bool) -> None:
        self._todo, self._awaited = [], ""
        sure = self.state.sure and not lost
        self.state = replace(self.state, phase="fault", sentence=sentence, sure=sure)
        if not lost:
            self._urgent = CANCEL
