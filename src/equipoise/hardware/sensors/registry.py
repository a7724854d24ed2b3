"""The drivers of sensors by name."""

from collections.abc import Callable

from equipoise.hardware.driver import SensorDriver
from equipoise.hardware.sensors.camera import Camera
from equipoise.hardware.sensors.vectornav import VectorNav
from equipoise.model.hardware import SensorUnit

DRIVERS: dict[str, Callable[[SensorUnit], SensorDriver]] = {
    "camera": Camera,
    "vectornav": VectorNav,
}
