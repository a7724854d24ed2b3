"""The far sides of devices by the name of their driver."""

from collections.abc import Callable, Sequence

from equipoise.hardware.emulated.camera import EmulatedCamera
from equipoise.hardware.emulated.device import EmulatedBoard, EmulatedSensor
from equipoise.hardware.emulated.grbl import EmulatedGrbl
from equipoise.hardware.emulated.vectornav import EmulatedVectorNav
from equipoise.model.hardware import MotorBoard, SensorUnit
from equipoise.model.testbed import SlidingMass

BOARDS: dict[str, Callable[[MotorBoard, Sequence[SlidingMass]], EmulatedBoard]] = {
    "grbl": EmulatedGrbl,
}
SENSORS: dict[str, Callable[[SensorUnit], EmulatedSensor]] = {
    "camera": EmulatedCamera,
    "vectornav": EmulatedVectorNav,
}
