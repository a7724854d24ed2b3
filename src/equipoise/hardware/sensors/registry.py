"""The drivers of sensors by name."""

from collections.abc import Callable

from equipoise.hardware.sensors.camera import Camera
from equipoise.hardware.sensors.line_protocol import LineProtocol
from equipoise.hardware.sensors.mavlink import Mavlink
from equipoise.hardware.sensors.natnet import NatNet
from equipoise.hardware.sensors.rosbridge import RosBridge
from equipoise.hardware.sensors.vectornav import VectorNav
from equipoise.hardware.transport.conversation import SensorDriver
from equipoise.model.hardware import SensorUnit

DRIVERS: dict[str, Callable[[SensorUnit], SensorDriver]] = {
    "lines": LineProtocol,
    "mavlink": Mavlink,
    "natnet": NatNet,
    "rosbridge": RosBridge,
    "camera": Camera,
    "vectornav": VectorNav,
}
