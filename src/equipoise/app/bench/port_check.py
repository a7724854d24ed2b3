"""Whether the ports of a bench can be opened at all, before anything is waited for."""

from equipoise.hardware.bench.open_port import open_port
from equipoise.hardware.transport.port import PortLost
from equipoise.model.errors import BenchStopped
from equipoise.model.hardware import Hardware


def check_reachable(hardware: Hardware) -> None:
    """Raise BenchStopped with a sentence for each device whose port cannot be opened."""
    missing = unreachable(hardware)
    if missing:
        raise BenchStopped("; ".join(missing))


def unreachable(hardware: Hardware) -> list[str]:
    """Return a sentence for each device whose port cannot be opened now."""
    reported: list[str] = []
    kinds = {"board": hardware.boards, "sensor": hardware.sensors, "actuator": hardware.actuators}
    for kind, devices in kinds.items():
        for device in devices:
            try:
                open_port(device.port).close()
            except PortLost as lost:
                reported.append(f"{kind} {device.name} cannot be reached: {lost}")
    return reported
