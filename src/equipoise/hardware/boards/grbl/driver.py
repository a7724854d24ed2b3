"""Grbl 1.1 and its kin, the usual firmware of stepper boards; G-code over a serial line or TCP.

Masses move by jogs, $J=G53 G21 G90 X.. F.., in machine coordinates: a jog beyond the travel is
refused and locks nothing, and a cancel throws away what is queued. One leg is sent when less than
a leg is left of what was sent before.

    displacement = position - zero, or the negative of it where the axis is reversed

A jog that arrives while the one before ends may turn into state Run, in which jogs are refused
(error:8): the next leg then waits for Idle. How a halt ends is in ``halt``.

A board that has just been opened is reset: what it did before is over, and it must home. A reset
while it stands keeps its position. Masses without switches are put at home by a person, whose
word is ``home``. Source: Grbl 1.1 wiki, "Interface", "Jogging", "Configuration".
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from equipoise.hardware.boards.axis_letters import check_letters
from equipoise.hardware.boards.grbl.codes import IDLE_ERROR, alarm_text, error_text
from equipoise.hardware.boards.grbl.halt import Halting, Wish
from equipoise.hardware.boards.grbl.lateness import too_late
from equipoise.hardware.boards.grbl.lines import step_command
from equipoise.hardware.boards.grbl.place import Place
from equipoise.hardware.boards.grbl.report import (
    Code,
    Greeting,
    MachineState,
    Report,
    Setting,
    Status,
    Word,
)
from equipoise.hardware.boards.grbl.route import Route
from equipoise.hardware.boards.grbl.settings import (
    LETTERS,
    disagreement,
    late_to_stop,
    longest_homing,
)
from equipoise.hardware.boards.grbl.states import LOST, POLLS, QUIET, TAKES_LEGS, WAYS_OUT
from equipoise.hardware.boards.grbl.suspension import Suspension
from equipoise.hardware.boards.grbl.talk import CANCEL, HOLD, HOMING, RESUME, GrblTalk, Step
from equipoise.hardware.transport.driver_protocol import (
    POLL,
    BoardDriver,
    BoardState,
    Phase,
)
from equipoise.model.hardware import Axis, MotorBoard
from equipoise.model.reasons.board_faults import BoardFault
from equipoise.model.reasons.reason import Number, Reason
from equipoise.model.testbed import SlidingMass


class Grbl(BoardDriver):
    """The conversation with one board."""

    def __init__(self, board: MotorBoard, masses: Sequence[SlidingMass]) -> None:
        super().__init__(board)
        check_letters(board, LETTERS, "Grbl names its axes")
        self._masses = tuple(masses)
        self._speed = {mass.name: mass.speed for mass in masses}
        self._axes: tuple[Axis, ...] = board.axes
        self._talk = GrblTalk(self)
        self._begin()

    def _begin(self) -> None:
        self._settings: dict[int, float] = {}
        self._place = Place()
        self._route = Route(self._speed)
        self._halt = Halting(None)
        self._changed = float("-inf")  # s, of the last thing that only later reports show
        self._since = self._talk.clock.now  # s, attended, when what it is waited for began
        self._nudged = False
        self._suspension = Suspension()

    def opened(self, t: float) -> None:
        """Restart, with a reset."""
        self._talk.begin()
        self._begin()
        self.state = BoardState(Phase.CONNECTING)

    def closed(self, why: str) -> None:
        """Note that the port is gone."""
        self._fault(BoardFault.PORT_GONE, why, lost=True)

    def feed(self, data: bytes, t: float) -> None:
        """Take in what has arrived."""
        for report in self._talk.reports(data, t):
            self._received(report, t)

    def due(self, t: float) -> bytes:
        """Return what to send now."""
        self._talk.clock.turn(t)
        self._watch()
        if self.state.phase in (Phase.MOVING, Phase.HOMING) and self.state.goal:
            self._leg(t)
        return self._talk.due(t, POLLS.get(self.state.phase, POLL))

    def home(self, t: float) -> None:
        """Find the position, then go to displacement zero; reset it first if it may not listen."""
        status = self._talk.status
        listens = self.state.phase is Phase.READY and status is not None and status.state in QUIET
        self._talk.queue.drop()
        self._most_speed = math.inf
        if not listens:
            self._talk.reset()
        self._request_settings()
        self.state = BoardState(Phase.HOMING, reported=self.state.reported)
        self._route.begin({}, t)
        self._wait_from(t)

    def halt(self, t: float) -> None:
        """Stop at once, slowing down in order; a homing is broken off by a reset."""
        if self.state.phase is Phase.HOMING:
            self._fault(BoardFault.HOMING_BROKEN, lost=True)
            self._talk.reset()
        elif self.state.phase is Phase.MOVING:
            status = self._talk.status
            running = status is not None and status.state is MachineState.RUN
            self._talk.urge(HOLD if running else CANCEL)
            self._halt = Halting(None if status is None else status.feed)
            self.state = replace(self.state, phase=Phase.HALTED)
            self._wait_from(t)

    @property
    def remarks(self) -> list[Reason]:
        """What its settings make worse than it need be."""
        return late_to_stop(self._board, self._masses, self._settings)

    # --- What it says ------------------------------------------------------------------------

    def _received(self, report: Report, t: float) -> None:
        if isinstance(report, Status):
            self._placed(report)
            self._judge(report, t)
        elif isinstance(report, Setting):
            self._settings[report.number] = report.value
        elif isinstance(report, Code):
            self._trouble(report, t)
        elif isinstance(report, Greeting):
            self._greeted(report, t)
        elif report is Word.OK:
            self._taken(t)

    def _greeted(self, greeting: Greeting, t: float) -> None:
        phase = self.state.phase
        if greeting.old and phase is not Phase.FAULT:
            self._fault(BoardFault.OUTDATED, f"'{greeting.text}'", lost=True)
        elif phase is Phase.CONNECTING or (phase is Phase.READY and not self.state.sure):
            self._talk.queue.clear()  # opening a port may reset it twice
            self._request_settings()
            self.state = BoardState(Phase.CONNECTING, reported=t)
        elif self._talk.expected:
            self._halt.begun_anew()
        elif phase is Phase.FAULT:
            self.state = replace(self.state, sure=False)
        else:
            self._fault(BoardFault.BEGAN_ANEW, f"'{greeting.text}'", lost=True)
        self._wait_from(t)

    def _request_settings(self) -> None:
        self._settings = {}
        self._talk.queue.put([step_command(Step.SETTINGS)])

    def _trouble(self, code: Code, t: float) -> None:
        if code.alarm:
            if self._alarming:
                text = alarm_text(code.number)
                self._fault(BoardFault.ALARM, text, lost=True, number=code.number)
            return
        waited_from = self._since
        refused = self._answered(t)
        if refused is Step.LEG and code.number == IDLE_ERROR:
            self._route.refused, self._since = True, waited_from  # no mass goes on by that
        elif refused is not None and not (refused is Step.LEG and self.state.phase is Phase.HALTED):
            text = f"{error_text(code.number)} (error:{code.number} to {refused})"
            self._fault(BoardFault.REFUSED, text, lost=refused is not Step.LEG)

    @property
    def _alarming(self) -> bool:
        """Say whether an alarm is news: not that of a reset, nor of a board that must home."""
        return self.state.sure or bool(self.state.goal) or self._talk.homing

    def _taken(self, t: float) -> None:
        """Note that the line under way was taken."""
        step = self._answered(t)
        if step is Step.LEG and self.state.phase is Phase.HALTED:
            self._talk.urge(CANCEL)  # it may have been taken after the first
        if step is Step.HOME:  # a board that still homes answers no line: an ok too many is found
            self._talk.queue.put([step_command(Step.HOMED, longest_homing(self._settings))])
        if step is not Step.SETTINGS:
            return
        wrong = disagreement(self._board, self._masses, self._settings)
        if wrong:
            self._fault(BoardFault.DISAGREES, wrong, lost=True)
        elif self.state.phase is Phase.CONNECTING:
            self.state = replace(self.state, phase=Phase.READY)
        elif self.state.phase is Phase.HOMING and self._board.homing:
            longest = longest_homing(self._settings)
            self._talk.queue.put([step_command(Step.HOME, longest)])
        elif self.state.phase is Phase.HOMING:
            self._talk.queue.put([step_command(Step.UNLOCK)])

    def _answered(self, t: float) -> Step | None:
        command = self._talk.queue.answered()
        if command is None:
            return None
        self._wait_from(t)
        if command.purpose in HOMING:
            self._talk.void_queries()  # it may have heard no question meanwhile
        return command.purpose

    def _placed(self, status: Status) -> None:
        """Take over where masses are."""
        standing = self.state.phase is Phase.READY and self.state.sure
        arrived = self._talk.arrived
        if not self._place.take(self._axes, status, arrived, standing):
            self.count(corrupt=1)
        elif self._place.at:
            if self.state.phase is not Phase.HALTED and self._place.at != self.state.position:
                self._since = self._talk.clock.now  # a way goes on
            self.state = replace(self.state, position=self._place.at, reported=arrived)

    # --- What it means -----------------------------------------------------------------------

    def _judge(self, status: Status, t: float) -> None:
        """Draw a conclusion from a report that was asked for after what was done last."""
        phase = self.state.phase
        if self._talk.queried <= self._changed or phase in (Phase.CONNECTING, Phase.FAULT):
            return
        if phase is Phase.HALTED:
            self._slow_down(status, t)
        elif not self._talk.queue.over and not self.state.goal:  # it homes
            return
        elif status.state in WAYS_OUT and (self.state.sure or phase is not Phase.READY):
            self._locked(status)
        elif phase is Phase.HOMING and not self.state.goal:
            self._found(status)
        elif phase is not Phase.READY and status.state is MachineState.IDLE:
            self._arrived(t)

    def _slow_down(self, status: Status, t: float) -> None:
        moved = self._place.moved_by_reset()
        if moved is not None:
            name, before, now = moved
            self._fault(BoardFault.MOVED, name, lost=True, before=before, now=now)
            return
        wish = self._halt.wish(status, self._talk.queue.over)
        if wish is Wish.STANDS:
            self.state = replace(self.state, phase=Phase.READY, goal=dict(self.state.position))
        elif wish is Wish.SYNC:
            self._talk.queue.put([step_command(Step.SYNC)])
        elif wish is Wish.RESET:
            self._reset_standing()
        elif wish in (Wish.CANCEL, Wish.HOLD):
            self._talk.urge(CANCEL if wish is Wish.CANCEL else HOLD)
            self._changed = t
        elif wish is Wish.WRONG:
            self._locked(status)

    def _reset_standing(self) -> None:
        """Reset a board that stands: what it holds is thrown away, its position is kept."""
        self._place.hold()
        self._talk.reset()

    def _found(self, status: Status) -> None:
        """Begin the way to displacement zero once the board says where it is after homing."""
        if status.state is not MachineState.IDLE or not self.state.position:
            return
        home = dict.fromkeys(self.state.position, 0.0)
        if not self._board.homing:
            self._axes = tuple(
                replace(axis, zero=axis.position(self.state.position[axis.mass]))
                for axis in self._axes
            )
            self.state = replace(self.state, position=home)
        self._aim(home, self._talk.arrived)

    def _arrived(self, t: float) -> None:
        """Let a way end where the board stands, all legs sent and taken."""
        if self._route.refused:
            self._route.begin(self.state.position, t)
        position, goal = self.state.position, self.state.goal
        stood = self._talk.arrived - max(self._place.still, self._changed)
        if self._talk.queue.over and self._route.is_over(self._axes, position, goal, stood):
            self.state = replace(self.state, phase=Phase.READY, sure=True)

    # --- What is sent ------------------------------------------------------------------------

    def _aim(self, goal: Mapping[str, float], t: float) -> None:
        """Take up a goal; legs are sent from where the last ones end."""
        if self.state.phase is Phase.READY or not self._route.sent:
            self._route.begin(self.state.position, t)
            self._since = self._talk.clock.now
        self._route.slow_down(self._most_speed)
        phase = Phase.HOMING if self.state.phase is Phase.HOMING else Phase.MOVING
        whole = {name: goal.get(name, at) for name, at in self._route.sent.items()}
        self.state = replace(self.state, phase=phase, goal=whole)

    def _leg(self, t: float) -> None:
        """Send the next leg when little is left of those before."""
        status = self._talk.status
        if status is None or status.state not in TAKES_LEGS or not self._talk.queue.over:
            return
        leg = self._route.following(self._axes, self.state.position, self.state.goal, t)
        if leg is not None:
            self._talk.queue.put([leg])

    # --- Time and trouble --------------------------------------------------------------------

    def _wait_from(self, t: float) -> None:
        """Note that something was done that only later reports show."""
        self._changed, self._since, self._nudged = t, self._talk.clock.now, False

    def _watch(self) -> None:
        """Notice what does not come about in time."""
        late = too_late(self._talk, self.state.phase, self._since)
        if late is not None:
            self._stop(late.fault, late.lost)
            if late.reset:
                self._talk.reset()
        elif self._suspension.there(self._talk) and not self._nudged:
            self._nudge()

    def _nudge(self) -> None:
        """Free it; after a halt by a reset, since a line of before would be carried out else."""
        self._nudged = True
        if self.state.phase is Phase.HALTED:
            self._reset_standing()
        else:
            self._talk.urge(RESUME)

    def _locked(self, status: Status) -> None:
        lost = status.state in LOST
        self._fault(BoardFault.LOCKED, status.state, WAYS_OUT[status.state], lost=lost)

    def _fault(self, code: BoardFault, *names: str, lost: bool, **numbers: Number) -> None:
        self._stop(Reason(code, names, numbers), lost)

    def _stop(self, fault: Reason, lost: bool) -> None:
        self._talk.queue.drop()
        sure = self.state.sure and not lost
        self.state = replace(self.state, phase=Phase.FAULT, fault=fault, sure=sure)
        if not lost:
            self._talk.urge(CANCEL)
