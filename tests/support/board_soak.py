"""Random cycles of a board's life: what comes of each, judged by where masses really are.

A cycle is one of: move, move and move again, creep, halt in mid-move, home, the board's reset, its
power, its plug, a pause of the host. Then the board must be ready, and where it says that it is; or
at fault in words that the cycle explains, and ready again after homing.
"""

from dataclasses import dataclass, field
from functools import partial

import numpy as np

from equipoise.app.bench.emulation import ahead_of
from equipoise.hardware.boards.registry import BOARDS
from equipoise.hardware.emulated.registry import emulated_board
from equipoise.hardware.transport.driver_protocol import LEG, Phase
from equipoise.model.reasons.board_faults import BoardFault
from equipoise.model.units import MM, UM
from tests.support.board_wire import BED, along, board_of
from tests.support.nasty_line import NastyLine, PlainLine

NEAR = 3e-6  # m: half a step, and the last digit of a report
STOPS = 0.2  # s, after a halt
SPEED = 8 * MM  # of each mass of the preset
LOST = {BoardFault.PORT_GONE, BoardFault.SILENT, BoardFault.BEGAN_ANEW, BoardFault.ALARM,
        BoardFault.LOCKED, BoardFault.SWITCH_HIT, BoardFault.HOMING_BROKEN,
        BoardFault.NOT_BEGUN}  # fmt: skip


@dataclass
class Tally:
    """What became of the cycles."""

    cycles: int = 0
    stuck: list = field(default_factory=list)
    false: list = field(default_factory=list)  # positions
    blamed: list = field(default_factory=list)  # faults that nothing explains
    late: list = field(default_factory=list)  # halts after which masses went on
    homed: int = 0  # recoveries that needed it
    halts: list = field(default_factory=list)  # s, until masses stood


def steady(_rng):
    """Draw the turns of a computer that has nothing else to do, s."""
    return 0.002


def busy(rng):
    """Draw the turns of one whose cores are all at work: some ms, now and then a tenth of a s."""
    hung = rng.uniform(0, 0.1) if rng.random() < 0.01 else 0.0
    return float(0.001 + rng.exponential(0.008) + hung)


# s: latency of a radio bridge; a module of one request at a time takes five times as long with it
LATENCY = {"grbl": 0.25, "tmcl": 0.04}
TWICE = {"grbl": 0.01, "tmcl": 0.0}  # of what a board says; datagrams are no lines
LINES = {"steady": (steady, 0.0), "busy": (busy, 0.1), "nasty": (busy, 1.0)}


def soak(kind, how, seed):
    """Return a board behind a line of a kind, and a host that looks when it can."""
    turn, slack = LINES[how]
    line = partial(NastyLine, latency=LATENCY[kind]) if how == "nasty" else PlainLine
    found = Soak(kind, seed, turn, line, slack)
    if how == "nasty":
        found.back = line(found.rng, twice=TWICE[kind])
    return found


class Soak:
    """One board and its driver; ``turn`` draws how long the host takes between two looks, s.

    ``slack``: s by which the line may delay a halt.
    """

    def __init__(self, kind, seed, turn, line=PlainLine, slack=0.0):
        self.rng = np.random.default_rng(seed)
        board = board_of(kind)
        self.driver = BOARDS[kind](board, BED.masses)
        self.remote = emulated_board(board, BED.masses)
        self._turn, self._slack = turn, slack
        self.t, self.legs, self.tally, self.doing = 0.0, {}, Tally(), "begin"
        self.there, self.back = line(self.rng), line(self.rng)
        self.plugged = True
        self.at = dict.fromkeys("xyz", 0.0)  # m, where legs of the past have led
        self.driver.opened(0.0)

    # --- Time ---------------------------------------------------------------------------------

    def wait(self, seconds, until=()):
        """Let both sides go on, until a phase."""
        end = self.t + seconds
        while self.t < end and self.driver.state.phase not in until:
            self._go_to(self.t + self._turn(self.rng))
        return self.driver.state

    def _go_to(self, t):
        """Let the board go on in steps, whatever the host does; then look once."""
        while self.t < t:
            self.t = min(self.t + 0.004, t)
            self.remote.take(self.there.arrived(self.t), self.t)
            said, legs = self.remote.run(self.t)
            self._lead(legs)
            if self.plugged:
                self.back.put(said, self.t)
        if self.plugged:
            self.driver.feed(self.back.arrived(self.t), self.t)
            self._send()

    def _send(self):
        self.there.put(self.driver.due(self.t), self.t)

    def _lead(self, legs):
        for leg in legs:
            self.legs[leg.mass] = ahead_of(self.legs.get(leg.mass, []), [leg])

    def true(self, name, t=None):
        """Return where a mass is, m; legs that are over are forgotten."""
        t = self.t if t is None else t
        legs = self.legs.get(name, [])
        while len(legs) > 1 and legs[1].t <= t:
            self.at[name] = along(legs[0], self.at[name], legs[1].t)
            legs.pop(0)
        return along(legs[0], self.at[name], t) if legs and legs[0].t <= t else self.at[name]

    # --- Cycles -------------------------------------------------------------------------------

    def run(self, cycles):
        """Live through so many cycles; return what became of them."""
        self._ready("connect", 8.0)
        self._home()
        kinds = [self.move, self.move_again, self.creep, self.halt, self.halt, self.pause,
                 self.home_again, self.reset, self.power, self.unplug, self.limit]  # fmt: skip
        for _ in range(cycles):
            kind = kinds[self.rng.integers(len(kinds))]
            self.doing = kind.__name__
            kind()
            self.tally.cycles += 1
        return self.tally

    def move(self):
        """Go somewhere; nothing may be at fault."""
        goal = self._go()
        self._ready("move", 8.0)
        self._well(goal)

    def move_again(self):
        """Go elsewhere on the way."""
        self._go()
        self.wait(self.rng.uniform(0.0, 1.0))
        goal = self._go()
        self._ready("move again", 10.0)
        self._well(goal)

    def creep(self):
        """Go a little way as slowly as a hold does, and on before that is over."""
        self._ready("begin", 8.0)  # what goes on from before would creep, too
        speed = float(self.rng.uniform(3.0, 20.0)) * UM
        for seconds in (self.rng.uniform(0.0, 4.0), 0.0):
            goal = {name: self.true(name) + 15 * UM * self.rng.uniform(-1, 1) for name in "xz"}
            self.driver.go(goal, self.t, speed)
            self.wait(seconds)
        self._ready("creep", 30 * UM / speed + 2.0)
        self._well(goal)

    def halt(self):
        """Stop at a random moment; the position stays known, nothing needs to home."""
        self._go()
        self.wait(self.rng.uniform(0.0, 1.2))
        self.driver.halt(self.t)
        self._send()  # in the same turn, as a keeper does
        halted = self.t
        self._ready("halt", 8.0)
        self.wait(0.3)
        self.tally.halts.append(self._stood(halted) - halted)
        if self._stood(halted) - halted > STOPS + self._slack:
            self.tally.late.append((self.doing, round(self._stood(halted) - halted, 3)))
        self._well(None)

    def pause(self):
        """Do nothing for a while in mid-move: legs end, nobody is blamed, and it goes on."""
        goal = self._go()
        self.wait(self.rng.uniform(0.0, 0.8))
        paused = self.t
        self._go_to(self.t + float(self.rng.choice([0.5, 2.0, 10.0])))
        if self._stood(paused) - paused > 2 * LEG + 0.15 + self._slack:
            self.tally.late.append((self.doing, round(self._stood(paused) - paused, 3)))
        self._ready("pause", 10.0)
        self._well(goal)

    def home_again(self):
        """Home while all is well."""
        self._home()

    def reset(self):
        """Press the board's button, standing or moving."""
        self._perhaps_moving()
        self.remote.press_reset()
        self._troubled()

    def power(self):
        """Switch it off for a while."""
        self._perhaps_moving()
        self.remote.switch(False)
        self.wait(self.rng.uniform(0.05, 2.5))
        self.remote.switch(True)
        self._troubled()

    def limit(self):
        """Push a limit switch ahead; one behind a mass that turns back stops nothing."""
        self._ready("begin", 8.0)
        self._go()
        self.wait(self.rng.uniform(0.1, 0.3))
        if self._under_way:
            self.remote.hit_limit()
            self._troubled()

    def unplug(self):
        """Pull the plug, and put it back."""
        self._perhaps_moving()
        self.plugged = False
        self.there.cleared(), self.back.cleared()
        self.driver.closed("unplugged")
        self._expect_fault()
        self._go_to(self.t + self.rng.uniform(0.1, 3.0))
        self.plugged = True
        self.driver.opened(self.t)
        self._ready("replug", 10.0)
        self._home()

    # --- What is expected ---------------------------------------------------------------------

    def _go(self):
        names = self.rng.choice(list("xyz"), self.rng.integers(1, 4), replace=False)
        goal = {name: float(self.rng.uniform(-14, 14)) * MM for name in names}
        if self.rng.random() < 0.3:
            goal = {name: self.true(name) + 1e-4 * self.rng.normal() for name in names}
            goal = {name: float(np.clip(at, -14 * MM, 14 * MM)) for name, at in goal.items()}
        self.driver.go(goal, self.t)
        return goal

    def _perhaps_moving(self):
        if self.rng.random() < 0.5:
            self._go()
            self.wait(self.rng.uniform(0.0, 1.0))

    def _troubled(self):
        """It must notice that its position is lost, and come home."""
        self._expect_fault()
        self._home()

    def _expect_fault(self):
        state = self.wait(4.0, until=(Phase.FAULT,))
        if state.sure:
            self.tally.false.append((self.doing, "sure of a position that is lost", state))
        elif state.fault is not None and state.fault.code not in LOST:
            self.tally.blamed.append((self.doing, state.sentence))

    def _home(self):
        self.tally.homed += 1
        for _ in range(3):  # a board that has no power yet must be asked again
            self.driver.home(self.t)
            state = self.wait(90.0, until=(Phase.READY, Phase.FAULT))
            if state.phase is Phase.READY:
                self.wait(0.3)
                self._well(dict.fromkeys("xyz", 0.0))
                return
        self.tally.stuck.append((self.doing, "home", state))

    def _ready(self, what, within):
        within *= 3.0 if self._slack else 1.0
        state = self.wait(within, until=(Phase.READY, Phase.FAULT))
        if state.phase not in (Phase.READY, Phase.FAULT):
            self.tally.stuck.append((self.doing, what, state))
        self.wait(0.3)

    def _well(self, goal):
        """Nothing happened that explains a fault; masses are where they are said to be."""
        state = self.driver.state
        if state.phase is Phase.FAULT:
            self.tally.blamed.append((self.doing, state.sentence))
            if self.doing != "home":
                self.doing = "home"
                self._home()
            return
        at = {name: self.true(name) for name in "xyz"}
        wrong = {k: (state.position.get(k), at[k]) for k in at
                 if abs(state.position.get(k, np.inf) - at[k]) > NEAR}  # fmt: skip
        if wrong or not state.sure:
            self.tally.false.append((self.doing, wrong, state.sure))
        if goal and any(abs(at[k] - to) > NEAR for k, to in goal.items()):
            self.tally.false.append((self.doing, "elsewhere", goal, at))

    def _stood(self, since):
        """Return when the last mass came to stand, or the time given; a leg ends the one before."""
        stood = since
        for legs in self.legs.values():
            for leg, after in zip(legs, [*legs[1:], None], strict=True):
                if leg.end > leg.t:
                    stood = max(stood, leg.end if after is None else min(leg.end, after.t))
        return min(stood, self.t)

    @property
    def _under_way(self):
        """Say whether a mass goes on for some time yet."""
        last = [legs[-1] for legs in self.legs.values() if legs]
        return any(leg.t <= self.t < leg.end - 0.1 for leg in last)
