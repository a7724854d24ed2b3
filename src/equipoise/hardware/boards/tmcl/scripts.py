"""The scripts of requests for a TMCL module: at connection, and for finding its position.

Displacements of masses are in the module's microsteps:

    microsteps = (zero +- displacement) * steps per metre

Every round sends each motor a target at most two legs ahead of its last reported position, and of
where it would be at the commanded speed: TMCL keeps no queue, and a target replaces the one before.

The mark is a variable of its working memory: after a reset it is 0 again. Source: TMCM-6110 TMCL
Firmware Manual V1.31, 4.6.13 "RFS", chapter 6 "Global parameters", bank 2.
"""

import math
from collections.abc import Callable, Mapping, Sequence

from equipoise.hardware.boards.tmcl import words as w
from equipoise.hardware.boards.tmcl.settings import questions
from equipoise.hardware.boards.tmcl.talk import Answer
from equipoise.hardware.boards.tmcl.words import Request
from equipoise.hardware.transport.driver_protocol import LEG
from equipoise.model.hardware import Axis, MotorBoard
from equipoise.model.testbed import SlidingMass

MARK, BANK, VARIABLE = 0x45515550, 2, 255  # chosen: any number but 0; the last user variable
CALLED = Request(w.VERSION, w.BINARY, 0)
OBSERVED = Request(w.GGP, VARIABLE, BANK)


class Steps:
    """The maps between displacements and microsteps, by mass."""

    def __init__(self, board: MotorBoard, masses: Sequence[SlidingMass]) -> None:
        self.axes: Mapping[str, Axis] = {axis.mass: axis for axis in board.axes}
        self.speed = {mass.name: mass.speed for mass in masses}  # m/s

    def motor(self, name: str) -> int:
        """Return the number of a mass's motor."""
        return int(self.axes[name].letter)

    def steps(self, name: str, displacement: float) -> int:
        """Return the module's position of a displacement (m)."""
        axis = self.axes[name]
        return round(axis.position(displacement) * axis.steps_per_m)

    def displacement(self, name: str, steps: int) -> float:
        """Return the displacement (m) of a module's position."""
        axis = self.axes[name]
        return axis.displacement(steps / axis.steps_per_m)

    def pace(self, name: str, most: float) -> float:
        """Return the microsteps of a mass in a second, no faster than so many m/s."""
        return min(self.speed[name], most) * self.axes[name].steps_per_m

    def target(self, name: str, at: int, led: float, goal: float, most: float) -> int:
        """Return the position to send a mass to, on its way from ``at`` to a goal (m).

        It is at most two legs ahead of where it is, and of where it would be at its speed.
        """
        end, ahead = self.steps(name, goal), 2 * LEG * self.pace(name, most)
        step = max(2.0, ahead)
        if end < at:
            return max(end, min(at, math.ceil(max(at - step, led - ahead))))
        return min(end, max(at, math.floor(min(at + step, led + ahead))))


class Scripts:
    """The scripts for one module; ``speeds`` are in its units, by mass."""

    def __init__(self, board: MotorBoard, steps: Steps) -> None:
        self._board, self._steps = board, steps
        self.speeds: dict[str, int] = {}
        self._given: dict[str, int] = {}  # speeds that the module is known to have

    def each(self, command: int, type_: int = 0) -> Sequence[Request]:
        """Return the same request to each motor."""
        return [Request(command, type_, int(axis.letter)) for axis in self._board.axes]

    def step(self, name: str) -> Sequence[Request]:
        """Return the script of a step."""
        scripts: dict[str, Callable[[], Sequence[Request]]] = {
            "stop": lambda: [*self.each(w.RFS, w.STOP), *self.each(w.MST)],
            "stopped": lambda: self.each(w.GAP, w.SPEED),
            "settings": lambda: questions(self._board),
            "mark": self._marked,
            "search": lambda: self.each(w.RFS, w.START),
            "searched": lambda: self.each(w.RFS, w.STATUS),
            "place": lambda: [
                Request(w.SAP, w.AT, int(axis.letter), self._steps.steps(axis.mass, 0.0))
                for axis in self._board.axes
            ],
        }
        return scripts[name]()

    def slowed(self, most: float) -> Sequence[Request]:
        """Return what sets the speed of each mass, for at most so many m/s, where it changes.

        Units of speed are rounded up: the targets keep masses from being faster. What the module
        has is not known until it has answered: another script may come first.
        """
        own = self._steps.speed
        wanted = {
            name: math.ceil(value * min(1.0, most / own[name]))
            for name, value in self.speeds.items()
        }
        changed = {name: v for name, v in wanted.items() if self._given.get(name) != v}
        self._given = {name: v for name, v in self._given.items() if name not in changed}
        return [
            Request(w.SAP, w.MOST_SPEED, self._steps.motor(name), speed)
            for name, speed in changed.items()
        ]

    def answered(self, answers: Mapping[Request, Answer]) -> None:
        """Note which speeds the module has taken."""
        names = {self._steps.motor(name): name for name in self.speeds}
        for request, answer in answers.items():
            if (request.command, request.type) == (w.SAP, w.MOST_SPEED) and answer.done:
                self._given[names[request.motor]] = request.value

    def _marked(self) -> Sequence[Request]:
        self._given = {}
        return [*self.slowed(math.inf), Request(w.SGP, VARIABLE, BANK, MARK)]
