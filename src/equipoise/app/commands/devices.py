"""`equipoise devices`: what is connected to this computer."""

import json as text
from dataclasses import asdict

from equipoise.app.arguments.types import Flag
from equipoise.app.console.terminal import stdout


def devices(*, json: Flag = False) -> int:
    """List the serial ports of this computer, as a testbed file names them.

    Parameters
    ----------
    json
        Print one JSON document instead.
    """
    from equipoise.hardware.transport.serial_ports import serial_ports

    found = serial_ports()
    if json:
        print(text.dumps({"schema": "equipoise/devices/1", "serial": [asdict(p) for p in found]}))
        return 0
    for port in found:
        stdout().print(f"serial:{port.path}  {port.what}".rstrip(), markup=False)
    if not found:
        stdout().print("No serial port was found. Network devices are not listed.", markup=False)
    return 0
