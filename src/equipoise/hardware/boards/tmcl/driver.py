"""Trinamic's stepper modules with TMCL firmware, in binary, over a serial line, USB or TCP.

Everything is a script of requests (``talk``). When the port opens, the driver reads the
module's version and settings, writes the speed of each mass, and sets a mark: a variable of the
working memory, which is 0 again after a reset. While masses stand or move, it repeats a round:

    targets of masses on their way, where these are, a limit switch ahead of one, the mark

A round counts only with its mark. So the driver accepts no position of a module that has
restarted, nor the end of a search that a reset broke off. Masses find their position by the
module's own reference search; those without switches stand at home when a person says so. Source:
TMCM-6110 TMCL Firmware Manual V1.31, 4.6 and chapters 5, 6.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from equipoise.hardware.boards.axis_letters import check_letters
from equipoise.hardware.boards.legs import Pacemaker
from equipoise.hardware.boards.tmcl import words as w
from equipoise.hardware.boards.tmcl.scripts import CALLED, MARK, OBSERVED, Scripts, Steps
from equipoise.hardware.boards.tmcl.settings import disagreement, guards, speed_value
from equipoise.hardware.boards.tmcl.talk import Talk
from equipoise.hardware.boards.tmcl.words import Request, requested
from equipoise.hardware.transport.driver_protocol import (
    POLL,
    POLL_MOVING,
    BoardDriver,
    BoardState,
    Phase,
)
from equipoise.model.hardware import MotorBoard
from equipoise.model.reasons.board_faults import BoardFault
from equipoise.model.reasons.reason import Number, Reason
from equipoise.model.testbed import SlidingMass

MOTORS = "012345"
LONGEST_SEARCH = 60.0  # s, chosen
SETTLED = 0.5  # s, chosen: standing for so long, a mass goes nowhere else
UNMARKED = "the mark in its memory is gone"


class Tmcl(BoardDriver):
    """The conversation with one module."""

    def __init__(self, board: MotorBoard, masses: Sequence[SlidingMass]) -> None:
        super().__init__(board)
        check_letters(board, MOTORS, "a Trinamic module numbers its motors")
        self._masses = {mass.name: mass for mass in masses}
        self._steps, self._talk = Steps(board, masses), Talk(self)
        self._scripts = Scripts(board, self._steps)
        self._names = [axis.mass for axis in board.axes]
        self._guards: dict[str, Mapping[int, int]] = {}
        self._begin(0.0)

    def _begin(self, t: float) -> None:
        self._plan: list[str] = []  # what comes before the rounds of questions
        self._doing = ""  # what the script under way is: a step of the plan, halt or round
        self._at: dict[str, int] = {}  # microsteps
        self._sent: dict[str, int] = {}  # microsteps, targets
        # The limit switch asked for in this round, by mass.
        self._requested: dict[str, Request] = {}
        self._commanded = False  # the round under way sends masses elsewhere, or does not yet
        self._pacemaker = Pacemaker()
        self._turn = 0  # whose limit switch is asked for
        self._still = self._since = self._next = t  # s
        self._calls = 0  # for the version, until it was answered
        self._mute = False  # it was silent; nothing is said until somebody wants it

    def opened(self, t: float) -> None:
        """Restart."""
        self._talk.begin()
        self._begin(t)
        self.state = BoardState(Phase.CONNECTING)
        self._plan = ["version", "settings", "mark"]

    def closed(self, why: str) -> None:
        """Note that the port is gone."""
        self._fault(BoardFault.PORT_GONE, why, silent=True)

    def feed(self, data: bytes, t: float) -> None:
        """Take in what has arrived."""
        self._talk.feed(data, t)

    def due(self, t: float) -> bytes:
        """Return what to send now."""
        self._talk.clock.turn(t)
        if self._talk.queue.overdue:
            self._unanswered()
        if self._talk.queue.over and self._doing:
            done, self._doing = self._doing, ""
            self._done(done, t)
        if self._talk.queue.over and not self._mute and t >= self._next - 1e-9:
            self._more(t)
        return self._talk.due()

    def home(self, t: float) -> None:
        """Find the position, then go to displacement zero."""
        if self._mute:
            self._talk.give_up()
        counts = self.state.reported
        self._most_speed = math.inf
        self._begin(t)
        self._talk.say([])
        self.state = BoardState(Phase.HOMING, position=self.state.position, reported=counts)
        find = ["search", "searched"] if self._board.homing else ["place"]
        self._plan = ["version", "stop", "stopped", "settings", "mark", *find]

    def halt(self, t: float) -> None:
        """Stop every mass, slowing down in order; a reference search is broken off."""
        if self.state.phase is Phase.HOMING:
            self._fault(BoardFault.HOMING_BROKEN)
        elif self.state.phase is Phase.MOVING:
            self.state = replace(self.state, phase=Phase.HALTED)
            self._say("halt", self._scripts.each(w.MST), t)

    # --- Scripts -----------------------------------------------------------------------------

    def _more(self, t: float) -> None:
        """Say the next step of the plan, or ask another round."""
        doing = self._plan[0] if self._plan else "round"
        if doing == "version":
            self._doing = doing
            self._talk.call(CALLED, shifted=self._calls > 0)
            self._calls += 1
            return
        script = self._round(t) if doing == "round" else self._scripts.step(doing)
        self._say(doing, script, t)

    def _say(self, doing: str, script: Sequence[Request], t: float) -> None:
        quick = self.state.phase in (Phase.MOVING, Phase.HOMING, Phase.HALTED)
        self._doing, self._next = doing, t + (POLL_MOVING if quick else POLL)
        self._talk.say(script)

    def _round(self, t: float) -> Sequence[Request]:
        """Return a round of questions, with the targets of masses on their way before them."""
        self._commanded = False
        if self.state.phase in (Phase.READY, Phase.FAULT):
            return [*self._scripts.each(w.GAP, w.AT), OBSERVED]
        if self.state.phase is Phase.HALTED or not self.state.goal:
            return [*self._scripts.each(w.GAP, w.SPEED), *self._scripts.each(w.GAP, w.AT), OBSERVED]
        going = self._going
        targets = self._targets(going, t)
        commands = [
            Request(w.MVP, w.ABSOLUTE, self._steps.motor(k), target)
            for k, target in targets.items()
            if self._sent.get(k) != target
        ]
        self._sent |= targets
        self._commanded = bool(commands)
        requested = [Request(w.GAP, w.AT, self._steps.motor(k)) for k in going]
        slowed = self._scripts.slowed(self._most_speed) if going else ()
        return [*slowed, *commands, *requested, *self._switch_ahead(going), OBSERVED]

    def _targets(self, going: Sequence[str], t: float) -> Mapping[str, int]:
        """Return where to send masses on their way now, microsteps."""
        goal, most, steps = self.state.goal, self._most_speed, self._steps
        ends = {k: float(steps.steps(k, goal[k])) for k in goal}
        led = self._pacemaker.led(ends, {k: steps.pace(k, most) for k in goal}, t)
        return {k: steps.target(k, self._at[k], led[k], goal[k], most) for k in going}

    def _switch_ahead(self, going: Sequence[str]) -> Sequence[Request]:
        """Return the question for the limit switch ahead of one mass, the next in turn."""
        self._requested = {}
        if going:
            self._turn += 1
            name = going[self._turn % len(going)]
            switch = self._guards[name].get(1 if self._sent[name] > self._at[name] else -1)
            if switch is not None:
                self._requested = {name: Request(w.GAP, switch, self._steps.motor(name))}
        return list(self._requested.values())

    @property
    def _going(self) -> Sequence[str]:
        """Masses that are not where they are to go, or were last sent elsewhere."""
        ends = {k: self._steps.steps(k, goal) for k, goal in self.state.goal.items()}
        return [k for k in self._names if not self._at[k] == self._sent.get(k, ends[k]) == ends[k]]

    # --- What was answered -------------------------------------------------------------------

    def _done(self, step: str, t: float) -> None:
        """Draw the conclusion from a script that was answered."""
        refused = self._talk.refused
        self._scripts.answered(self._talk.answers)
        if step == "version" and refused and self._calls < w.SIZE:
            return  # it is called again, another part of a datagram later
        if self.state.phase is not Phase.FAULT and refused and step != "settings":
            self._fault(BoardFault.REFUSED, refused)
        elif step == "round":
            self._rounded(t)
        elif step in self._plan and self._concluded(step, t):
            self._plan.remove(step)
            self._since, self._next = t, t
            if not self._plan and self.state.phase is Phase.CONNECTING:
                self.state = replace(self.state, phase=Phase.HALTED)

    def _concluded(self, step: str, t: float) -> bool:
        """Say whether a step of the plan is done, and need not be said again."""
        if step == "settings":
            return self._agreed()
        if step == "stopped":
            return not any(a.value for a in self._talk.answers.values())
        if step != "searched":
            return True
        if any(a.value for a in self._talk.answers.values()):
            if t - self._since > LONGEST_SEARCH:
                self._search_long(t)
            return False
        return True

    def _agreed(self) -> bool:
        masses, answers = list(self._masses.values()), self._talk.answers
        wrong = disagreement(self._board, masses, answers)
        if wrong:
            self._fault(BoardFault.DISAGREES, wrong)
            return False
        self._guards = {k: guards(axis, answers) for k, axis in self._steps.axes.items()}
        self._scripts.speeds = {
            k: speed_value(axis, self._masses[k], answers) for k, axis in self._steps.axes.items()
        }
        return True

    def _rounded(self, t: float) -> None:
        """Take over the positions of a round."""
        if self._talk.value(OBSERVED) != MARK:
            if self.state.phase is not Phase.FAULT:
                self._fault(BoardFault.BEGAN_ANEW, UNMARKED)
            return
        commands = {
            k: self._talk.value(Request(w.GAP, w.AT, self._steps.motor(k))) for k in self._names
        }
        at = self._at | {k: value for k, value in commands.items() if value is not None}
        if at != self._at or self._commanded:
            self._still = t
        self._at = at
        position = {k: self._steps.displacement(k, value) for k, value in at.items()}
        self.state = replace(
            self.state, position=position, reported=self._talk.middle(w.GAP, w.AT, t)
        )
        self._settle(t)

    def _settle(self, t: float) -> None:
        """Let a way or a halt end when masses stand; a way that meets a switch is a fault."""
        state = self.state
        hit = [name for name, q in self._requested.items() if self._talk.value(q)]
        if state.phase in (Phase.MOVING, Phase.HOMING) and state.goal:
            if hit:
                self._fault(BoardFault.SWITCH_HIT, hit[0])
            elif not self._going or t - self._still > SETTLED + self._two_steps:
                self.state = replace(state, phase=Phase.READY, sure=True)
        elif state.phase is Phase.HOMING:
            self._aim(dict.fromkeys(self._names, 0.0), t)
        elif state.phase is Phase.HALTED:
            speeds = [self._talk.value(q) for q in self._scripts.each(w.GAP, w.SPEED)]
            if speeds and not any(speeds):
                self.state = replace(state, phase=Phase.READY, goal=dict(state.position))

    @property
    def _two_steps(self) -> float:
        """How long the slowest of the masses on their way takes for two steps, s."""
        return 2.0 / min(self._steps.pace(name, self._most_speed) for name in self._going)

    def _aim(self, goal: Mapping[str, float], t: float) -> None:
        """Take up a goal."""
        if self.state.phase is not Phase.MOVING:
            self._sent, self._requested = dict(self._at), {}
            self._pacemaker.begin(self._at, t)
        phase = Phase.HOMING if self.state.phase is Phase.HOMING else Phase.MOVING
        whole = {name: goal.get(name, self.state.position[name]) for name in self._names}
        self.state = replace(self.state, phase=phase, goal=whole)
        self._still = self._next = t
        self._commanded = True  # the round under way does not know of it

    # --- Trouble -----------------------------------------------------------------------------

    def _unanswered(self) -> None:
        pending, waited = self._talk.queue.pending, self._talk.queue.waited
        text, ago = self._talk.last_received
        self._talk.give_up()
        doing, self._doing = self._doing, ""
        if doing == "version" and self._calls < w.SIZE:
            return  # it is called again
        if self.state.phase is not Phase.CONNECTING:
            query = "a request" if pending is None else requested(pending.purpose)
            numbers = {"waited": waited, "ago": ago}
            self._fault(BoardFault.SILENT, query, text, silent=True, numbers=numbers)
        elif text == "nothing":
            self._fault(BoardFault.NOTHING_RECEIVED, silent=True, numbers={"waited": ago})
        else:
            self._fault(BoardFault.NOT_ITS_KIND, "TMCL", text, silent=True)

    def _search_long(self, t: float) -> None:
        text, ago = self._talk.last_received
        numbers = {"waited": t - self._since, "ago": ago}
        self._fault(BoardFault.HOMING_LONG, text, numbers=numbers)

    def _fault(
        self,
        code: BoardFault,
        *names: str,
        silent: bool = False,
        numbers: Mapping[str, Number] | None = None,
    ) -> None:
        """Stop, if requests still reach the module; nothing moves until it has homed."""
        self._plan, self._doing, self._mute = [], "", silent
        if self.state.phase is not Phase.FAULT:
            fault = Reason(code, names, numbers or {})
            self.state = replace(self.state, phase=Phase.FAULT, fault=fault, sure=False)
        if silent:
            self._talk.give_up()
        else:
            self._doing = "halt"
            self._talk.say([*self._scripts.each(w.RFS, w.STOP), *self._scripts.each(w.MST)])
