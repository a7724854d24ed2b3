"""The port at an address, by the scheme that the address begins with."""

from collections.abc import Callable

from equipoise.hardware.transport.port import (
    Port,
    PortLost,
    SerialPort,
    WebSocketPort,
    http_port,
    tcp_port,
    udp_out_port,
    udp_port,
    why,
)
from equipoise.model.errors import InputError
from equipoise.model.hardware import Port as Address


def open_port(port: Address) -> Port:
    """Return the port at an address, open. Raises PortLost, or InputError for an unknown scheme."""
    scheme, _, rest = port.address.partition(":")
    opener = OPENERS.get(scheme)
    if opener is None:
        raise InputError(f"port {port.address}", f"'{scheme}:'", "one of " + ", ".join(OPENERS))
    try:
        return opener(port, rest)
    except OSError as error:
        raise PortLost(port.address, why(error)) from error


def _camera(port: Address, rest: str) -> Port:
    from equipoise.hardware.camera.capture import CapturePort, camera_at

    return CapturePort(port.address, *camera_at(rest))


OPENERS: dict[str, Callable[[Address, str], Port]] = {
    "serial": SerialPort,
    "tcp": tcp_port,
    "udp": udp_port,
    "udpout": udp_out_port,
    "ws": WebSocketPort,
    "wss": WebSocketPort,
    "http": http_port,
    "camera": _camera,
}
