"""The drivers of motor boards by name."""

from collections.abc import Callable, Sequence

from equipoise.hardware.boards.grbl import Grbl
from equipoise.hardware.boards.tmcl import Tmcl
from equipoise.hardware.transport.driver_protocol import BoardDriver
from equipoise.model.hardware import MotorBoard
from equipoise.model.testbed import SlidingMass

BOARDS: dict[str, Callable[[MotorBoard, Sequence[SlidingMass]], BoardDriver]] = {
    "grbl": Grbl,
    "tmcl": Tmcl,
}
