"""The emulated counterparts of devices by the name of their driver."""

from collections.abc import Callable, Sequence

from equipoise.hardware.emulated.camera import EmulatedCamera
from equipoise.hardware.emulated.device import EmulatedActuator, EmulatedBoard, EmulatedSensor
from equipoise.hardware.emulated.device_lines import EmulatedDeviceLines
from equipoise.hardware.emulated.grbl.firmware import EmulatedGrbl
from equipoise.hardware.emulated.line_protocol import EmulatedLineProtocol
from equipoise.hardware.emulated.mavlink import EmulatedMavlink
from equipoise.hardware.emulated.natnet import EmulatedNatNet
from equipoise.hardware.emulated.rosbridge import EmulatedRosBridge
from equipoise.hardware.emulated.serial_line import ActuatorOnLine, BoardOnLine
from equipoise.hardware.emulated.tmcl import EmulatedTmcl
from equipoise.hardware.emulated.vectornav import EmulatedVectorNav
from equipoise.hardware.transport.driver_protocol import driver_named
from equipoise.model.devices import Device
from equipoise.model.hardware import ActuatorUnit, MotorBoard, SensorUnit
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
ELECTRONICS: dict[str, Callable[[ActuatorUnit, Sequence[Device]], EmulatedActuator]] = {
    "device_lines": EmulatedDeviceLines,
}


def emulated_board(board: MotorBoard, masses: Sequence[SlidingMass]) -> BoardOnLine:
    """Return a board's counterpart at the end of its line, as ``driver_named`` finds it."""
    firmware = driver_named(FIRMWARES, board.driver, "board")(board, masses)
    return BoardOnLine(firmware, board.port.baud)


def emulated_actuator(unit: ActuatorUnit, devices: Sequence[Device]) -> ActuatorOnLine:
    """Return the counterpart of a unit's electronics at the end of its line."""
    firmware = driver_named(ELECTRONICS, unit.driver, "actuator")(unit, devices)
    return ActuatorOnLine(firmware, unit.port.baud)
