"""The drivers of motor boards by name."""

from collections.abc import Callable, Sequence

from equipoise.hardware.boards.grbl.driver import Grbl
from equipoise.hardware.boards.grbl.explained import GrblExplained
from equipoise.hardware.boards.tmcl.driver import Tmcl
from equipoise.hardware.boards.tmcl.explained import TmclExplained
from equipoise.hardware.transport.driver_protocol import BoardDriver
from equipoise.hardware.transport.explained_bytes import Explained
from equipoise.model.hardware import MotorBoard
from equipoise.model.testbed import SlidingMass

BOARDS: dict[str, Callable[[MotorBoard, Sequence[SlidingMass]], BoardDriver]] = {
    "grbl": Grbl,
    "tmcl": Tmcl,
}
EXPLAINED: dict[str, Callable[[], Explained]] = {
    "grbl": GrblExplained,
    "tmcl": TmclExplained,
}
