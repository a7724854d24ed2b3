"""The lines that a Grbl board is sent."""

from collections.abc import Mapping, Sequence

from equipoise.hardware.boards.grbl.talk import Step
from equipoise.hardware.boards.legs import Way
from equipoise.hardware.transport.command_queue import Command
from equipoise.model.hardware import Axis
from equipoise.model.units import MINUTE, MM

SLOWEST = 1.0  # mm/min: the firmware's least feed (config.h); 0 is refused
PATIENCE = 1.5  # s, chosen: for a line; it waits while the board prints or a jog ends
TEXTS = {
    Step.SETTINGS: b"$$\n",
    Step.HOME: b"$H\n",
    Step.HOMED: b"\n",
    Step.UNLOCK: b"$X\n",
    Step.SYNC: b"\n",
}


def step_command(step: Step, patience: float = PATIENCE) -> Command[Step]:
    """Return a line that is always the same."""
    return Command(TEXTS[step], step, patience)


def jog(axes: Sequence[Axis], begin: Mapping[str, float], way: Way) -> Command[Step]:
    """Return the line for a leg from displacements (m): one feed for the whole of it."""
    words, square = "", 0.0
    for axis in axes:
        if axis.mass in way.to:
            words += f" {axis.letter}{axis.position(way.to[axis.mass]) / MM:.4f}"
            square += ((way.to[axis.mass] - begin[axis.mass]) / MM) ** 2
    feed = max(square**0.5 / way.duration * MINUTE, SLOWEST)
    return Command(f"$J=G53 G21 G90{words} F{feed:.2f}\n".encode(), Step.LEG, PATIENCE)
