"""The emulated counterparts of devices by the name of their driver."""

from collections.abc import Callable, Sequence

from equipoise.hardware.emulated.camera import EmulatedCamera
from equipoise.hardware.emulated.device import EmulatedBoard, EmulatedSensor
from equipoise.hardware.emulated.grbl.firmware import EmulatedGrbl
from equipoise.hardware.emulated.line_protocol import EmulatedLineProtocol
from equipoise.hardware.emulated.mavlink import EmulatedMavlink
from equipoise.hardware.emulated.natnet import EmulatedNatNet
from equipoise.hardware.emulated.rosbridge import EmulatedRosBridge
from equipoise.hardware.emulated.serial_line import BoardOnLine
from equipoise.hardware.emulated.tmcl import EmulatedTmcl
from equipoise.hardware.emulated.vectornav import EmulatedVectorNav
from equipoise.hardware.transport.driver_protocol import driver_named
from equipoise.model.hardware import MotorBoard, SensorUnit
from equipoise.model.testbed import SlidingMass

FIRMWARES: dict[str, Callable[[MotorBoard, Sequence[SlidingMass]], EmulatedBoard]] = {
    "grbl": EmulatedGrbl,
    "tmcl": EmulatedTmcl,
}
SENSORS: dict[str, Callable[[SensorUnit], EmulatedSensor]] = {
    "camera": EmulatedCamera,
    "lines": EmulatedLineProtocol,
    "mavlink": EmulatedMavlink,
    "natnet": EmulatedNatNet,
    "rosbridge": EmulatedRosBridge,
    "vectornav": EmulatedVectorNav,
}


def emulated_board(board: MotorBoard, masses: Sequence[SlidingMass]) -> BoardOnLine:
    """Return a board's counterpart at the end of its line, as ``driver_named`` finds it."""
    firmware = driver_named(FIRMWARES, board.driver, "board")(board, masses)
    return BoardOnLine(firmware, board.port.baud)
