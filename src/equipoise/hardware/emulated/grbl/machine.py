"""The machine of an emulated Grbl 1.1h: time, bytes that act at once, states, motors.

Bytes that act at once (? ! ~ 0x85 0x18) are taken whenever they come and set flags; the main loop
looks at the flags and then takes one line, and does neither while it prints more than its buffer
holds, writes a setting, homes, is suspended, or waits $1 ms for its motors after each way. After a
cancelled jog it waits so twice: once when the motors stand, once when it has thrown away its
queue, and still says Jog. A cancel in the second wait finds it idle and suspends it.

A limit switch leaves a board that takes nothing but a reset. A reset in motion loses steps.
Written from the wiki's "Interface", "Jogging", "Configuration" and the published firmware's
behaviour, independently of the driver. Only jogs and homing move; other G-code is answered and
does nothing.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence

from equipoise.hardware.boards.axis_letters import check_letters
from equipoise.hardware.emulated.device import Leg
from equipoise.hardware.emulated.grbl.defaults import careful_settings
from equipoise.hardware.emulated.grbl.motion import LETTERS, Motion
from equipoise.hardware.emulated.grbl.states import Flag, State, Suspended
from equipoise.hardware.emulated.serial_line import BITS
from equipoise.model.arrays import Floats
from equipoise.model.hardware import MotorBoard
from equipoise.model.testbed import SlidingMass
from equipoise.model.units import MINUTE

TAKEN, PRINTED = 128, 104  # bytes: the buffers of what comes and what goes
BOOT = 0.8  # s, chosen: the loader of an Arduino takes half a second to two
NEVER = 255  # of $1: motors stay on, nothing is waited for
CHATTER = b"\xf8\x00ets boot\r\n"  # chosen: what a loader may say
WELCOME = b"\r\nGrbl 1.1h ['$' for help]\r\n"
LOCKED = b"[MSG:'$H'|'$X' to unlock]\r\n"
OFFSET_EVERY = 10  # reports, of which one has the offset of the work


class GrblMachine(ABC):
    """The firmware without its lines, and its motors."""

    def __init__(self, board: MotorBoard, masses: Sequence[SlidingMass]) -> None:
        check_letters(board, LETTERS, "Grbl names its axes")
        count = max(3, *(LETTERS.index(axis.letter) + 1 for axis in board.axes))
        self.settings = careful_settings(board, masses, count)
        self.motion = Motion(board.axes, count, self.settings)
        self._byte = BITS / board.port.baud  # s
        self._now, self._said = 0.0, b""
        self.powered = False
        self.switch(True)

    # --- The protocol of emulated boards -----------------------------------------------------

    def take(self, data: bytes, t: float) -> bytes:
        """Take bytes as they come; return what it says at once."""
        self._advance(t)
        for value in data:
            if self.powered and self._booted:
                self._received(bytes([value]))
                self._main()
        return self._flushed()

    def run(self, t: float) -> tuple[bytes, Sequence[Leg]]:
        """Let time pass."""
        self._advance(t)
        return self._flushed(), self.motion.legs()

    @property
    def homing(self) -> bool:
        """Say whether masses are on their way to their switches."""
        return self._state is State.HOME

    # --- What people do to it ----------------------------------------------------------------

    def press_reset(self) -> None:
        """Press the button of the firmware's reset."""
        self._reset()

    def switch(self, on: bool) -> None:
        """Switch the power; without it masses stand where they are, and it counts from there."""
        if self.powered:
            self.motion.stopped_dead(self._now)
        self.powered, self._booted = on, False
        self._boots_at = self._now + BOOT if on else float("inf")
        self._said = b""
        self._state = State.ALARM if self.settings[22] else State.IDLE
        self._cleared()
        if on:
            self.motion.switched_on()
            self._say(CHATTER)

    def hit_limit(self) -> None:
        """Push a limit switch: everything stops dead."""
        self.motion.stopped_dead(self._now)
        self._state, self._critical = State.ALARM, True
        self._say(b"ALARM:1\r\n[MSG:Reset to continue]\r\n")

    def open_door(self, is_open: bool) -> None:
        """Open the safety door, or close it."""
        self._ajar = is_open
        if is_open:
            self._flags.add(Flag.DOOR)
            self._main()

    # --- Time --------------------------------------------------------------------------------

    def _advance(self, t: float) -> None:
        """Let everything happen that is due until t s, in order."""
        while self.powered and (event := min(self._boots_at, self._free_at, self.motion.end)) <= t:
            self._now = max(self._now, event)
            if event == self._boots_at:
                self._boots_at, self._booted = float("inf"), True
                self._greet()
            elif event == self.motion.end:
                self._motors_stand()
            else:
                self._free_at = float("inf")
            self._main()
        self._now = max(self._now, t)

    def _motors_stand(self) -> None:
        self.motion.ended()
        if self._state is State.HOME:
            self._state, self._then = State.IDLE, self._homed
            self._report_if_queried(State.HOME)
        else:
            self._flags.add(Flag.STOPPED)
        self._wait_for_motors()

    def _homed(self) -> None:
        self._say(b"ok\r\n")

    def _wait_for_motors(self) -> None:
        """Wait $1 ms; nothing is looked at meanwhile."""
        if self.settings[1] != NEVER:
            self._busy(self.settings[1] / 1000)

    def _busy(self, seconds: float) -> None:
        already = self._free_at if self._free_at < float("inf") else self._now
        self._free_at = max(already, self._now + seconds)

    # --- Bytes -------------------------------------------------------------------------------

    def _received(self, byte: bytes) -> None:
        if byte == b"\x18":
            self._reset()
        elif byte == b"?":
            self._flags.add(Flag.REPORT)
        elif byte == b"!":
            self._flags.add(Flag.HOLD)
        elif byte == b"~":
            self._flags.add(Flag.START)
        elif byte == b"\x85":
            if self._state is State.JOG:
                self._flags.add(Flag.CANCEL)
        elif byte < b"\x80" and len(self._taken) < TAKEN and self._now >= self._deaf_until:
            self._taken += byte

    def _main(self) -> None:
        """Go round the main loop until it waits for something."""
        while self._booted and not self._critical and self._now < self._free_at == float("inf"):
            then, self._then = self._then, None
            if then is not None:
                then()
                continue
            if self._state is State.HOME:
                return
            self._execute_flags()
            if self._free_at < float("inf") or self._then is not None:
                continue
            if self._suspended:
                return
            if self.late and self._state is State.IDLE:
                self._run_late()
            line, end, rest = self._taken.replace(b"\r", b"\n").partition(b"\n")
            if not end:
                return
            self._taken = rest
            self._line(line.decode("ascii", "replace").upper().replace(" ", ""))

    def _run_late(self) -> None:
        """Start what a jog has queued while the one before ended: not as a jog."""
        late, self.late = self.late, []
        for to, feed in late:
            if self.motion.queue(to, feed, self._now):
                self._state = State.RUN

    # --- Flags -------------------------------------------------------------------------------

    def _execute_flags(self) -> None:
        self._report_if_queried(self._state)
        holds = self._flags & {Flag.HOLD, Flag.CANCEL, Flag.DOOR, Flag.SLEEP}
        if holds:
            self._hold(holds)
        if Flag.START in self._flags and not holds:
            self._start()
        self._flags -= {Flag.START, *holds}
        if Flag.STOPPED in self._flags:
            self._flags.discard(Flag.STOPPED)
            self._stopped()

    def _hold(self, holds: set[Flag]) -> None:
        if self._state not in (State.ALARM, State.CHECK):
            self._slow_down()
            if Flag.CANCEL in holds and self._state is not State.JOG:
                self._suspended.add(Suspended.DROPPED)
            if Flag.HOLD in holds and self._state in (State.IDLE, State.RUN):
                self._state = State.HOLD
            if Flag.DOOR in holds and Suspended.CANCELLED not in self._suspended:
                self._state = State.DOOR
        if Flag.SLEEP in holds:
            self._state = State.SLEEP
            self._suspended.add(Suspended.STANDS)

    def _slow_down(self) -> None:
        """Begin to stand; a jog is then thrown away, and a board that is idle stands already."""
        cancelling = self._suspended & {Suspended.CANCELLED, Suspended.DROPPED}
        if self._state in (State.RUN, State.JOG) and not cancelling:
            self.motion.slow_down(self._now)
            if self._state is State.JOG:
                self._suspended.add(Suspended.CANCELLED)
        if self._state is State.IDLE:
            self._suspended = {Suspended.STANDS}

    def _start(self) -> None:
        closed = self._state is State.DOOR and not self._ajar
        held = self._state is State.HOLD and Suspended.STANDS in self._suspended
        if not (closed or held or self._state is State.IDLE):
            return
        going_on = self.motion.rest and Suspended.DROPPED not in self._suspended
        self._suspended = set()
        self._state = State.RUN if going_on else State.IDLE
        if going_on:
            self.motion.resume(self._now)

    def _stopped(self) -> None:
        """Complete a hold, throw a cancelled jog away, or end a way: the motors stand."""
        held = self._state in (State.HOLD, State.DOOR, State.SLEEP)
        if held and Suspended.CANCELLED not in self._suspended:
            self._suspended.add(Suspended.STANDS)
        elif Suspended.CANCELLED in self._suspended:
            self.motion.rest, self.late = [], []
            self._wait_for_motors()
            self._then = self._idle
        else:
            self._idle()

    def _idle(self) -> None:
        self._suspended = set()
        self._state = State.DOOR if self._ajar else State.IDLE

    def _report_if_queried(self, state: State) -> None:
        if Flag.REPORT not in self._flags:
            return
        self._flags.discard(Flag.REPORT)
        self._reports += 1
        place = ",".join(f"{value:.3f}" for value in self.motion.where(self._now))
        feed = self.motion.speed(self._now) * MINUTE
        extra = "|WCO:0.000,0.000,0.000" if self._reports % OFFSET_EVERY == 1 else ""
        self._say(f"<{self._named(state)}|MPos:{place}|FS:{feed:.0f},0{extra}>\r\n".encode())

    def _named(self, state: State) -> str:
        stands = Suspended.STANDS in self._suspended
        if state is State.HOLD:
            return f"{state}:{0 if stands else 1}"
        if state is State.DOOR:
            return f"{state}:{1 if self._ajar else 0}"
        return str(state)

    @abstractmethod
    def _line(self, line: str) -> None:
        """Carry out a line and answer it."""

    # --- Beginning ---------------------------------------------------------------------------

    def _reset(self) -> None:
        """Restart; what is under way stops dead, and then the position counts as lost."""
        if not (self.powered and self._booted):
            return
        slowing = (
            self._state in (State.HOLD, State.DOOR) and Suspended.STANDS not in self._suspended
        )
        homing = self._state is State.HOME
        moving = homing or slowing or self._state in (State.RUN, State.JOG)
        if moving:
            self.motion.stopped_dead(self._now)
            self._say(b"ALARM:6\r\n" if homing else b"ALARM:3\r\n")
        locked = moving or self._state in (State.ALARM, State.SLEEP)
        self._state = State.ALARM if locked else State.IDLE
        self._cleared()
        self._greet()

    def _cleared(self) -> None:
        self._flags: set[Flag] = set()
        self._suspended: set[Suspended] = set()
        self._taken = b""
        self._critical = self._ajar = False
        self.late: list[tuple[Floats, float]] = []
        self._free_at = float("inf")
        self._deaf_until = 0.0
        self._then: Callable[[], None] | None = None
        self._reports = 0
        self.motion.rest = []

    def _greet(self) -> None:
        self._say(WELCOME + (LOCKED if self._state is State.ALARM else b""))

    def _say(self, data: bytes) -> None:
        """Print; what the buffer does not hold must be sent before anything else is done."""
        self._said += data
        if len(data) > PRINTED:
            self._busy((len(data) - PRINTED) * self._byte)

    def _flushed(self) -> bytes:
        said, self._said = self._said, b""
        return said
