"""The drivers of the electronics of wheels, gyros, coils and jets by name."""

from collections.abc import Callable, Sequence

from equipoise.hardware.actuators.device_lines import DeviceLines
from equipoise.hardware.actuators.explained import DeviceLinesExplained
from equipoise.hardware.transport.driver_protocol import ActuatorDriver
from equipoise.hardware.transport.explained_bytes import Explained
from equipoise.model.devices import Device
from equipoise.model.hardware import ActuatorUnit

ACTUATORS: dict[str, Callable[[ActuatorUnit, Sequence[Device]], ActuatorDriver]] = {
    "device_lines": DeviceLines,
}
EXPLAINED: dict[str, Callable[[], Explained]] = {"device_lines": DeviceLinesExplained}
