"""Open the port at an address: a wire of ``transport``, or a camera of this computer."""

from collections.abc import Callable

from equipoise.hardware.camera.capture import CapturePort, camera_at
from equipoise.hardware.transport import port as wires
from equipoise.hardware.transport.port import Port, PortLost, why
from equipoise.model.errors import InputError
from equipoise.model.hardware import Port as Address


def open_port(port: Address) -> Port:
    """Return the port at an address, open.

    Raises PortLost, or InputError for an address of another form.
    """
    scheme, _, rest = port.address.partition(":")
    opener = OPENERS.get(scheme)
    if opener is None:
        raise InputError(f"port {port.address}", f"'{scheme}:'", "one of " + ", ".join(OPENERS))
    try:
        return opener(port, rest)
    except OSError as error:
        raise PortLost(port.address, why(error)) from error


def _camera(port: Address, rest: str) -> Port:
    return CapturePort(port.address, *camera_at(rest))


OPENERS: dict[str, Callable[[Address, str], Port]] = {**wires.OPENERS, "camera": _camera}
