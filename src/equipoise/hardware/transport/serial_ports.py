"""The serial ports of this computer."""

from dataclasses import dataclass

from equipoise.model.optional_libraries import extra_library


@dataclass(frozen=True, slots=True)
class SerialDevice:
    """A serial port and what says it is there."""

    path: str
    what: str  # maker and product as the device states them; empty: it does not


def serial_ports() -> list[SerialDevice]:
    """Return them in alphabetical order."""
    serialx = extra_library("serialx", "this computer", "serial ports", "hardware")
    found = serialx.list_serial_ports()
    return sorted((_device(port) for port in found), key=lambda device: device.path)


def _device(port: object) -> SerialDevice:
    said = [getattr(port, key, None) for key in ("manufacturer", "product", "serial_number")]
    return SerialDevice(str(getattr(port, "device", "")), ", ".join(str(s) for s in said if s))
