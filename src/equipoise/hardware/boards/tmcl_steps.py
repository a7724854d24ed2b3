"""Displacements of masses in a module's microsteps, and the targets that it is sent.

    microsteps = (zero +- displacement) * steps per metre

Every round sends each motor a target at most two legs ahead of its last reported position: TMCL
keeps no queue, and a target replaces the one before.
"""

from collections.abc import Mapping, Sequence

from equipoise.hardware.transport.driver_protocol import LEG
from equipoise.model.hardware import Axis, MotorBoard
from equipoise.model.testbed import SlidingMass


class Steps:
    """The maps between displacements and microsteps, by mass."""

    def __init__(self, board: MotorBoard, masses: Sequence[SlidingMass]) -> None:
        self.axes: Mapping[str, Axis] = {axis.mass: axis for axis in board.axes}
        self._speed = {mass.name: mass.speed for mass in masses}

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

    def target(self, name: str, at: int, goal: float) -> int:
        """Return the position to send a mass to, on its way from ``at`` to a goal (m)."""
        end = self.steps(name, goal)
        most = int(2 * LEG * self._speed[name] * self.axes[name].steps_per_m)
        return max(at - most, min(at + most, end))
